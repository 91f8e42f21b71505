#include "perimorph/mesh/distribute.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <unordered_map>

#include "nearby_elements.hpp"
#include "packed_mesh.hpp"
#include "partition.hpp"
#include "perimorph/base/directory.hpp"
#include "perimorph/base/errors.hpp"
#include "pieces.hpp"

namespace perimorph::mesh {

namespace {

using base::Directory;

template <int dim>
void check_input(const Mesh<dim>& part, double halo_width, const std::vector<double>& weights) {
  check_consistency(part);
  PERIMORPH_ASSERT(std::isfinite(halo_width) && halo_width >= 0., "the halo's width is {}", halo_width);
  PERIMORPH_ASSERT(weights.empty() || static_cast<int>(weights.size()) == part.n_owned_elements,
                   "{} weights for {} elements", weights.size(), part.n_owned_elements);
  PERIMORPH_ASSERT(std::all_of(weights.begin(), weights.end(), [](double w) { return std::isfinite(w) && w >= 0.; }),
                   "one of {} weights is no cost", weights.size());
}

/// A mesh with the names and sizes that rank 0 knows, and nothing else. Collective.
template <int dim>
Mesh<dim> names_and_sizes(const base::Comm& comm, const Mesh<dim>& part) {
  Mesh<dim> names;
  if (comm.getRank() == 0) {
    names.block_names = part.block_names;
    for (const auto& entry : part.node_sets) names.node_sets[entry.first];
    for (const auto& entry : part.side_sets) names.side_sets[entry.first];
    names.n_global_nodes = part.n_global_nodes;
    names.n_global_elements = part.n_global_elements;
  }
  return unpack<dim>(base::gather_on_all(comm, comm.getRank() == 0 ? pack(names) : std::vector<PackedWord>()));
}

template <int dim>
std::vector<int> element_owners(const base::Comm& comm, const Mesh<dim>& part, const std::vector<double>& weights) {
  std::vector<Point<dim>> centroids;
  for (int e = 0; e < part.n_owned_elements; ++e) centroids.push_back(centroid(part, e));
  const std::vector<GlobalId> ids(part.element_ids.begin(), part.element_ids.begin() + part.n_owned_elements);
  const bool has_weights = !weights.empty() && part.n_owned_elements > 0;
  return partition<dim>(comm, ids, centroids, has_weights ? weights : std::vector<double>(ids.size(), 1.));
}

/// Of the part's nodes, without those of images, which are the last.
template <int dim>
std::vector<GlobalId> real_node_ids(const Mesh<dim>& part) {
  const auto is_image = [&](GlobalId id) { return id >= part.n_global_nodes; };
  return {part.node_ids.begin(), std::find_if(part.node_ids.begin(), part.node_ids.end(), is_image)};
}

/// The lowest rank that is to own an element around each local node. Collective.
template <int dim>
std::vector<int> node_owners(const Directory& nodes, const Mesh<dim>& part, const std::vector<int>& element_owners) {
  constexpr int none = std::numeric_limits<int>::max();
  std::vector<int> owners(nodes.n_own(), none);
  for (int e = 0; e < part.n_owned_elements; ++e) {
    for (int c = 0; c < part.n_corners(e); ++c) {
      int& owner = owners[part.corners_of(e)[c]];
      owner = std::min(owner, element_owners[e]);
    }
  }
  return nodes.answers(nodes.collect(owners, none, [](int& lowest, int owner) { lowest = std::min(lowest, owner); }));
}

/// The part's nodes in sets, whichever rank knows it. Collective.
/// @param names whose sets are those of all ranks
template <int dim>
NodeSets complete_node_sets(const Directory& nodes, const Mesh<dim>& names, const Mesh<dim>& part) {
  NodeSets complete;
  for (const auto& [name, nobody] : names.node_sets) {
    std::vector<char> are_in(nodes.n_own(), 0);
    if (const auto known = part.node_sets.find(name); known != part.node_sets.end()) {
      for (const int node : known->second) are_in[node] = 1;
    }
    are_in = nodes.answers(nodes.collect(are_in, char{0}, [](char& is_in, char said) { is_in |= said; }));
    auto& set = complete[name];
    for (std::size_t node = 0; node < are_in.size(); ++node) {
      if (are_in[node] != 0) set.push_back(static_cast<int>(node));
    }
  }
  return complete;
}

/// Per rank, those of the part's own elements that will be active there, ascending.
template <int dim>
std::vector<std::vector<int>> active_on(int n_ranks, const Mesh<dim>& part, const Owners& owners) {
  std::vector<const HangingNode*> hanging(part.n_nodes(), nullptr);
  for (const auto& one : part.hanging_nodes) hanging[one.node] = &one;
  std::vector<std::vector<int>> active(n_ranks);
  std::vector<int> ranks;
  for (int e = 0; e < part.n_owned_elements; ++e) {
    ranks = {owners.elements[e]};
    for (int c = 0; c < part.n_corners(e); ++c) {
      const int node = part.corners_of(e)[c];
      ranks.push_back(owners.nodes[node]);
      if (hanging[node] == nullptr) continue;
      for (int i = 0; i < hanging[node]->n_parents; ++i) ranks.push_back(owners.nodes[hanging[node]->parents[i]]);
    }
    std::sort(ranks.begin(), ranks.end());
    ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
    for (const int rank : ranks) active[rank].push_back(e);
  }
  return active;
}

/// What hangs on what, by ids.
struct Hanging {
  GlobalId node;
  int n_parents;
  std::array<GlobalId, 4> parents;
};

/// Of the nodes of some elements.
template <int dim>
std::vector<Hanging> hanging_at(const Mesh<dim>& part, const std::vector<int>& elements) {
  std::vector<Hanging> found;
  if (part.hanging_nodes.empty()) return found;
  std::vector<char> is_there(part.n_nodes(), 0);
  for (const int e : elements) {
    for (int c = 0; c < part.n_corners(e); ++c) is_there[part.corners_of(e)[c]] = 1;
  }
  for (const auto& [node, n_parents, parents] : part.hanging_nodes) {
    if (is_there[node] == 0) continue;
    found.push_back({part.node_ids[node], n_parents, {}});
    for (int i = 0; i < n_parents; ++i) found.back().parents[i] = part.node_ids[parents[i]];
  }
  return found;
}

/// Those of which the part has the node and all parents.
template <int dim>
void add_hanging_nodes(Mesh<dim>& part, const std::vector<std::vector<Hanging>>& told) {
  if (std::all_of(told.begin(), told.end(), [](const auto& some) { return some.empty(); })) return;
  std::unordered_map<GlobalId, int> local;
  for (int n = 0; n < part.n_nodes(); ++n) local[part.node_ids[n]] = n;
  std::vector<char> is_known(part.n_nodes(), 0);
  for (const auto& some : told) {
    for (const auto& [id, n_parents, parent_ids] : some) {
      const auto node = local.find(id);
      HangingNode one{-1, n_parents, {}};
      bool is_here = node != local.end() && is_known[node->second] == 0;
      for (int i = 0; i < n_parents && is_here; ++i) {
        const auto parent = local.find(parent_ids[i]);
        is_here = parent != local.end();
        if (is_here) one.parents[i] = parent->second;
      }
      if (!is_here) continue;
      one.node = node->second;
      is_known[one.node] = 1;
      part.hanging_nodes.push_back(one);
    }
  }
  std::sort(part.hanging_nodes.begin(), part.hanging_nodes.end(),
            [](const auto& a, const auto& b) { return a.node < b.node; });
}

/// Cuts pieces out of all parts, and puts this rank's together. Collective.
template <int dim>
Mesh<dim> exchanged(const base::Comm& comm, const Mesh<dim>& part, const NodeSets& node_sets, const Owners& owners,
                    const std::vector<std::vector<int>>& needed) {
  const auto own = static_cast<std::size_t>(comm.getRank());
  std::vector<std::vector<PackedWord>> outgoing(needed.size());
  std::vector<std::vector<Hanging>> hanging(needed.size());
  std::vector<Mesh<dim>> pieces;
  base::on_all_ranks(comm, [&] {
    for (std::size_t rank = 0; rank < needed.size(); ++rank) {
      if (needed[rank].empty()) continue;
      hanging[rank] = hanging_at(part, needed[rank]);
      auto piece = cut_out(part, node_sets, owners, needed[rank]);
      if (rank == own) {
        pieces.push_back(std::move(piece));
      } else {
        outgoing[rank] = pack(piece);
      }
    }
  });
  auto incoming = base::exchange(comm, outgoing);
  const auto told = base::exchange(comm, hanging);
  Mesh<dim> result;
  base::on_all_ranks(comm, [&] {
    for (auto& words : incoming) {
      if (!words.empty()) pieces.push_back(unpack<dim>(words));
      words = {};
    }
    result = join(pieces, comm.getRank());
    add_hanging_nodes(result, told);
  });
  return result;
}

template <int dim>
void add_names(Mesh<dim>& part, const Mesh<dim>& names) {
  part.block_names = names.block_names;
  for (const auto& entry : names.node_sets) part.node_sets[entry.first];
  for (const auto& entry : names.side_sets) part.side_sets[entry.first];
  part.n_global_nodes = names.n_global_nodes;
  part.n_global_elements = names.n_global_elements;
}

/// Nodes the forces on which are forces on nodes of this rank, per local node: its own, and those that hang on them.
template <int dim>
std::vector<char> moved_nodes(const Mesh<dim>& mesh) {
  const auto is_own = [&](int node) { return mesh.node_owners[node] == mesh.rank; };
  std::vector<char> are_moved(mesh.n_nodes(), 0);
  for (int n = 0; n < mesh.n_nodes(); ++n) are_moved[n] = static_cast<char>(is_own(n));
  for (const auto& [node, n_parents, parents] : mesh.hanging_nodes) {
    if (std::any_of(parents.begin(), parents.begin() + n_parents, is_own)) are_moved[node] = 1;
  }
  return are_moved;
}

}  // namespace

template <int dim>
Mesh<dim> distribute(const base::Comm& comm, const Mesh<dim>& part, double halo_width,
                     const std::vector<double>& weights) {
  const Mesh<dim> nothing;
  const auto& from = part.rank == comm.getRank() ? part : nothing;
  base::on_all_ranks(comm, [&] {
    if (&from == &part) check_input(part, halo_width, weights);
  });
  const auto names = names_and_sizes(comm, from);
  const GlobalId n_owned = base::sum(comm, GlobalId{from.n_owned_elements});
  PERIMORPH_ASSERT(n_owned == names.n_global_elements, "{} of {} elements are owned", n_owned, names.n_global_elements);

  const Directory nodes(comm, names.n_global_nodes, real_node_ids(from));
  Owners owners;
  owners.elements = element_owners(comm, from, weights);
  owners.nodes = node_owners(nodes, from, owners.elements);
  const auto node_sets = complete_node_sets(nodes, names, from);
  const auto needed = needed_elements(comm, from, active_on(comm.getSize(), from, owners), halo_width);
  auto result = exchanged(comm, from, node_sets, owners, needed);
  add_names(result, names);
  result.notes = from.notes;
  base::on_all_ranks(comm, [&] { check_consistency(result); });
  return result;
}

template <int dim>
Mesh<dim> gather(const base::Comm& comm, const Mesh<dim>& part) {
  const Mesh<dim> nothing;
  const auto& from = part.rank == comm.getRank() ? part : nothing;
  const auto names = names_and_sizes(comm, from);
  std::vector<std::vector<int>> needed(comm.getSize());
  needed[0].resize(from.n_owned_elements);
  std::iota(needed[0].begin(), needed[0].end(), 0);
  const Owners all_on_root{std::vector<int>(from.n_owned_elements, 0), std::vector<int>(from.n_nodes(), 0)};
  auto whole = exchanged(comm, from, from.node_sets, all_on_root, needed);
  if (comm.getRank() != 0) return {};
  add_names(whole, names);
  whole.notes = from.notes;
  return whole;
}

template <int dim>
std::vector<char> active_elements(const Mesh<dim>& mesh) {
  const auto moved = moved_nodes(mesh);
  std::vector<char> active(mesh.n_elements(), 0);
  for (int e = 0; e < mesh.n_real_elements(); ++e) {
    const int* corners = mesh.corners_of(e);
    active[e] = static_cast<char>(e < mesh.n_owned_elements || std::any_of(corners, corners + mesh.n_corners(e),
                                                                           [&](int n) { return moved[n] != 0; }));
  }
  return active;
}

#define PERIMORPH_INSTANTIATE(dim)                                                                        \
  template Mesh<dim> distribute(const base::Comm&, const Mesh<dim>&, double, const std::vector<double>&); \
  template Mesh<dim> gather(const base::Comm&, const Mesh<dim>&);                                         \
  template std::vector<char> active_elements(const Mesh<dim>&);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::mesh
