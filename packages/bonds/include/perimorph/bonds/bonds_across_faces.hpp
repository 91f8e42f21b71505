#pragma once

#include <vector>

#include "perimorph/bonds/bond.hpp"
#include "perimorph/elements/material_points.hpp"
#include "perimorph/mesh/pre_crack.hpp"

namespace perimorph::bonds {

/// The bonds that there would be, were it not for cracks in the undeformed body: pre-cracks, and slits without width in
/// the mesh. They carry contact alone and have no number. Ordered by elements; each rank finds those that touch its
/// active elements. Local.
/// @param active per local element
/// @param horizon > 0, [length]
/// @param pre_cracks the same on all ranks, (n), [length]
template <int dim>
std::vector<Bond<dim>> bonds_across_faces(const mesh::Mesh<dim>& mesh, const elements::MaterialPoints<dim>& points,
                                          const std::vector<char>& active, double horizon,
                                          const std::vector<mesh::CrackFacet<dim>>& pre_cracks);

}  // namespace perimorph::bonds
