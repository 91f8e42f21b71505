#include "perimorph/solvers/linear_solver.hpp"

#include <BelosBlockCGSolMgr.hpp>
#include <BelosLinearProblem.hpp>
#include <BelosTpetraAdapter.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "perimorph/base/errors.hpp"
#include "perimorph/base/profiler_mark.hpp"
#include "with_groups.hpp"

namespace perimorph::solvers {

namespace {

constexpr std::size_t most_factorized = 100000;  // rows: about 1 GB with the whole stiffness

/// T B T^T, for one vector at a time.
class InBasis : public Operator {
 public:
  InBasis(const Teuchos::RCP<const Operator>& basis, const Teuchos::RCP<const Operator>& inner)
      : basis_(basis), inner_(inner), input_(basis->getDomainMap(), 1), output_(basis->getDomainMap(), 1) {}

  Teuchos::RCP<const Tpetra::Map<>> getDomainMap() const override { return basis_->getRangeMap(); }
  Teuchos::RCP<const Tpetra::Map<>> getRangeMap() const override { return basis_->getRangeMap(); }

  void apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp, double alpha, double beta) const override {
    basis_->apply(x, input_, Teuchos::TRANS);
    inner_->apply(input_, output_);
    basis_->apply(output_, y, Teuchos::NO_TRANS, alpha, beta);
  }

 private:
  Teuchos::RCP<const Operator> basis_, inner_;
  mutable MultiVector input_, output_;
};

/// What a message of Trilinos says, without the place in its sources; in one line.
std::string in_brief(const std::string& message) {
  constexpr std::size_t longest = 300;
  const std::size_t test = message.find("Throw test that evaluated to true:");
  const std::size_t begin = test == std::string::npos ? 0 : std::min(message.find("\n\n", test), message.size());
  std::istringstream words(message.substr(begin));
  std::string text;
  for (std::string word; words >> word;) text += (text.empty() ? "" : " ") + word;
  return text.size() > longest ? text.substr(0, longest) + "..." : text;
}

/// What a library throws is a computation that cannot go on, unless there is no memory; what we throw remains what it
/// is.
template <class Work>
void translated(const char* what, const Work& work) {
  try {
    work();
  } catch (const base::Bug&) {
    throw;
  } catch (const std::exception& error) {
    if (base::is_out_of_memory(error)) throw;
    throw base::ComputationError(what + in_brief(error.what()));
  }
}

}  // namespace

LinearSolver::LinearSolver(const base::Comm& comm, SolverParameters parameters, base::Profile& profile)
    : consensus_(comm), parameters_(std::move(parameters)), profile_(profile) {
  PERIMORPH_ASSERT(parameters_.max_iterations > 0 && parameters_.renewal_cost >= 0., "{} iterations, renewal cost {}",
                   parameters_.max_iterations, parameters_.renewal_cost);
}

void LinearSolver::set_operator(const Teuchos::RCP<Operator>& linear_operator,
                                const Teuchos::RCP<Matrix>& preconditioner_matrix, const NearNullSpace& near_null_space,
                                const Teuchos::RCP<const Operator>& basis, std::optional<base::NodeWeights> from_old,
                                std::function<Teuchos::RCP<Matrix>()> whole_matrix) {
  PERIMORPH_ASSERT(!linear_operator.is_null() && !preconditioner_matrix.is_null(), "an operator is missing");
  PERIMORPH_ASSERT(linear_operator->getDomainMap()->isSameAs(*preconditioner_matrix->getRowMap()),
                   "the preconditioner's matrix has other unknowns");
  operator_ = linear_operator;
  preconditioner_matrix_ = preconditioner_matrix;
  near_null_space_ = near_null_space;
  basis_ = basis;
  whole_matrix_ = std::move(whole_matrix);
  groups_.reset();
  with_groups_ = Teuchos::null;
  const bool can_move = from_old && !moved_ && condition_ == Condition::good && cycle_ == Cycle::fast;
  if (!can_move) return forget();
  moved_ = std::move(from_old);
  changed_nodes_.clear();
}

void LinearSolver::set_groups(GroupMotions groups) {
  PERIMORPH_ASSERT(!operator_.is_null(), "groups of {} rows without an operator", groups.rows.size());
  groups_ = std::move(groups);
}

void LinearSolver::forget() {
  multigrid_.reset();
  factorization_.reset();
  moved_.reset();
  condition_ = Condition::missing;
  cycle_ = Cycle::fast;
}

void LinearSolver::note_change(const std::vector<int>& nodes) {
  changed_nodes_.insert(changed_nodes_.end(), nodes.begin(), nodes.end());
}

LinearSolver::Outcome LinearSolver::solve(const MultiVector& right_hand_side, MultiVector& solution, double target) {
  PERIMORPH_ASSERT(!operator_.is_null(), "there is no operator yet");
  PERIMORPH_ASSERT(target >= 0., "target {}", target);
  PERIMORPH_ASSERT(right_hand_side.getNumVectors() == 1 && solution.getNumVectors() == 1,
                   "{} right-hand sides, {} solutions", right_hand_side.getNumVectors(), solution.getNumVectors());
  Teuchos::Array<double> norm(1);
  right_hand_side.norm2(norm());
  solution.putScalar(0.);
  if (norm[0] <= target) return {true, 0, ""};
  if (!std::isfinite(norm[0])) return {false, 0, "the residual is not a finite number"};

  const double relative_tolerance = target / norm[0];
  Outcome outcome{false, 0, ""};
  for (bool is_last = false; !outcome.converged && !is_last;) {
    is_last = is_last_resort();
    solution.putScalar(0.);
    outcome = attempt(right_hand_side, solution, relative_tolerance);
    if (!parameters_.has_resorts) break;
    if (!outcome.converged) go_to_next_resort(outcome);
  }
  if (!outcome.converged) {
    outcome.trouble = fmt::format(
        "conjugate gradients did not reduce the residual by {:.1e} within {} iterations, with a fresh, "
        "robust preconditioner and {}{}{}",
        relative_tolerance, outcome.iterations, is_factorized() ? "a factorization" : "one of a single level",
        outcome.trouble.empty() ? "" : ": ", outcome.trouble);
    return outcome;
  }
  judge(outcome.iterations, relative_tolerance);
  return outcome;
}

/// What has failed is never kept: a factorization that is no longer of the present matrix is made once more.
void LinearSolver::go_to_next_resort(const Outcome& failed) {
  condition_ = Condition::missing;
  if (cycle_ == Cycle::one_level) return;
  cycle_ = cycle_ == Cycle::fast ? Cycle::robust : Cycle::one_level;
  note_fallback(failed);
}

void LinearSolver::note_fallback(const Outcome& failed) {
  const bool is_first = cycle_ == Cycle::robust;
  const std::string what = is_first ? "the usual multigrid" : "the robust multigrid";
  const auto is_same = [&](const std::string& earlier) { return earlier.rfind(what, 0) == 0; };
  if (std::any_of(fallbacks_.begin(), fallbacks_.end(), is_same)) return;
  fallbacks_.push_back(fmt::format(
      "{} failed ({}); instead {}", what,
      failed.trouble.empty() ? fmt::format("no convergence in {} iterations", failed.iterations) : failed.trouble,
      is_first          ? "a robust one serves, which is slower"
      : is_factorized() ? "the matrix is factorized, on one rank"
                        : "a single level serves, with which it takes many iterations"));
}

LinearSolver::Outcome LinearSolver::attempt(const MultiVector& right_hand_side, MultiVector& solution,
                                            double relative_tolerance) {
  try {
    prepare();
    return iterate(right_hand_side, solution, relative_tolerance);
  } catch (const base::MemoryError&) {
    throw;
  } catch (const base::ComputationError& error) {
    return {false, 0, error.what()};
  }
}

bool LinearSolver::is_factorized() const {
  return cycle_ == Cycle::one_level && preconditioner_matrix_->getGlobalNumRows() <= most_factorized;
}

void LinearSolver::build() {
  multigrid_.reset();
  factorization_.reset();
  if (is_factorized()) {
    factorization_ = std::make_unique<Factorization>(whole_matrix_ ? whole_matrix_() : preconditioner_matrix_);
  } else {
    multigrid_ = std::make_unique<Multigrid>(preconditioner_matrix_, near_null_space_, parameters_.muelu, cycle_,
                                             parameters_.rows_per_rank);
  }
  fresh_rate_ = 0.;
}

void LinearSolver::set_up(const std::function<void()>& work) {
  consensus_.run([&] { translated("the preconditioner could not be set up: ", work); });
}

void LinearSolver::prepare() {
  const auto timer = profile_.measure(base::Phase::preconditioner);
  auto changed = std::exchange(changed_nodes_, {});
  const bool is_kept = !moved_ && condition_ == Condition::good;
  if (!is_kept) with_groups_ = Teuchos::null;
  if (const auto moved = std::exchange(moved_, std::nullopt)) {
    set_up([&] { multigrid_->move_to(preconditioner_matrix_, *moved); });
    refreshed_ = true;
    return;
  }
  if (condition_ == Condition::good) {
    std::sort(changed.begin(), changed.end());
    changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
    if (multigrid_) multigrid_->refresh_finest(changed);
    return;
  }
  const bool refresh = condition_ == Condition::aged && !refreshed_ && multigrid_;
  set_up([&] { refresh ? multigrid_->refresh() : build(); });
  refreshed_ = refresh;
  excess_ = 0.;
  condition_ = Condition::good;
}

LinearSolver::Outcome LinearSolver::iterate(const MultiVector& right_hand_side, MultiVector& solution,
                                            double relative_tolerance) {
  const auto timer = profile_.measure(base::Phase::cg);
  Outcome outcome{false, 0, ""};
  consensus_.run([&] {  // "non-positive value for p^H*A*p", not a number
    translated("", [&] { outcome = run_conjugate_gradients(right_hand_side, solution, relative_tolerance); });
  });
  return outcome;
}

Teuchos::RCP<const Operator> LinearSolver::preconditioner() {
  if (!with_groups_.is_null()) return with_groups_;
  Teuchos::RCP<const Operator> inverse = multigrid_ ? multigrid_->apply_inverse() : factorization_->apply_inverse();
  if (!basis_.is_null()) inverse = Teuchos::rcp(new InBasis(basis_, inverse));
  if (groups_) inverse = with_groups_ = Teuchos::rcp(new WithGroups(*operator_, inverse, *groups_));
  return inverse;
}

LinearSolver::Outcome LinearSolver::run_conjugate_gradients(const MultiVector& right_hand_side, MultiVector& solution,
                                                            double relative_tolerance) {
  using Problem = Belos::LinearProblem<double, MultiVector, Operator>;
  const auto problem =
      Teuchos::rcp(new Problem(operator_, Teuchos::rcpFromRef(solution), Teuchos::rcpFromRef(right_hand_side)));
  problem->setInitResVec(Teuchos::rcpFromRef(right_hand_side));  // known, as the solution starts from zero
  problem->setProblem();                                         // would apply a preconditioner, to no purpose
  problem->setLeftPrec(preconditioner());

  const auto list = Teuchos::parameterList("Belos");
  list->set("Verbosity", static_cast<int>(Belos::Errors));
  list->set("Use Single Reduction", true);  // and no application of the preconditioner after the last iteration
  list->setParameters(parameters_.belos);
  list->set("Maximum Iterations", parameters_.max_iterations);
  list->set("Convergence Tolerance", relative_tolerance);
  Belos::BlockCGSolMgr<double, MultiVector, Operator> solver(problem, list);
  const base::ProfilerMark mark(base::ProfilerMark::iterations, 0., static_cast<double>(solution.getLocalLength()));
  const bool converged = solver.solve() == Belos::Converged;
  return {converged, solver.getNumIters(), ""};
}

/// Iterations per decade just after a rebuild are what it should take; what it takes more adds up, until it has cost as
/// much as a new set-up.
void LinearSolver::judge(int iterations, double relative_tolerance) {
  constexpr double enough = 2.5;  // decades; of less the first, slow iterations are too large a share
  const double decades = -std::log10(relative_tolerance);
  if (fresh_rate_ == 0.) {
    if (decades >= enough) fresh_rate_ = iterations / decades;
    return;
  }
  excess_ = std::max(0., excess_ + iterations - fresh_rate_ * decades);
  if (excess_ > parameters_.renewal_cost) condition_ = Condition::aged;
}

}  // namespace perimorph::solvers
