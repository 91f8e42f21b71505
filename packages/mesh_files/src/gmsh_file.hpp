#pragma once

#include "mesh_file.hpp"
#include "share.hpp"

namespace perimorph::mesh_files {

/// Parses MSH 2.0 to 4.1, ASCII or binary, partitioned or not. A group without a name is called by dimension and
/// number, "surface_1". Local.
/// @param share of the nodes, and of the elements of each dimension, in the file's order; the groups are all there. A
///        binary file is read by seeking: what is not in the share is not looked at. Of others each share goes through
///        the whole text.
/// @throws UserError if the file cannot be read, is of another version or byte order, is truncated or damaged, holds
///         some of several partitions only, or has elements that are not points, lines, triangles, quadrangles,
///         tetrahedra, pyramids, prisms or hexahedra of first or second order.
MeshFile read_gmsh_file(const std::string& file, const Share& share = {});

/// Whether a file is binary and of 4.0 or later: a share of it takes a share of the time to read. False, too, for what
/// is no MSH file. Local.
bool is_binary_by_blocks(const std::string& file);

}  // namespace perimorph::mesh_files
