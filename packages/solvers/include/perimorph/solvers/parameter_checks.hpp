#pragma once

#include <string>
#include <vector>

#include "perimorph/solvers/linear_solver.hpp"

namespace perimorph::solvers {

/// A parameter for Belos or MueLu that these do not know, of another type, or with a value on which they crash.
struct RefusedParameter {
  std::string path;  ///< "Belos/Name" or "MueLu/Name"
  std::string what;  ///< was found, and is allowed
};

/// Of the overrides. What stands in lists within MueLu's, such as the parameters of a smoother, is not looked at.
/// Local.
std::vector<RefusedParameter> refused_parameters(const SolverParameters& parameters);

}  // namespace perimorph::solvers
