#pragma once

#include <Eigen/Geometry>
#include <numeric>
#include <vector>

#include "perimorph/base/parallel.hpp"
#include "perimorph/mesh/mesh.hpp"

namespace perimorph::mesh {

/// The box around some local nodes of all ranks, [length]; empty if there are none. Collective.
template <int dim>
Eigen::AlignedBox<double, dim> box_around(const base::Comm& comm, const Mesh<dim>& mesh,
                                          const std::vector<int>& nodes) {
  Eigen::AlignedBox<double, dim> box;
  for (const int node : nodes) box.extend(mesh.coordinates[node]);
  for (int c = 0; c < dim; ++c) {
    box.min()[c] = -base::max(comm, -box.min()[c]);
    box.max()[c] = base::max(comm, box.max()[c]);
  }
  return box;
}

/// The box around a body, [length]. Collective. @param mesh whole, or one rank's part
template <int dim>
Eigen::AlignedBox<double, dim> box_around(const base::Comm& comm, const Mesh<dim>& mesh) {
  std::vector<int> all(mesh.n_nodes());
  std::iota(all.begin(), all.end(), 0);
  return box_around(comm, mesh, all);
}

}  // namespace perimorph::mesh
