#pragma once

#include <string>

#include "perimorph/input/section.hpp"
#include "perimorph/mesh_files/gmsh.hpp"

namespace perimorph::cases {

/// Where the body comes from.
struct MeshSource {
  std::string file;   ///< in a case as read: resolved against the case file's folder
  double scale = 1.;  ///< factor on its coordinates [-]
  /// For a geometry. Side effects are no parameter: a case must not allow itself any.
  mesh_files::MeshingLimits meshing;
};

void declare(const input::Section& section, MeshSource& mesh);

}  // namespace perimorph::cases
