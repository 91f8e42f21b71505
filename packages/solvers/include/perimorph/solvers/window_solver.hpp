#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "perimorph/operators/nonlinear_system.hpp"
#include "perimorph/solvers/linear_solver.hpp"

namespace perimorph::solvers {

class FarFields;
class Submatrix;

/// Solves for what bonds have changed that broke last: in a window around them as well as is asked for, and in the rest
/// of the body by a few far fields, which are made of corrections that the whole body has needed before. How well the
/// rest is solved the residual must tell (DECISIONS.md, 49).
class WindowSolver {
 public:
  using Vector = operators::NonlinearSystem::Vector;

  /// Collective. @param profile must outlive this
  WindowSolver(const base::Comm& comm, SolverParameters parameters, base::Profile& profile);
  ~WindowSolver();

  /// A new operator, and the matrix that its preconditioner is made from; far fields live on. Collective.
  /// @param old_nodes of owned nodes: those of the operator before that they have parted from
  void set_operator(const Teuchos::RCP<Operator>& linear_operator, const Teuchos::RCP<Matrix>& preconditioner_matrix,
                    const NearNullSpace& near_null_space, const std::vector<int>& old_nodes);

  /// The preconditioner's matrix has new values in the rows of these owned nodes. Local.
  void note_change(const std::vector<int>& nodes);

  /// Window and far fields are gone: nothing that comes depends on solves before. Local.
  void forget();

  /// Solves A x = b with the unknowns of the window and the far fields. Returns whether it did; otherwise the whole
  /// body has to be solved: there are no far fields yet, or it does not converge. Collective.
  /// @param target of the residual in the rows of the window, [force]
  bool solve(const std::shared_ptr<operators::Window>& window, const Vector& b, Vector& x, double target);

  /// The far fields will contain what the whole body has needed after solve(), or without. Collective.
  void learn(const Vector& correction);

  bool has_learned() const { return fields_ != nullptr; }

 private:
  class WithSprings;

  const base::Comm& comm_;
  SolverParameters parameters_;
  base::Profile& profile_;
  Teuchos::RCP<Operator> operator_;
  Teuchos::RCP<Matrix> preconditioner_matrix_;
  NearNullSpace near_null_space_;
  int dim_ = 0;

  std::unique_ptr<FarFields> fields_;  ///< null: none
  bool products_are_old_ = false;      ///< of the fields: those of another operator, or not known
  std::vector<double> shares_;         ///< of the fields in the last solution; none if it has been learned from

  std::shared_ptr<operators::Window> window_;
  std::vector<int> rows_;    ///< of its unknowns
  std::vector<double> own_;  ///< sum of the corrections of its unknowns since it was placed
  std::unique_ptr<Submatrix> submatrix_;
  Teuchos::RCP<WithSprings> with_springs_;
  std::unique_ptr<LinearSolver> in_window_;

  void place(const std::shared_ptr<operators::Window>& window);
  void make_solver();
  int leave_window();
  void follow_changes() const;
  void make_harmonic(int field);
  std::optional<std::vector<double>> solve_in_window(const std::vector<double>& b, double target);
};

}  // namespace perimorph::solvers
