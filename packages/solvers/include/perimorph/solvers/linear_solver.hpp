#pragma once

#include <Teuchos_ParameterList.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "perimorph/base/consensus.hpp"
#include "perimorph/base/profile.hpp"
#include "perimorph/solvers/factorization.hpp"
#include "perimorph/solvers/multigrid.hpp"

namespace perimorph::solvers {

struct SolverParameters {
  int max_iterations = 500;
  double renewal_cost = 12.;  ///< iterations more than with a new preconditioner, after which it is renewed
  int rows_per_rank = Multigrid::default_rows_per_rank;  ///< at least, on coarse levels of multigrid
  bool has_resorts = true;                               ///< or what fails is not tried again in other ways
  Teuchos::ParameterList belos, muelu;                   ///< overrides
};

/// Unknowns that the preconditioner's matrix holds fast, and how they can move all the same: motions of groups that
/// move as one.
struct GroupMotions {
  std::vector<int> rows;                     ///< owned
  std::vector<std::vector<double>> motions;  ///< orthonormal, (n_owned unknowns) each, zero in all other rows [-]
};

/// Conjugate gradients (Belos) with multigrid, for a matrix whose values change a little between many solves. The
/// preconditioner is kept as long as it serves, but for its finest level: then refreshed, then rebuilt.
class LinearSolver {
 public:
  /// Collective. @param profile must outlive this
  LinearSolver(const base::Comm& comm, SolverParameters parameters, base::Profile& profile);

  /// A new operator, and the matrix that its preconditioner is made from, which is near to it or the same. Local.
  /// @param basis T, if the preconditioner's matrix is near to T^T A T instead
  /// @param from_old the matrix's nodes from those of the one before, if there was one: the preconditioner moves with
  ///        them as long as it serves; without, it is rebuilt before the next solve
  /// @param whole_matrix makes the operator in the basis as a matrix, for a factorization; collective. Without it the
  ///        preconditioner's matrix is factorized
  void set_operator(const Teuchos::RCP<Operator>& linear_operator, const Teuchos::RCP<Matrix>& preconditioner_matrix,
                    const NearNullSpace& near_null_space, const Teuchos::RCP<const Operator>& basis = Teuchos::null,
                    std::optional<base::NodeWeights> from_old = std::nullopt,
                    std::function<Teuchos::RCP<Matrix>()> whole_matrix = {});

  /// After set_operator(), whose operator couples them where its preconditioner's matrix does not. Local.
  void set_groups(GroupMotions groups);

  /// The preconditioner's matrix has new values in the rows of these owned nodes. Local.
  void note_change(const std::vector<int>& nodes);

  /// The preconditioner is rebuilt before the next solve: nothing that comes depends on solves before. Local.
  void forget();

  struct Outcome {
    bool converged;
    int iterations;
    std::string trouble;  ///< why it did not
  };

  /// Solves A x = b from x = 0 until |b - A x| <= target (2-norm). Collective.
  /// If the iteration breaks down or does not converge, on whatever rank, it is tried again with a rebuilt, robust
  /// preconditioner, and then with the last one: a factorization of the whole matrix as it is now, or a single level
  /// where that would take too much memory.
  /// @param right_hand_side b on the unknowns, [force]
  /// @param solution becomes x, [length]
  /// @param target >= 0, [force]
  /// @throws MemoryError on all ranks if one has no memory left.
  Outcome solve(const MultiVector& right_hand_side, MultiVector& solution, double target);

  /// What has failed so far and what was tried instead, in words, each kind once: it goes on, but takes longer. Local.
  const std::vector<std::string>& fallbacks() const { return fallbacks_; }

 private:
  enum class Condition { missing, aged, good };
  using Cycle = Multigrid::Cycle;

  base::Consensus consensus_;
  SolverParameters parameters_;
  base::Profile& profile_;
  Teuchos::RCP<Operator> operator_;
  Teuchos::RCP<const Operator> basis_;
  Teuchos::RCP<Matrix> preconditioner_matrix_;
  std::function<Teuchos::RCP<Matrix>()> whole_matrix_;
  NearNullSpace near_null_space_;
  std::unique_ptr<Multigrid> multigrid_;
  std::unique_ptr<Factorization> factorization_;  ///< null: multigrid preconditions
  std::optional<GroupMotions> groups_;
  Teuchos::RCP<const Operator> with_groups_;  ///< the preconditioner with their motions, once made
  Condition condition_ = Condition::missing;
  std::vector<int> changed_nodes_;          ///< since the last solve; some more than once
  std::optional<base::NodeWeights> moved_;  ///< to a new matrix since the last solve
  bool refreshed_ = false;                  ///< or moved since the last rebuild
  Cycle cycle_ = Cycle::fast;
  std::vector<std::string> fallbacks_;

  bool is_factorized() const;
  bool is_last_resort() const { return cycle_ == Cycle::one_level && condition_ == Condition::missing; }
  void go_to_next_resort(const Outcome& failed);
  void note_fallback(const Outcome& failed);
  void prepare();
  void set_up(const std::function<void()>& work);
  void build();
  Outcome attempt(const MultiVector& right_hand_side, MultiVector& solution, double relative_tolerance);
  Teuchos::RCP<const Operator> preconditioner();
  Outcome iterate(const MultiVector& right_hand_side, MultiVector& solution, double relative_tolerance);
  Outcome run_conjugate_gradients(const MultiVector& right_hand_side, MultiVector& solution, double relative_tolerance);
  double fresh_rate_ = 0.;  ///< iterations per decade of reduction with the preconditioner as built
  double excess_ = 0.;      ///< iterations since the last set-up, beyond those at the fresh rate
  void judge(int iterations, double relative_tolerance);
};

}  // namespace perimorph::solvers
