#include "pieces.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "perimorph/mesh/sorted_sides.hpp"

namespace perimorph::mesh {

namespace {

/// Local index of each item of a part, -1 where it is left out.
std::vector<int> local_indices(const std::vector<int>& items, int n_all) {
  std::vector<int> local(n_all, -1);
  for (std::size_t i = 0; i < items.size(); ++i) local[items[i]] = static_cast<int>(i);
  return local;
}

void add(std::vector<int>& kept, const std::vector<int>& nodes, const std::vector<int>& local) {
  for (const int node : nodes) {
    if (local[node] >= 0) kept.push_back(local[node]);
  }
}

void add(std::vector<Side>& kept, const std::vector<Side>& all, const std::vector<int>& local) {
  for (const Side& side : all) {
    if (local[side.element] >= 0) kept.push_back({local[side.element], side.side});
  }
}

/// What one mesh knows of its nodes and sides goes to another.
template <int dim>
void add_sets(Mesh<dim>& to, const Mesh<dim>& from, const NodeSets& node_sets, const std::vector<int>& local_node,
              const std::vector<int>& local_element) {
  for (const auto& [name, set] : node_sets) add(to.node_sets[name], set, local_node);
  for (const auto& [name, set] : from.side_sets) add(to.side_sets[name], set, local_element);
  add(to.boundary, from.boundary, local_element);
}

template <int dim>
void add_element(Mesh<dim>& to, const Mesh<dim>& from, int element, int owner, const std::vector<int>& local_node) {
  to.types.push_back(from.types[element]);
  to.blocks.push_back(from.blocks[element]);
  to.element_ids.push_back(from.element_ids[element]);
  to.element_owners.push_back(owner);
  for (int c = 0; c < from.n_corners(element); ++c) to.corners.push_back(local_node[from.corners_of(element)[c]]);
  to.first_corner.push_back(static_cast<int>(to.corners.size()));
}

template <int dim>
void add_node(Mesh<dim>& to, const Mesh<dim>& from, int node, int owner) {
  to.coordinates.push_back(from.coordinates[node]);
  to.node_ids.push_back(from.node_ids[node]);
  to.node_owners.push_back(owner);
}

/// Where an item of the whole is: in which piece, and as what there.
struct Place {
  bool is_others;
  GlobalId id;
  int piece, local;

  friend bool operator<(const Place& a, const Place& b) {
    return std::tie(a.is_others, a.id, a.piece) < std::tie(b.is_others, b.id, b.piece);
  }
};

/// All items of the pieces: the rank's own, then the others, each by ascending id.
template <int dim>
std::vector<Place> places(const std::vector<Mesh<dim>>& pieces, int rank, std::vector<GlobalId> Mesh<dim>::*ids,
                          std::vector<int> Mesh<dim>::*owners) {
  std::vector<Place> all;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const auto& piece_ids = pieces[p].*ids;
    for (std::size_t i = 0; i < piece_ids.size(); ++i) {
      all.push_back({(pieces[p].*owners)[i] != rank, piece_ids[i], static_cast<int>(p), static_cast<int>(i)});
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// Calls visit(place, is_new) for all places.
template <class Visit>
void visit_once(const std::vector<Place>& all, Visit visit) {
  for (std::size_t i = 0; i < all.size(); ++i) visit(all[i], i == 0 || all[i].id != all[i - 1].id);
}

template <class T>
void sort_unique(std::vector<T>& items) {
  std::sort(items.begin(), items.end());
  const auto is_same = [](const T& a, const T& b) { return !(a < b) && !(b < a); };
  items.erase(std::unique(items.begin(), items.end(), is_same), items.end());
}

}  // namespace

template <int dim>
Mesh<dim> cut_out(const Mesh<dim>& part, const NodeSets& node_sets, const Owners& owners,
                  const std::vector<int>& elements) {
  std::vector<int> nodes;
  for (const int e : elements) nodes.insert(nodes.end(), part.corners_of(e), part.corners_of(e) + part.n_corners(e));
  sort_unique(nodes);
  const auto local_node = local_indices(nodes, part.n_nodes());
  Mesh<dim> piece;
  for (const int n : nodes) add_node(piece, part, n, owners.nodes[n]);
  for (const int e : elements) add_element(piece, part, e, owners.elements[e], local_node);
  add_sets(piece, part, node_sets, local_node, local_indices(elements, part.n_elements()));
  return piece;
}

template <int dim>
Mesh<dim> join(const std::vector<Mesh<dim>>& pieces, int rank) {
  std::vector<std::vector<int>> local_nodes, local_elements;
  for (const auto& piece : pieces) {
    local_nodes.emplace_back(piece.n_nodes());
    local_elements.emplace_back(piece.n_elements());
  }
  Mesh<dim> part;
  part.rank = rank;
  const auto nodes = places(pieces, rank, &Mesh<dim>::node_ids, &Mesh<dim>::node_owners);
  visit_once(nodes, [&](const Place& place, bool is_new) {
    const auto& piece = pieces[place.piece];
    if (is_new) add_node(part, piece, place.local, piece.node_owners[place.local]);
    if (is_new && !place.is_others) ++part.n_owned_nodes;
    local_nodes[place.piece][place.local] = part.n_nodes() - 1;
  });
  for (const auto& place : places(pieces, rank, &Mesh<dim>::element_ids, &Mesh<dim>::element_owners)) {
    const auto& piece = pieces[place.piece];
    add_element(part, piece, place.local, piece.element_owners[place.local], local_nodes[place.piece]);
    if (!place.is_others) ++part.n_owned_elements;
    local_elements[place.piece][place.local] = part.n_elements() - 1;
  }
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    add_sets(part, pieces[p], pieces[p].node_sets, local_nodes[p], local_elements[p]);
  }
  for (auto& [name, set] : part.node_sets) sort_unique(set);
  for (auto& [name, set] : part.side_sets) sort_unique(set);
  sort_unique(part.boundary);
  return part;
}

template <int dim>
Mesh<dim> own_elements(const Mesh<dim>& part) {
  const Owners owners{std::vector<int>(part.n_owned_elements, part.rank), std::vector<int>(part.n_nodes(), part.rank)};
  std::vector<int> all(part.n_owned_elements);
  std::iota(all.begin(), all.end(), 0);
  auto own = join<dim>({cut_out(part, part.node_sets, owners, all)}, part.rank);
  own.block_names = part.block_names;
  own.notes = part.notes;
  own.n_global_nodes = part.n_global_nodes;
  own.n_global_elements = part.n_global_elements;
  return own;
}

#define PERIMORPH_INSTANTIATE(dim)                                                                       \
  template Mesh<dim> cut_out(const Mesh<dim>&, const NodeSets&, const Owners&, const std::vector<int>&); \
  template Mesh<dim> join(const std::vector<Mesh<dim>>&, int);                                           \
  template Mesh<dim> own_elements(const Mesh<dim>&);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::mesh
