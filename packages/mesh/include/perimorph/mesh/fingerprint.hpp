#pragma once

#include "perimorph/mesh/mesh.hpp"

namespace perimorph::mesh {

/// A number that tells two whole meshes apart: of coordinates (to the last bit), elements, blocks, and groups with
/// their names. The same for a mesh on every machine of the same byte order. Local.
/// @param whole a mesh of which all elements are here
template <int dim>
GlobalId fingerprint(const Mesh<dim>& whole);

}  // namespace perimorph::mesh
