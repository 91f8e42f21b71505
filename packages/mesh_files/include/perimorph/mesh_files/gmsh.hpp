#pragma once

#include <string>

namespace perimorph::mesh_files {

/// Runs gmsh (a separate process) on a .geo file and keeps the result as msh_file (MSH 4.1 binary). Local.
/// @param dimension 2 or 3: surfaces or volumes are meshed
/// @throws UserError with gmsh's own last messages if it fails or gmsh is not installed.
void mesh_geometry(const std::string& geo_file, const std::string& msh_file, int dimension);

}  // namespace perimorph::mesh_files
