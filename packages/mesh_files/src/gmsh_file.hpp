#pragma once

#include "mesh_file.hpp"
#include "perimorph/base/parallel.hpp"
#include "share.hpp"

namespace perimorph::mesh_files {

/// Parses MSH 2.0 to 4.1, ASCII or binary, partitioned or not. A group without a name is called by dimension and
/// number, "surface_1". Local.
/// @param share of the nodes, and of the elements of each dimension, in the file's order; the groups are all there. Of
///        binary 4.x only what is in the share is looked at; of others all is gone through, but not kept.
/// @throws UserError if the file cannot be read, is of another version or byte order, is truncated or damaged, holds
///         some of several partitions only, or has elements that are not points, lines, triangles, quadrangles,
///         tetrahedra, pyramids, prisms or hexahedra of first or second order.
MeshFile read_gmsh_file(const std::string& file, const Share& share = {});

/// The same, each rank its share; rank 0 counts what the file has before. Collective.
MeshFile read_gmsh_file(const base::Comm& comm, const std::string& file);

}  // namespace perimorph::mesh_files
