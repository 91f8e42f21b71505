#pragma once

#include <string>

namespace perimorph::mesh_files {

enum class MeshFormat { unknown, gmsh, exodus, ansys, abaqus };

/// What a file is, by its first bytes or lines; only if they say nothing, by its ending. Local.
MeshFormat format_of(const std::string& file);

}  // namespace perimorph::mesh_files
