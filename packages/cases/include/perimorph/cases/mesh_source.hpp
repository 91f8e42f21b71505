#pragma once

#include <optional>
#include <string>

#include "perimorph/input/section.hpp"
#include "perimorph/input/values.hpp"
#include "perimorph/mesh_files/gmsh.hpp"
#include "perimorph/model/numerical_options.hpp"

namespace perimorph::cases {

/// Where the body comes from.
struct MeshSource {
  std::string file;                 ///< in a case as read: resolved against the case file's folder
  double scale = 1.;                ///< factor on its coordinates [-]
  std::optional<double> thickness;  ///< in two dimensions, [length]; 1 if it is not given
  /// For a geometry. Side effects are no parameter: a case must not allow itself any.
  mesh_files::MeshingLimits meshing;
};

void declare(const input::Section& section, MeshSource& mesh, model::NumericalOptions& numerical);

void check_mesh_source(const input::Values& section, int dimension);

}  // namespace perimorph::cases
