#pragma once

#include "mesh_file.hpp"
#include "perimorph/mesh/mesh.hpp"

namespace perimorph::mesh_files {

/// Turns what a file says into a whole mesh, boundary included, and checks it on the way: the one place for what all
/// formats have in common. Groups of the mesh's own dimension become blocks, those of lower dimension node sets, those
/// of dimension dim-1 also side sets (the side of the element with the lower id where two share it). Reversed elements
/// are turned, nodes of no element dropped, groups that do not fit left out, each with a note in the mesh. Local.
/// @param scale factor on all coordinates, > 0, [-]
/// @throws UserError naming file, element or group: no elements of dimension dim, or some of a higher one; degenerate
/// or
///         overlapping elements; unknown nodes, a 2D mesh that is not plane; elements in no group or in two; groups of
///         one name.
template <int dim>
mesh::Mesh<dim> build_mesh(const MeshFile& file, double scale);

}  // namespace perimorph::mesh_files
