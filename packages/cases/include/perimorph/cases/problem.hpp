#pragma once

#include <string>
#include <vector>

#include "perimorph/base/parallel.hpp"
#include "perimorph/cases/case.hpp"
#include "perimorph/mesh/mesh.hpp"
#include "perimorph/model/problem.hpp"

namespace perimorph::cases {

/// A case in the terms of the packages that compute it. Local.
/// @throws UserError if its numbers, together, give some that are not finite or zero.
template <int dim>
model::Problem<dim> make_problem(const Case& input);

/// Whether compressive strengths are those that bonds can have, once critical stretches are known. Local.
/// @param problem of this case, calibrated
/// @throws UserError
template <int dim>
void check_compressive_strengths(const Case& input, const model::Problem<dim>& problem);

template <int dim>
struct CheckedMesh {
  mesh::Mesh<dim> mesh;               ///< whole on rank 0 and empty on others, or what each rank has of it
  std::vector<std::string> warnings;  ///< of what can be computed, but is hardly meant so; on rank 0
};

/// Reads the case's mesh on rank 0 (a .geo file is meshed by gmsh first, and the mesh kept in the folder), opens it
/// along the pre-cracks and checks the case against it. Collective.
/// @throws UserError, on all ranks.
template <int dim>
CheckedMesh<dim> read_whole_mesh(const base::Comm& comm, const Case& input, const std::string& folder);

/// The same of a mesh that no rank holds as a whole, if its file can be read in parts, nothing is wrong with it,
/// nothing is to be said, and the case leaves it as it is; otherwise the whole mesh. Collective. @throws UserError, as
/// above.
template <int dim>
CheckedMesh<dim> read_mesh(const base::Comm& comm, const Case& input, const std::string& folder);

}  // namespace perimorph::cases
