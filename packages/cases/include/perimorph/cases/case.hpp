#pragma once

#include <Teuchos_ParameterList.hpp>
#include <map>
#include <string>
#include <vector>

#include "perimorph/cases/boundary_conditions.hpp"
#include "perimorph/cases/loading.hpp"
#include "perimorph/cases/material.hpp"
#include "perimorph/cases/mesh_source.hpp"
#include "perimorph/cases/morphing.hpp"
#include "perimorph/cases/output.hpp"
#include "perimorph/cases/peridynamics.hpp"
#include "perimorph/cases/pre_cracks.hpp"
#include "perimorph/cases/solver.hpp"
#include "perimorph/model/numerical_options.hpp"

namespace perimorph::cases {

/// Everything that a case file says, complete and checked by itself (not yet against the mesh): its sections, and the
/// numerical options that several of them fill.
struct Case {
  std::string file;       ///< of the case, as given
  std::string directory;  ///< where relative file names in it start
  std::string name;       ///< the file's name without its ending: names the results
  std::string title;
  int dimension = 2;

  MeshSource mesh;
  Material material;
  std::vector<Solid> materials;  ///< beside it
  std::vector<Interface> interfaces;
  Peridynamics peridynamics;
  Morphing morphing;
  std::vector<PreCrack> pre_cracks;
  BoundaryConditions boundary_conditions;
  Loading loading;
  Solver solver;
  Output output;
  model::NumericalOptions numerical;

  Teuchos::ParameterList resolved;   ///< every parameter with its value, defaults filled in
  std::map<std::string, int> lines;  ///< "/Section/Name" -> line in the file; 0: on the command line
};

/// The material of the body, and then the others. Local.
std::vector<Solid> solids_of(const Case& input);

/// Whether any of them breaks. Local.
bool can_break(const Case& input);

/// Every parameter with default, documentation and rule (input/resolved.hpp). Local.
Teuchos::ParameterList case_schema();

/// Reads and checks a case file; overrides are "Section/Sub/Name=value". Local.
/// @throws UserError that lists ALL mistakes, one a line, "file:line: /path: what was found; what is allowed"; if there
///         are any, also what of the rest does not fit the mesh.
/// @param side_effects whether a geometry may run commands and write files
Case read_case(const std::string& file, const std::vector<std::string>& overrides = {},
               mesh_files::SideEffects side_effects = mesh_files::SideEffects::refused);

/// The parameters that decide what a run computes, with their values, a line each: a run that goes on from a checkpoint
/// must have the same. Local.
std::string deciding_lines(const Case& input);

}  // namespace perimorph::cases
