#pragma once

#include <string>

#include "perimorph/operators/nonlinear_system.hpp"
#include "perimorph/solvers/linear_solver.hpp"
#include "perimorph/solvers/window_solver.hpp"

namespace perimorph::solvers {

/// How well the forces are to balance.
struct BalanceTarget {
  double tolerance;  ///< residual over reactions [-]
  /// Below which reactions say nothing of the load, [force]; follows the solutions.
  double& force_scale;
  /// Whether pieces may float: all bonds hold otherwise, and the anchors of the tangent are hardly needed.
  bool may_float;
  /// Whether a window may serve: the residual is then as small in it, and up to four times as large elsewhere.
  bool by_window = false;
};

/// Finds the displacement at which forces balance, by Newton's method with conjugate gradients for each correction. A
/// system whose terms are all linear takes one correction, but for what the tangent is not exact in.
class Equilibrium {
 public:
  /// Collective. @param profile must outlive this
  Equilibrium(const base::Comm& comm, SolverParameters parameters, base::Profile& profile)
      : solver_(comm, parameters, profile), windows_(comm, std::move(parameters), profile) {}

  /// LinearSolver::note_change() and forget(), for windows too. Local.
  void note_change(const std::vector<int>& nodes) {
    solver_.note_change(nodes);
    windows_.note_change(nodes);
  }
  void forget() {
    solver_.forget();
    windows_.forget();
  }

  /// The solver of the corrections; new operators and changed values are handed to it.
  LinearSolver& linear_solver() { return solver_; }
  const LinearSolver& linear_solver() const { return solver_; }
  WindowSolver& windows() { return windows_; }

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
  WindowSolver windows_;
};

}  // namespace perimorph::solvers
