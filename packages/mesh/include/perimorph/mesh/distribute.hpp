#pragma once

#include <vector>

#include "perimorph/base/parallel.hpp"
#include "perimorph/mesh/mesh.hpp"

namespace perimorph::mesh {

/// Partitions a whole mesh (on rank 0; ignored elsewhere) among the ranks by Zoltan2's multijagged algorithm on element
/// centroids. A node belongs to the lowest rank that owns an element around it. Every rank gets its own elements, all
/// elements around its own nodes and around those that hang on them ("active" elements), and as halo every element of
/// which some point may lie within halo_width of an active one: |c_e - c_a| <= halo_width + R_e + R_a. Collective.
/// @param whole what read_mesh() and open_along() made, on rank 0
/// @param halo_width how far beyond its active elements a rank must see, such as the horizon, [length]
/// @param weights cost of each element of the whole mesh, (n_elements), on rank 0, in any unit; empty for equal costs
/// @return this rank's part
/// @throws Bug on all ranks if the mesh is not whole or a cost is negative
template <int dim>
Mesh<dim> distribute(const base::Comm& comm, const Mesh<dim>& whole, double halo_width,
                     const std::vector<double>& weights = {});

/// Per local element, (n_elements): owned here, or around a node owned here, or around one that hangs on such a node.
/// The rows of this rank's matrix come from these.
template <int dim>
std::vector<char> active_elements(const Mesh<dim>& mesh);

}  // namespace perimorph::mesh
