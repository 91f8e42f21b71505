#pragma once

#include <vector>

#include "perimorph/bonds/bond_families.hpp"

namespace perimorph::bonds {

/// The surface of cracks that have grown: the sides of owned elements (edges in 2D, faces in 3D) behind which at least
/// half of the bonds between the two elements are broken, ascending. A crack between two elements shows up once for
/// either of them. Sides along pre-cracks are the body's boundary, and not among them. Local.
template <int dim>
std::vector<mesh::Side> broken_surface(const mesh::Mesh<dim>& mesh, const BondFamilies<dim>& bonds);

}  // namespace perimorph::bonds
