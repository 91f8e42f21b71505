#include "perimorph/mesh/perturbation.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "perimorph/base/errors.hpp"
#include "perimorph/mesh/orientation.hpp"
#include "perimorph/mesh/sorted_sides.hpp"

namespace perimorph::mesh {

namespace {

/// A number that looks random: the finalizer of MurmurHash3.
std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ x >> 33u) * 0xFF51AFD7ED558CCDu;
  x = (x ^ x >> 33u) * 0xC4CEB9FE1A85EC53u;
  return x ^ x >> 33u;
}

/// From -1 to 1.
double random_number(std::uint64_t key, int component) {
  const auto bits = mixed(key + 0x9E3779B97F4A7C15u * static_cast<std::uint64_t>(component + 1)) >> 11u;
  return static_cast<double>(bits) / static_cast<double>(std::uint64_t{1} << 52u) - 1.;
}

template <int dim>
std::vector<char> movable_nodes(const Mesh<dim>& mesh, const std::vector<char>& are_meant) {
  std::vector<char> may_move(mesh.n_nodes(), 1);
  std::vector<int> block_at(mesh.n_nodes(), -1);
  for (int e = 0; e < mesh.n_elements(); ++e) {
    for (int k = 0; k < mesh.n_corners(e); ++k) {
      const int node = mesh.corners_of(e)[k];
      const bool is_other = block_at[node] >= 0 && block_at[node] != mesh.blocks[e];
      if (are_meant[e] == 0 || is_other) may_move[node] = 0;
      block_at[node] = mesh.blocks[e];
    }
  }
  const auto keep = [&](const std::vector<int>& nodes) {
    for (const int node : nodes) may_move[node] = 0;
  };
  for (const auto& entry : mesh.node_sets) keep(entry.second);
  for (const auto& side : mesh.boundary) keep(side_nodes(mesh, side));
  for (const auto& [node, n_parents, parents] : mesh.hanging_nodes) {
    keep({node});
    keep({parents.begin(), parents.begin() + n_parents});
  }
  return may_move;
}

template <int dim>
std::vector<double> shortest_edges(const Mesh<dim>& mesh) {
  std::vector<double> shortest(mesh.n_nodes(), std::numeric_limits<double>::infinity());
  for (int e = 0; e < mesh.n_elements(); ++e) {
    for (const auto& edge : edges(mesh.types[e])) {
      const int one = mesh.corners_of(e)[edge[0]], other = mesh.corners_of(e)[edge[1]];
      const double length = (mesh.coordinates[one] - mesh.coordinates[other]).norm();
      shortest[one] = std::min(shortest[one], length);
      shortest[other] = std::min(shortest[other], length);
    }
  }
  return shortest;
}

template <int dim>
std::vector<double> shapes(const Mesh<dim>& mesh) {
  std::vector<double> all;
  for (int e = 0; e < mesh.n_elements(); ++e) all.push_back(smallest_corner_volume(mesh, e));
  return all;
}

}  // namespace

std::vector<std::uint64_t> node_keys(int n_nodes) {
  std::vector<std::uint64_t> keys(n_nodes);
  std::iota(keys.begin(), keys.end(), 1);
  std::transform(keys.begin(), keys.end(), keys.begin(), mixed);
  return keys;
}

template <int dim>
void perturb(Mesh<dim>& whole, double share, const std::vector<std::uint64_t>& keys,
             const std::vector<char>& are_meant) {
  constexpr double flattest = 0.5;  // of the shape it had
  PERIMORPH_ASSERT(share >= 0. && share <= 0.5, "nodes moved by {} of their edges", share);
  PERIMORPH_ASSERT(
      static_cast<int>(keys.size()) == whole.n_nodes() && static_cast<int>(are_meant.size()) == whole.n_elements(),
      "{} keys for {} nodes, {} marks for {} elements", keys.size(), whole.n_nodes(), are_meant.size(),
      whole.n_elements());
  const auto before = whole.coordinates;
  const auto may_move = movable_nodes(whole, are_meant);
  const auto reach = shortest_edges(whole);
  const auto shapes_before = shapes(whole);
  for (int n = 0; n < whole.n_nodes(); ++n) {
    for (int c = 0; c < dim && may_move[n] != 0; ++c) {
      whole.coordinates[n][c] += share * reach[n] * random_number(keys[n], c);
    }
  }
  for (bool is_sound = false; !is_sound;) {
    is_sound = true;
    for (int e = 0; e < whole.n_elements(); ++e) {
      if (smallest_corner_volume(whole, e) >= flattest * shapes_before[e]) continue;
      for (int k = 0; k < whole.n_corners(e); ++k) {
        const int node = whole.corners_of(e)[k];
        is_sound = is_sound && whole.coordinates[node] == before[node];
        whole.coordinates[node] = before[node];
      }
    }
  }
}

template void perturb(Mesh<2>&, double, const std::vector<std::uint64_t>&, const std::vector<char>&);
template void perturb(Mesh<3>&, double, const std::vector<std::uint64_t>&, const std::vector<char>&);

}  // namespace perimorph::mesh
