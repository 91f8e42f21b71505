#pragma once

#include "perimorph/base/parallel.hpp"
#include "perimorph/mesh/mesh.hpp"

namespace perimorph::mesh {

/// A number that tells two meshes apart: of elements, their corners' coordinates (to the last bit), blocks, and groups
/// with their names. The same for a mesh on every machine of the same byte order, whichever rank has what of it.
/// Collective.
/// @param part a whole mesh on rank 0, or what each rank has of it
template <int dim>
GlobalId fingerprint(const base::Comm& comm, const Mesh<dim>& part);

}  // namespace perimorph::mesh
