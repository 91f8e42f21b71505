#pragma once

#include "mesh_file.hpp"

namespace perimorph::mesh_files {

/// Parses MSH 2.0 to 4.1, ASCII or binary, partitioned or not. A group without a name is called by dimension and
/// number, "surface_1". Local.
/// @throws UserError if the file cannot be read, is of another version or byte order, is truncated or damaged, holds
///         some of several partitions only, or has elements that are not points, lines, triangles, quadrangles,
///         tetrahedra, pyramids, prisms or hexahedra of first or second order.
MeshFile read_gmsh_file(const std::string& file);

}  // namespace perimorph::mesh_files
