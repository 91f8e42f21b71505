#pragma once

#include <string>

namespace perimorph::mesh_files {

/// Whether a geometry may run commands and write files: it is a program, and may come from anywhere.
enum class SideEffects { refused, allowed };

/// What gmsh may do and take to mesh a geometry.
struct MeshingLimits {
  SideEffects side_effects = SideEffects::refused;
  double minutes = 60.;  ///< a geometry may loop forever
};

/// Whether a file is a geometry by its name, .geo. Local.
bool is_geometry(const std::string& file);

/// Runs gmsh (a separate process) on a .geo file and keeps the result as msh_file (MSH 4.1 binary). Local.
/// @param dimension 2 or 3: surfaces or volumes are meshed
/// @param limits unless side effects are allowed, gmsh's process can start no other
/// @throws UserError with gmsh's own last messages if it fails or gmsh is not installed; if the geometry runs commands
///         or writes files without being allowed to; if it takes too long. ComputationError if a signal asks this
///         process to stop meanwhile.
void mesh_geometry(const std::string& geo_file, const std::string& msh_file, int dimension,
                   const MeshingLimits& limits = {});

}  // namespace perimorph::mesh_files
