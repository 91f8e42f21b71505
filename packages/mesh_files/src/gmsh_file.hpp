#pragma once

#include "mesh_file.hpp"

namespace perimorph::mesh_files {

/// Parses MSH 4.1 or 2.2, ASCII or binary. A group without a name is called by dimension and number, "surface_1".
/// Local.
/// @throws UserError if the file cannot be read, is of another version or byte order, is truncated or damaged, or has
///         elements that are not linear points, lines, triangles, quadrangles, tetrahedra, pyramids, prisms or
///         hexahedra.
MeshFile read_gmsh_file(const std::string& file);

}  // namespace perimorph::mesh_files
