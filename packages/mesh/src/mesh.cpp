#include "perimorph/mesh/mesh.hpp"

#include <algorithm>
#include <functional>
#include <tuple>

#include "perimorph/mesh/sorted_sides.hpp"
#include "topology.hpp"

namespace perimorph::mesh {

namespace {

template <int dim>
bool has_side(const Mesh<dim>& mesh, const Side& side) {
  return mesh.has_element(side.element) && side.side >= 0 &&
         side.side < static_cast<int>(sides(mesh.types[side.element]).size());
}

bool are_all_below(const std::vector<int>& numbers, std::size_t limit) {
  return std::all_of(numbers.begin(), numbers.end(),
                     [&](int n) { return n >= 0 && static_cast<std::size_t>(n) < limit; });
}

bool is_ascending(std::vector<GlobalId>::const_iterator first, std::vector<GlobalId>::const_iterator end) {
  return std::adjacent_find(first, end, std::greater_equal<>()) == end;
}

bool are_in_order(const std::vector<GlobalId>& ids, int n_owned) {
  return is_ascending(ids.begin(), ids.begin() + n_owned) && is_ascending(ids.begin() + n_owned, ids.end());
}

template <int dim>
bool has_corners_as_its_types_say(const Mesh<dim>& mesh) {
  int end = 0;
  for (int e = 0; e < mesh.n_elements() && mesh.first_corner[e] == end; ++e) end += n_corners(mesh.types[e]);
  return mesh.first_corner.back() == end && end == static_cast<int>(mesh.corners.size());
}

template <int dim>
bool has_all_sides(const Mesh<dim>& mesh, const std::vector<Side>& list) {
  return std::all_of(list.begin(), list.end(), [&](const Side& side) { return has_side(mesh, side); });
}

template <int dim>
void check_lengths(const Mesh<dim>& mesh) {
  const auto n_nodes = mesh.coordinates.size(), n_elements = mesh.types.size();
  PERIMORPH_ASSERT(mesh.node_ids.size() == n_nodes && mesh.node_owners.size() == n_nodes,
                   "{} nodes, {} ids and {} owners", n_nodes, mesh.node_ids.size(), mesh.node_owners.size());
  PERIMORPH_ASSERT(mesh.element_ids.size() == n_elements && mesh.element_owners.size() == n_elements,
                   "{} elements, {} ids and {} owners", n_elements, mesh.element_ids.size(),
                   mesh.element_owners.size());
  PERIMORPH_ASSERT(mesh.blocks.size() == n_elements, "{} elements, {} of them in blocks", n_elements,
                   mesh.blocks.size());
  PERIMORPH_ASSERT(mesh.first_corner.size() == n_elements + 1, "{} elements, {} lists of corners", n_elements,
                   mesh.first_corner.size());
}

template <int dim>
void check_counts(const Mesh<dim>& mesh) {
  PERIMORPH_ASSERT(mesh.n_owned_nodes >= 0 && mesh.n_owned_nodes <= mesh.n_nodes() &&
                       (mesh.n_nodes() <= mesh.n_global_nodes || !mesh.images.empty()),
                   "{} owned ones of {} nodes here and {} in all", mesh.n_owned_nodes, mesh.n_nodes(),
                   mesh.n_global_nodes);
  PERIMORPH_ASSERT(mesh.n_owned_elements >= 0 && mesh.n_owned_elements <= mesh.n_elements() &&
                       mesh.n_real_elements() <= mesh.n_global_elements,
                   "{} owned ones of {} elements here and {} in all", mesh.n_owned_elements, mesh.n_real_elements(),
                   mesh.n_global_elements);
}

template <int dim>
void check_numbers(const Mesh<dim>& mesh) {
  const auto n_nodes = mesh.coordinates.size(), n_elements = mesh.types.size();
  PERIMORPH_DEBUG_ASSERT(has_corners_as_its_types_say(mesh), "{} corners of {} elements", mesh.corners.size(),
                         n_elements);
  PERIMORPH_DEBUG_ASSERT(are_all_below(mesh.corners, n_nodes), "a corner is none of {} nodes", n_nodes);
  PERIMORPH_DEBUG_ASSERT(are_all_below(mesh.blocks, mesh.block_names.size()), "an element is in none of {} blocks",
                         mesh.block_names.size());
  PERIMORPH_DEBUG_ASSERT(are_in_order(mesh.node_ids, mesh.n_owned_nodes), "{} nodes, {} owned", n_nodes,
                         mesh.n_owned_nodes);
  PERIMORPH_DEBUG_ASSERT(are_in_order(mesh.element_ids, mesh.n_owned_elements), "{} elements, {} owned", n_elements,
                         mesh.n_owned_elements);
  PERIMORPH_DEBUG_ASSERT(has_all_sides(mesh, mesh.boundary), "the boundary has a side of none of {} elements",
                         n_elements);
  for (const auto& [node, n_parents, parents] : mesh.hanging_nodes) {
    PERIMORPH_DEBUG_ASSERT(are_all_below({parents.begin(), parents.begin() + n_parents}, n_nodes),
                           "node {} hangs on one that is none of {}", node, n_nodes);
  }
  for (const auto& [name, nodes] : mesh.node_sets) {
    PERIMORPH_DEBUG_ASSERT(are_all_below(nodes, n_nodes), "group {} has a node that is none of {}", name, n_nodes);
  }
  for (const auto& [name, list] : mesh.side_sets) {
    PERIMORPH_DEBUG_ASSERT(has_all_sides(mesh, list), "group {} has a side of none of {} elements", name, n_elements);
  }
}

}  // namespace

template <int dim>
void check_consistency(const Mesh<dim>& mesh) {
  check_lengths(mesh);
  check_counts(mesh);
  check_numbers(mesh);
}

template <int dim>
Point<dim> centroid(const Mesh<dim>& mesh, int element) {
  const int n = mesh.n_corners(element);
  Point<dim> sum = Point<dim>::Zero();
  for (int c = 0; c < n; ++c) sum += mesh.coordinates[mesh.corners_of(element)[c]];
  return sum / n;
}

template <int dim>
double radius(const Mesh<dim>& mesh, int element) {
  const Point<dim> center = centroid(mesh, element);
  double largest = 0.;
  for (int c = 0; c < mesh.n_corners(element); ++c) {
    largest = std::max(largest, (mesh.coordinates[mesh.corners_of(element)[c]] - center).norm());
  }
  return largest;
}

template <int dim>
std::vector<int> side_nodes(const Mesh<dim>& mesh, const Side& side) {
  PERIMORPH_DEBUG_ASSERT(has_side(mesh, side), "side {} of element {} of {}", side.side, side.element,
                         mesh.n_elements());
  std::vector<int> nodes;
  for (const int corner : sides(mesh.types[side.element])[side.side]) {
    nodes.push_back(mesh.corners_of(side.element)[corner]);
  }
  return nodes;
}

template <int dim>
std::vector<Point<dim>> corner_points(const Mesh<dim>& mesh, const Side& side) {
  std::vector<Point<dim>> points;
  for (const int node : side_nodes(mesh, side)) points.push_back(mesh.coordinates[node]);
  return points;
}

template <int dim>
double mean_edge(const Mesh<dim>& mesh) {
  double sum = 0.;
  long count = 0;
  for (int e = 0; e < mesh.n_elements(); ++e) {
    const shards::CellTopology element = topology(mesh.types[e]);
    const int* nodes = mesh.corners_of(e);
    for (unsigned edge = 0; edge < element.getEdgeCount(); ++edge) {
      const int first = nodes[element.getNodeMap(1, edge, 0)], second = nodes[element.getNodeMap(1, edge, 1)];
      sum += (mesh.coordinates[first] - mesh.coordinates[second]).norm();
    }
    count += element.getEdgeCount();
  }
  return count == 0 ? 0. : sum / static_cast<double>(count);
}

SideKey side_key(const std::vector<int>& nodes) {
  SideKey key = {-1, -1, -1, -1};
  PERIMORPH_ASSERT(nodes.size() <= key.size(), "a side of {} nodes", nodes.size());
  std::copy(nodes.begin(), nodes.end(), key.begin());
  std::sort(key.begin(), key.end());
  return key;
}

template <int dim>
std::vector<KeyedSide> sorted_sides(const Mesh<dim>& mesh) {
  std::vector<KeyedSide> all;
  for (int e = 0; e < mesh.n_elements(); ++e) {
    const int n_sides = static_cast<int>(sides(mesh.types[e]).size());
    for (int s = 0; s < n_sides; ++s) all.push_back({side_key(side_nodes(mesh, {e, s})), {e, s}});
  }
  std::sort(all.begin(), all.end(), [](const KeyedSide& a, const KeyedSide& b) {
    return std::tie(a.key, a.side.element, a.side.side) < std::tie(b.key, b.side.element, b.side.side);
  });
  return all;
}

template <int dim>
void find_boundary(Mesh<dim>& mesh) {
  PERIMORPH_ASSERT(mesh.is_whole() || mesh.n_global_elements == 0, "{} of {} elements are here", mesh.n_elements(),
                   mesh.n_global_elements);
  const std::vector<KeyedSide> all = sorted_sides(mesh);
  mesh.boundary.clear();
  for (std::size_t first = 0, next = 0; first < all.size(); first = next) {
    for (next = first + 1; next < all.size() && all[next].key == all[first].key;) ++next;
    if (next == first + 1) mesh.boundary.push_back(all[first].side);
  }
  std::sort(mesh.boundary.begin(), mesh.boundary.end());
}

#define PERIMORPH_INSTANTIATE(dim)                                               \
  template void check_consistency(const Mesh<dim>&);                             \
  template Point<dim> centroid(const Mesh<dim>&, int);                           \
  template double radius(const Mesh<dim>&, int);                                 \
  template std::vector<Point<dim>> corner_points(const Mesh<dim>&, const Side&); \
  template double mean_edge(const Mesh<dim>&);                                   \
  template void find_boundary(Mesh<dim>&);                                       \
  template std::vector<int> side_nodes(const Mesh<dim>&, const Side&);           \
  template std::vector<KeyedSide> sorted_sides(const Mesh<dim>&);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::mesh
