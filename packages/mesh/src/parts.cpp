#include "perimorph/mesh/parts.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "perimorph/base/directory.hpp"
#include "perimorph/base/disjoint_sets.hpp"
#include "perimorph/base/point_tree.hpp"
#include "perimorph/mesh/shared_sides.hpp"
#include "perimorph/mesh/sorted_sides.hpp"

namespace perimorph::mesh {

namespace {

/// The elements around each node of the boundary.
template <int dim>
std::map<int, std::vector<int>> elements_around_boundary(const Mesh<dim>& mesh) {
  std::map<int, std::vector<int>> around;
  for (const auto& side : mesh.boundary) {
    for (const int node : side_nodes(mesh, side)) around[node];
  }
  std::vector<std::vector<int>*> of_node(mesh.n_nodes(), nullptr);
  for (auto& [node, elements] : around) of_node[node] = &elements;
  for (int e = 0; e < mesh.n_elements(); ++e) {
    for (int c = 0; c < mesh.n_corners(e); ++c) {
      if (auto* elements = of_node[mesh.corners_of(e)[c]]) elements->push_back(e);
    }
  }
  return around;
}

/// Whether two elements share a side that has the node.
template <int dim>
bool are_connected(const Mesh<dim>& mesh, int element, int other, int node) {
  const int side = shared_side(mesh, element, other);
  if (side < 0) return false;
  const auto nodes = side_nodes(mesh, {element, side});
  return std::find(nodes.begin(), nodes.end(), node) != nodes.end();
}

/// Elements around a node, by the sides through it that connect them.
template <int dim>
std::vector<std::vector<int>> connected(const Mesh<dim>& mesh, const std::vector<int>& elements, int node) {
  base::DisjointSets sets(static_cast<int>(elements.size()));
  for (std::size_t i = 0; i < elements.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (are_connected(mesh, elements[i], elements[j], node)) sets.join(static_cast<int>(i), static_cast<int>(j));
    }
  }
  std::map<int, std::vector<int>> groups;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    groups[sets.lowest(static_cast<int>(i))].push_back(elements[i]);
  }
  std::vector<std::vector<int>> lists;
  for (const auto& [lowest, members] : groups) lists.push_back(members);
  return lists;
}

/// The elements around the part's own nodes, all of which it has, and for each of these the lowest of those that it
/// hangs together with there, by nodes that are no hinges.
template <int dim>
std::map<int, int> sets_around_own_nodes(const Mesh<dim>& part, const std::vector<Hinge>& own_hinges) {
  std::vector<int> first_at(part.n_owned_nodes, -1);
  std::vector<char> is_hinge(part.n_owned_nodes, 0);
  base::DisjointSets joined(part.n_elements());
  for (const auto& hinge : own_hinges) {
    is_hinge[hinge.node] = 1;
    for (const auto& group : hinge.groups) {
      for (const int e : group) joined.join(group.front(), e);
    }
  }
  std::map<int, int> sets;
  for (int e = 0; e < part.n_elements(); ++e) {
    for (int c = 0; c < part.n_corners(e); ++c) {
      const int node = part.corners_of(e)[c];
      if (node >= part.n_owned_nodes) continue;
      sets[e];
      if (is_hinge[node] != 0) continue;
      if (first_at[node] < 0) first_at[node] = e;
      joined.join(first_at[node], e);
    }
  }
  for (auto& [element, lowest] : sets) lowest = joined.lowest(element);
  return sets;
}

/// How many sets those of all ranks are, if sets that have an element in common are one. Collective.
template <int dim>
GlobalId count_sets(const base::Comm& comm, const Mesh<dim>& part, const std::map<int, int>& sets) {
  std::map<int, GlobalId> number_of;  // of a set, by its lowest element, among those of all ranks
  for (const auto& entry : sets) number_of[entry.second];
  const auto slices = base::Slices::of(comm, number_of.size());
  GlobalId next = slices.begin(comm.getRank());
  for (auto& [lowest, number] : number_of) number = next++;
  std::vector<GlobalId> elements, numbers;
  for (const auto& [element, lowest] : sets) {
    elements.push_back(part.element_ids[element]);
    numbers.push_back(number_of.at(lowest));
  }
  const base::Directory directory(comm, base::max(comm, part.n_global_elements), elements);
  std::set<std::array<GlobalId, 2>> same;  // numbers of one element
  directory.collect(numbers, GlobalId{-1}, [&](GlobalId& first, GlobalId number) {
    if (first < 0) first = number;
    if (first != number) same.insert({first, number});
  });
  const auto n_sets = static_cast<int>(slices.n());
  base::DisjointSets all(n_sets);
  const auto pairs = base::gather_on_all<std::array<GlobalId, 2>>(comm, {same.begin(), same.end()});
  for (const auto& [one, other] : pairs) all.join(static_cast<int>(one), static_cast<int>(other));
  GlobalId n_parts = 0;
  for (int i = 0; i < n_sets; ++i) n_parts += all.lowest(i) == i ? 1 : 0;
  return n_parts;
}

}  // namespace

template <int dim>
std::vector<Hinge> hinges(const Mesh<dim>& whole) {
  std::vector<Hinge> found;
  for (const auto& [node, elements] : elements_around_boundary(whole)) {
    auto groups = connected(whole, elements, node);
    if (groups.size() > 1) found.push_back({node, std::move(groups)});
  }
  return found;
}

template <int dim>
std::vector<int> parts_of_elements(const Mesh<dim>& mesh, const std::vector<Hinge>& hinges) {
  std::vector<char> is_hinge(mesh.n_nodes(), 0);
  for (const auto& hinge : hinges) is_hinge[hinge.node] = 1;
  std::vector<int> first_at(mesh.n_nodes(), -1);  // element at each node
  base::DisjointSets sets(mesh.n_elements());
  for (int e = 0; e < mesh.n_elements(); ++e) {
    for (int c = 0; c < mesh.n_corners(e); ++c) {
      const int node = mesh.corners_of(e)[c];
      if (is_hinge[node] != 0) continue;
      if (first_at[node] < 0) first_at[node] = e;
      sets.join(first_at[node], e);
    }
  }
  for (const auto& hinge : hinges) {
    for (const auto& group : hinge.groups) {
      for (const int e : group) sets.join(group.front(), e);
    }
  }
  std::vector<int> part(mesh.types.size());
  int n_parts = 0;
  for (int e = 0; e < mesh.n_elements(); ++e) part[e] = sets.lowest(e) == e ? n_parts++ : part[sets.lowest(e)];
  return part;
}

template <int dim>
Connections connections(const base::Comm& comm, const Mesh<dim>& part) {
  const Mesh<dim> nothing;
  const auto& mesh = part.rank == comm.getRank() ? part : nothing;
  std::vector<Hinge> own_hinges;
  std::map<int, int> sets;
  base::on_all_ranks(comm, [&] {
    for (auto& hinge : hinges(mesh)) {
      if (hinge.node < mesh.n_owned_nodes) own_hinges.push_back(std::move(hinge));
    }
    sets = sets_around_own_nodes(mesh, own_hinges);
  });
  return {count_sets(comm, mesh, sets), base::sum(comm, static_cast<GlobalId>(own_hinges.size()))};
}

template <int dim>
std::vector<std::pair<int, int>> coincident_nodes(const Mesh<dim>& whole) {
  constexpr double tolerance = 1e-6;
  std::map<int, double> reach;  // of the boundary's nodes
  for (const auto& side : whole.boundary) {
    for (const int node : side_nodes(whole, side)) reach[node] = tolerance * radius(whole, side.element);
  }
  std::vector<int> nodes;
  std::vector<Point<dim>> points;
  for (const auto& entry : reach) {
    nodes.push_back(entry.first);
    points.push_back(whole.coordinates[entry.first]);
  }
  const base::PointTree<dim> tree(points);
  std::vector<std::pair<int, int>> pairs;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (const int j : tree.within(points[i], reach.at(nodes[i]))) {
      if (j > static_cast<int>(i)) pairs.emplace_back(nodes[i], nodes[j]);
    }
  }
  return pairs;
}

#define PERIMORPH_INSTANTIATE(dim)                                                          \
  template std::vector<Hinge> hinges(const Mesh<dim>&);                                     \
  template std::vector<int> parts_of_elements(const Mesh<dim>&, const std::vector<Hinge>&); \
  template Connections connections(const base::Comm&, const Mesh<dim>&);                    \
  template std::vector<std::pair<int, int>> coincident_nodes(const Mesh<dim>&);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::mesh
