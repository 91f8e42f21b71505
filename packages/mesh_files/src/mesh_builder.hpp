#pragma once

#include "mesh_file.hpp"
#include "perimorph/base/parallel.hpp"
#include "perimorph/mesh/mesh.hpp"

namespace perimorph::mesh_files {

/// Turns what a file says into a mesh, boundary included, and checks it on the way: the one place for what all
/// formats have in common. Groups of the mesh's own dimension become blocks, those of lower dimension node sets, those
/// of dimension dim-1 also side sets (the side of the element with the lower id where two share it). Reversed elements
/// are turned, nodes of no element dropped, groups that do not fit left out, each with a note in the mesh of rank 0.
/// Each rank gives a slice of the file and gets a part of the mesh; none has all of either. Collective.
/// @param slice one after the other, the ranks' nodes are those of the file in its order, and so are the elements of
///        dimension dim; elements of lower dimension are on any rank, each once. group_names, name, advice and
///        sides_follow_from_node_sets are the same on all ranks; n_plane_bodies, n_second_order and mid_nodes are
///        shares of the file's
/// @param scale factor on all coordinates, > 0, [-]
/// @return the part that mesh::distribute() gives this rank, with a halo of width 0. Nodes and elements are numbered in
///         the file's order
/// @throws UserError naming file, element or group, the same on all ranks: no elements of dimension dim, or some of a
///         higher one; degenerate or overlapping elements; unknown nodes, a 2D mesh that is not plane; elements in no
///         group or in two; groups of one name.
template <int dim>
mesh::Mesh<dim> build_parts(const base::Comm& comm, const MeshFile& slice, double scale);

/// The same of a whole file, as a whole mesh. Local.
template <int dim>
mesh::Mesh<dim> build_mesh(const MeshFile& file, double scale);

}  // namespace perimorph::mesh_files
