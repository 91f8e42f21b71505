#pragma once

#include <string>

#include "perimorph/base/parallel.hpp"
#include "perimorph/cases/case.hpp"
#include "perimorph/mesh/mesh.hpp"
#include "perimorph/model/problem.hpp"

namespace perimorph::cases {

/// A case in the terms of the packages that compute it. Local.
template <int dim>
model::Problem<dim> make_problem(const Case& input);

/// Reads the case's mesh on rank 0 (a .geo file is meshed by gmsh first, and the mesh kept in the folder), opens it
/// along the pre-cracks and checks the case against it. The mesh is whole on rank 0, empty on others. Collective.
/// @throws UserError, on all ranks.
template <int dim>
mesh::Mesh<dim> read_whole_mesh(const base::Comm& comm, const Case& input, const std::string& folder);

}  // namespace perimorph::cases
