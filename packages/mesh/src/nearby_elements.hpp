#pragma once

#include <vector>

#include "perimorph/base/parallel.hpp"
#include "perimorph/mesh/mesh.hpp"

namespace perimorph::mesh {

/// Which elements that this rank owns other ranks need, by what is active there. Collective.
/// @param active per rank, those of the part's own elements that are active there, ascending
/// @param halo_width [length]
/// @return per rank, those, and all others of which some point may lie within halo_width of an active one of that
///         rank, |c_e - c_a| <= halo_width + R_e + R_a, ascending
template <int dim>
std::vector<std::vector<int>> needed_elements(const base::Comm& comm, const Mesh<dim>& part,
                                              const std::vector<std::vector<int>>& active, double halo_width);

}  // namespace perimorph::mesh
