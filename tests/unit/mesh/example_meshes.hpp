#pragma once

// Small meshes for the tests of this folder.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>

#include "perimorph/mesh/mesh.hpp"

namespace perimorph::mesh {

/// Offsets of the corners of a quadrangle (the first four, in the plane) or hexahedron.
constexpr int corner_offsets[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                      {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};

template <int dim>
int grid_index(const std::array<int, dim>& position, const std::array<int, dim>& counts) {
  int index = 0;
  for (int d = dim - 1; d >= 0; --d) index = index * counts[d] + position[d];
  return index;
}

template <int dim>
std::array<int, dim> grid_position(int index, const std::array<int, dim>& counts) {
  std::array<int, dim> position;
  for (int d = 0; d < dim; ++d) {
    position[d] = index % counts[d];
    index /= counts[d];
  }
  return position;
}

/// A whole mesh of n[0] x n[1] (x n[2]) unit cells from the origin, x fastest. Blocks "west" and "east" by half; node
/// set "corner" (the origin), node and side set "left" (x = 0).
template <int dim>
Mesh<dim> grid(const std::array<int, dim>& n) {
  Mesh<dim> mesh;
  std::array<int, dim> n_points;
  for (int d = 0; d < dim; ++d) n_points[d] = n[d] + 1;
  const auto product = [](const auto& counts) {
    return std::accumulate(counts.begin(), counts.end(), 1, std::multiplies<>());
  };

  for (int p = 0; p < product(n_points); ++p) {
    const auto position = grid_position<dim>(p, n_points);
    auto& point = mesh.coordinates.emplace_back();
    for (int d = 0; d < dim; ++d) point[d] = position[d];
    if (position[0] == 0) mesh.node_sets["left"].push_back(p);
  }
  mesh.node_sets["corner"] = {0};

  constexpr int n_cell_corners = 1 << dim;
  constexpr int left_side = 3;
  for (int e = 0; e < product(n); ++e) {
    const auto cell = grid_position<dim>(e, n);
    for (int c = 0; c < n_cell_corners; ++c) {
      auto corner = cell;
      for (int d = 0; d < dim; ++d) corner[d] += corner_offsets[c][d];
      mesh.corners.push_back(grid_index<dim>(corner, n_points));
    }
    mesh.first_corner.push_back(static_cast<int>(mesh.corners.size()));
    mesh.types.push_back(dim == 2 ? ElementType::quad4 : ElementType::hex8);
    mesh.blocks.push_back(2 * cell[0] < n[0] ? 0 : 1);
    if (cell[0] == 0) mesh.side_sets["left"].push_back({e, left_side});
  }
  mesh.block_names = {"west", "east"};

  mesh.n_owned_nodes = mesh.n_nodes();
  mesh.n_owned_elements = mesh.n_elements();
  mesh.n_global_nodes = mesh.n_nodes();
  mesh.n_global_elements = mesh.n_elements();
  mesh.node_owners.assign(mesh.n_nodes(), 0);
  mesh.element_owners.assign(mesh.n_elements(), 0);
  mesh.node_ids.resize(mesh.n_nodes());
  mesh.element_ids.resize(mesh.n_elements());
  std::iota(mesh.node_ids.begin(), mesh.node_ids.end(), GlobalId{0});
  std::iota(mesh.element_ids.begin(), mesh.element_ids.end(), GlobalId{0});
  find_boundary(mesh);
  return mesh;
}

/// Moves every node a little, so that no two elements are alike.
template <int dim>
void perturb(Mesh<dim>& mesh) {
  for (int n = 0; n < mesh.n_nodes(); ++n) {
    for (int d = 0; d < dim; ++d) mesh.coordinates[n][d] += 0.2 * std::sin(12.9898 * n + 78.233 * d);
  }
}

inline bool operator==(const Side& a, const Side& b) { return a.element == b.element && a.side == b.side; }

template <int dim>
void expect_same(const Mesh<dim>& a, const Mesh<dim>& b, double tolerance = 1e-14) {
  ASSERT_EQ(a.n_nodes(), b.n_nodes());
  // ASCII files have 16 digits.
  for (int n = 0; n < a.n_nodes(); ++n) EXPECT_LT((a.coordinates[n] - b.coordinates[n]).norm(), tolerance);
  EXPECT_EQ(a.types, b.types);
  EXPECT_EQ(a.corners, b.corners);
  EXPECT_EQ(a.first_corner, b.first_corner);
  EXPECT_EQ(a.block_names, b.block_names);
  EXPECT_EQ(a.blocks, b.blocks);
  EXPECT_EQ(a.node_sets, b.node_sets);
  EXPECT_EQ(a.side_sets, b.side_sets);
  EXPECT_EQ(a.boundary, b.boundary);
}

}  // namespace perimorph::mesh
