#pragma once

#include <vector>

#include "perimorph/base/parallel.hpp"
#include "perimorph/mesh/mesh.hpp"

namespace perimorph::mesh {

/// Parts a whole mesh (on rank 0; ignored elsewhere) among the ranks by Zoltan2's multijagged algorithm on element
/// centroids. A node belongs to the lowest rank that owns an element around it. Every rank gets its own elements, all
/// elements around its own nodes ("active" elements), and as halo every element of which some point may lie within
/// halo_width of an active one: |c_e - c_a| <= halo_width + R_e + R_a. Collective.
/// @param weights cost of each element of the whole mesh (on rank 0), or empty for equal costs
/// @param halo_width the horizon, [length]
template <int dim>
Mesh<dim> distribute(const base::Comm& comm, const Mesh<dim>& whole, double halo_width,
                     const std::vector<double>& weights = {});

/// Per local element: owned here, or around a node owned here. The rows of this rank's matrix come from these.
template <int dim>
std::vector<char> active_elements(const Mesh<dim>& mesh);

}  // namespace perimorph::mesh
