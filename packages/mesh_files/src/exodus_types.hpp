#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "mesh_file.hpp"

namespace perimorph::mesh_files {

/// A type of elements of which a body can consist.
struct PlaneOrSolid {
  Shape shape;
  bool is_shell;  ///< plane, and its first two sides are its faces
};

/// What a block's type stands for, as programs that write Exodus files spell it: by the letters at its beginning, and
/// the number of nodes. None if it is not known.
std::optional<PlaneOrSolid> plane_or_solid(const std::string& type, std::int64_t n_nodes);

/// Whether a type is none of those for masses, bars and the like.
bool has_body(const std::string& type);

}  // namespace perimorph::mesh_files
