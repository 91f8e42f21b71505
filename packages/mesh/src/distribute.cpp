#include "perimorph/mesh/distribute.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "packed_mesh.hpp"
#include "partition.hpp"
#include "perimorph/base/errors.hpp"
#include "perimorph/base/point_tree.hpp"
#include "perimorph/mesh/sorted_sides.hpp"

namespace perimorph::mesh {

namespace {

/// Each element by its bounding ball, [length].
template <int dim>
struct Balls {
  std::vector<Point<dim>> centers;
  std::vector<double> radii;
};

template <int dim>
Balls<dim> balls_of(const Mesh<dim>& mesh) {
  Balls<dim> balls;
  for (int e = 0; e < mesh.n_elements(); ++e) {
    balls.centers.push_back(centroid(mesh, e));
    balls.radii.push_back(radius(mesh, e));
  }
  return balls;
}

/// Who owns what of a whole mesh.
struct Owners {
  std::vector<int> elements;
  std::vector<int> nodes;
};

template <int dim>
Owners owners(const Mesh<dim>& whole, std::vector<int> element_owners) {
  std::vector<int> node_owners(whole.n_nodes(), std::numeric_limits<int>::max());
  for (int e = 0; e < whole.n_elements(); ++e) {
    for (int c = 0; c < whole.n_corners(e); ++c) {
      int& owner = node_owners[whole.corners_of(e)[c]];
      owner = std::min(owner, element_owners[e]);
    }
  }
  return {std::move(element_owners), std::move(node_owners)};
}

// ---- which elements a rank needs ----

/// Some of the balls, which can be asked whether any of them comes near another one.
template <int dim>
class NearbyBalls {
 public:
  NearbyBalls(const Balls<dim>& all, const std::vector<int>& members, double reach)
      : all_(all), members_(members), reach_(reach), tree_(centers_of(all, members)) {
    for (const int m : members_) {
      box_.extend(all_.centers[m]);
      largest_radius_ = std::max(largest_radius_, all_.radii[m]);
    }
  }

  /// |c_e - c_a| <= reach + R_e + R_a for any member a.
  bool is_near(int element) const {
    const Point<dim>& center = all_.centers[element];
    const double search_radius = (reach_ + all_.radii[element] + largest_radius_) * (1. + 1e-9);
    if (box_.exteriorDistance(center) > search_radius) return false;
    return tree_.any_within(center, search_radius, [&](int m) {
      const int member = members_[m];
      return (center - all_.centers[member]).norm() <= reach_ + all_.radii[element] + all_.radii[member];
    });
  }

 private:
  static std::vector<Point<dim>> centers_of(const Balls<dim>& all, const std::vector<int>& members) {
    std::vector<Point<dim>> centers;
    for (const int m : members) centers.push_back(all.centers[m]);
    return centers;
  }

  const Balls<dim>& all_;
  const std::vector<int>& members_;
  double reach_;
  double largest_radius_ = 0.;
  Eigen::AlignedBox<double, dim> box_;
  base::PointTree<dim> tree_;
};

/// Nodes the forces on which are forces on nodes of the rank, per node: its own, and those that hang on them.
template <int dim>
std::vector<char> moved_nodes(const Mesh<dim>& whole, const std::vector<int>& node_owners, int rank) {
  std::vector<char> are_moved(whole.n_nodes(), 0);
  for (int n = 0; n < whole.n_nodes(); ++n) are_moved[n] = static_cast<char>(node_owners[n] == rank);
  for (const auto& [node, n_parents, parents] : whole.hanging_nodes) {
    if (std::any_of(parents.begin(), parents.begin() + n_parents, [&](int n) { return node_owners[n] == rank; }))
      are_moved[node] = 1;
  }
  return are_moved;
}

template <int dim>
bool has_corner_in(const Mesh<dim>& mesh, int element, const std::vector<char>& nodes) {
  const int* corners = mesh.corners_of(element);
  return std::any_of(corners, corners + mesh.n_corners(element), [&](int node) { return nodes[node] != 0; });
}

/// The rank's own elements, then all others it needs, each ascending.
template <int dim>
std::vector<int> elements_of_rank(const Mesh<dim>& whole, const Owners& owner, const Balls<dim>& balls,
                                  double halo_width, int rank) {
  const auto moved = moved_nodes(whole, owner.nodes, rank);
  std::vector<int> active;
  for (int e = 0; e < whole.n_elements(); ++e) {
    if (owner.elements[e] == rank || has_corner_in(whole, e, moved)) active.push_back(e);
  }
  const NearbyBalls<dim> active_balls(balls, active, halo_width);
  std::vector<int> own, halo;
  for (int e = 0, next = 0; e < whole.n_elements(); ++e) {
    const bool active_here = next < static_cast<int>(active.size()) && active[next] == e;
    if (active_here) ++next;
    if (owner.elements[e] == rank) {
      own.push_back(e);
    } else if (active_here || (!active.empty() && active_balls.is_near(e))) {
      halo.push_back(e);
    }
  }
  own.insert(own.end(), halo.begin(), halo.end());
  return own;
}

// ---- cutting a rank's part out of the whole ----

/// The nodes of some elements: the rank's own, then the others, each ascending.
template <int dim>
std::vector<int> nodes_of_elements(const Mesh<dim>& whole, const Owners& owner, const std::vector<int>& elements,
                                   int rank) {
  std::vector<int> nodes;
  for (const int e : elements) nodes.insert(nodes.end(), whole.corners_of(e), whole.corners_of(e) + whole.n_corners(e));
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  std::stable_partition(nodes.begin(), nodes.end(), [&](int node) { return owner.nodes[node] == rank; });
  return nodes;
}

/// Local index of each item of the whole mesh, -1 where the rank does not have it.
std::vector<int> local_indices(const std::vector<int>& items, int n_whole) {
  std::vector<int> local(n_whole, -1);
  for (std::size_t i = 0; i < items.size(); ++i) local[items[i]] = static_cast<int>(i);
  return local;
}

std::vector<int> restricted(const std::vector<int>& nodes, const std::vector<int>& local) {
  std::vector<int> kept;
  for (const int node : nodes) {
    if (local[node] >= 0) kept.push_back(local[node]);
  }
  std::sort(kept.begin(), kept.end());
  return kept;
}

std::vector<Side> restricted(const std::vector<Side>& sides_of_whole, const std::vector<int>& local) {
  std::vector<Side> kept;
  for (const Side& side : sides_of_whole) {
    if (local[side.element] >= 0) kept.push_back({local[side.element], side.side});
  }
  std::sort(kept.begin(), kept.end());
  return kept;
}

/// Those of which the rank has the node and all parents.
std::vector<HangingNode> restricted(const std::vector<HangingNode>& hanging, const std::vector<int>& local) {
  std::vector<HangingNode> kept;
  for (HangingNode one : hanging) {
    one.node = local[one.node];
    bool is_here = one.node >= 0;
    for (int i = 0; i < one.n_parents; ++i) {
      one.parents[i] = local[one.parents[i]];
      is_here = is_here && one.parents[i] >= 0;
    }
    if (is_here) kept.push_back(one);
  }
  std::sort(kept.begin(), kept.end(), [](const auto& a, const auto& b) { return a.node < b.node; });
  return kept;
}

template <int dim>
void copy_nodes(Mesh<dim>& part, const Mesh<dim>& whole, const Owners& owner, const std::vector<int>& nodes) {
  for (const int n : nodes) {
    part.coordinates.push_back(whole.coordinates[n]);
    part.node_ids.push_back(whole.node_ids[n]);
    part.node_owners.push_back(owner.nodes[n]);
    if (owner.nodes[n] == part.rank) ++part.n_owned_nodes;
  }
  part.n_global_nodes = whole.n_nodes();
}

template <int dim>
void copy_elements(Mesh<dim>& part, const Mesh<dim>& whole, const Owners& owner, const std::vector<int>& elements,
                   const std::vector<int>& local_node) {
  for (const int e : elements) {
    part.types.push_back(whole.types[e]);
    part.blocks.push_back(whole.blocks[e]);
    part.element_ids.push_back(whole.element_ids[e]);
    part.element_owners.push_back(owner.elements[e]);
    for (int c = 0; c < whole.n_corners(e); ++c) part.corners.push_back(local_node[whole.corners_of(e)[c]]);
    part.first_corner.push_back(static_cast<int>(part.corners.size()));
    if (owner.elements[e] == part.rank) ++part.n_owned_elements;
  }
  part.n_global_elements = whole.n_elements();
}

template <int dim>
Mesh<dim> cut_out(const Mesh<dim>& whole, const Owners& owner, const std::vector<int>& elements, int rank) {
  const std::vector<int> nodes = nodes_of_elements(whole, owner, elements, rank);
  const std::vector<int> local_node = local_indices(nodes, whole.n_nodes());
  const std::vector<int> local_element = local_indices(elements, whole.n_elements());

  Mesh<dim> part;
  part.rank = rank;
  copy_nodes(part, whole, owner, nodes);
  copy_elements(part, whole, owner, elements, local_node);
  part.block_names = whole.block_names;
  for (const auto& [name, set] : whole.node_sets) part.node_sets[name] = restricted(set, local_node);
  for (const auto& [name, set] : whole.side_sets) part.side_sets[name] = restricted(set, local_element);
  part.boundary = restricted(whole.boundary, local_element);
  part.hanging_nodes = restricted(whole.hanging_nodes, local_node);
  return part;
}

template <int dim>
void check_input(const Mesh<dim>& whole, double halo_width, const std::vector<double>& weights) {
  check_consistency(whole);
  PERIMORPH_ASSERT(whole.is_whole(), "{} of {} elements are here", whole.n_elements(), whole.n_global_elements);
  PERIMORPH_ASSERT(std::isfinite(halo_width) && halo_width >= 0., "the halo's width is {}", halo_width);
  PERIMORPH_ASSERT(weights.empty() || static_cast<int>(weights.size()) == whole.n_elements(),
                   "{} weights for {} elements", weights.size(), whole.n_elements());
  PERIMORPH_ASSERT(std::all_of(weights.begin(), weights.end(), [](double w) { return std::isfinite(w) && w >= 0.; }),
                   "one of {} weights is no cost", weights.size());
}

/// One message per rank.
template <int dim>
std::vector<std::vector<PackedWord>> packed_parts(const Mesh<dim>& whole, double halo_width,
                                                  const std::vector<double>& weights, int n_ranks) {
  check_input(whole, halo_width, weights);
  const Balls<dim> balls = balls_of(whole);
  const Owners owner = owners(whole, partition<dim>(balls.centers, weights, n_ranks));
  std::vector<std::vector<PackedWord>> parts;
  for (int rank = 0; rank < n_ranks; ++rank) {
    const std::vector<int> elements = elements_of_rank(whole, owner, balls, halo_width, rank);
    parts.push_back(pack(cut_out(whole, owner, elements, rank)));
  }
  return parts;
}

}  // namespace

template <int dim>
Mesh<dim> distribute(const base::Comm& comm, const Mesh<dim>& whole, double halo_width,
                     const std::vector<double>& weights) {
  std::vector<std::vector<PackedWord>> outgoing(comm.getSize());
  base::on_all_ranks(comm, [&] {
    if (comm.getRank() == 0) outgoing = packed_parts(whole, halo_width, weights, comm.getSize());
  });
  const auto incoming = base::exchange(comm, outgoing);

  Mesh<dim> part;
  base::on_all_ranks(comm, [&] {
    part = unpack<dim>(incoming[0]);
    check_consistency(part);
  });
  return part;
}

template <int dim>
std::vector<char> active_elements(const Mesh<dim>& mesh) {
  const auto moved = moved_nodes(mesh, mesh.node_owners, mesh.rank);
  std::vector<char> active(mesh.n_elements(), 0);
  for (int e = 0; e < mesh.n_real_elements(); ++e) {
    active[e] = static_cast<char>(e < mesh.n_owned_elements || has_corner_in(mesh, e, moved));
  }
  return active;
}

#define PERIMORPH_INSTANTIATE(dim)                                                                        \
  template Mesh<dim> distribute(const base::Comm&, const Mesh<dim>&, double, const std::vector<double>&); \
  template std::vector<char> active_elements(const Mesh<dim>&);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::mesh
