#pragma once

#include <string>
#include <vector>

namespace perimorph::mesh_files {

/// The first command of a geometry, or of what it includes, that runs a program or writes a file, where it stands and
/// what it does: "plate.geo:3: SystemCall runs a command". "" if there is none. Local.
std::string command_beyond_meshing(const std::string& geometry);

/// Whether gmsh would pass over the last command: it does where the last line has several, and no line break. Local.
bool ignores_last_command(const std::string& geometry);

/// Commands of a geometry whose effect on a mesh is lost when it is meshed after them. Local.
std::vector<std::string> undone_commands(const std::string& geometry);

}  // namespace perimorph::mesh_files
