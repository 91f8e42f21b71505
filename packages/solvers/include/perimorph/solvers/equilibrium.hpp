#pragma once

#include <string>

#include "perimorph/operators/nonlinear_system.hpp"
#include "perimorph/solvers/linear_solver.hpp"

namespace perimorph::solvers {

/// How well the forces are to balance.
struct BalanceTarget {
  double tolerance;  ///< residual over reactions [-]
  /// Below which reactions say nothing of the load, [force]; follows the solutions.
  double& force_scale;
  /// Whether pieces may float: all bonds hold otherwise, and the anchors of the tangent are hardly needed.
  bool may_float;
};

/// Finds the displacement at which forces balance, by Newton's method with conjugate gradients for each correction. A
/// system whose terms are all linear takes one correction, but for what the tangent is not exact in.
class Equilibrium {
 public:
  /// Collective. @param profile must outlive this
  Equilibrium(const base::Comm& comm, SolverParameters parameters, base::Profile& profile)
      : solver_(comm, std::move(parameters), profile) {}

  /// The solver of the corrections; new operators and changed values are handed to it.
  LinearSolver& linear_solver() { return solver_; }
  const LinearSolver& linear_solver() const { return solver_; }

  struct Outcome {
    bool converged;
    int linear_solves, cg_iterations;
    std::string trouble;  ///< why it did not
  };

  /// Corrects u until the residual is at most the tolerance times the reactions (DECISIONS.md, 34). Collective.
  /// @param system evaluated at u
  /// @param u on all local degrees of freedom, [length]
  Outcome find(operators::NonlinearSystem& system, base::Field u, const BalanceTarget& target);

  /// How the displacement changes with the load factor, by one solution with the tangent as it is prepared. Collective.
  /// @param response on all local degrees of freedom, [length]
  /// @param tolerance residual over the forces' derivative [-]
  Outcome find_load_response(operators::NonlinearSystem& system, base::Field response, double tolerance);

 private:
  LinearSolver solver_;
};

}  // namespace perimorph::solvers
