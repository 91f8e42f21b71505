#include "perimorph/solvers/window_solver.hpp"

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>

#include "far_fields.hpp"
#include "perimorph/base/errors.hpp"
#include "submatrix.hpp"

namespace perimorph::solvers {

namespace {

using Map = Tpetra::Map<>;
using Eigen::Index;
using Eigen::VectorXd;

Eigen::Map<VectorXd> numbers_of(MultiVector& vector) {
  return {vector.getLocalViewHost(Tpetra::Access::ReadWrite).data(), static_cast<Index>(vector.getLocalLength())};
}
Eigen::Map<const VectorXd> numbers_of(const MultiVector& vector) {
  return {vector.getLocalViewHost(Tpetra::Access::ReadOnly).data(), static_cast<Index>(vector.getLocalLength())};
}

/// Some rows of columns, under other numbers.
Teuchos::RCP<MultiVector> rows_of(const MultiVector& whole, const std::vector<int>& rows,
                                  const Teuchos::RCP<const Map>& map) {
  const auto part = Teuchos::rcp(new MultiVector(map, whole.getNumVectors()));
  const auto from = whole.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto to = part->getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (std::size_t column = 0; column < from.extent(1); ++column) {
    for (std::size_t i = 0; i < rows.size(); ++i) to(i, column) = from(rows[i], column);
  }
  return part;
}

}  // namespace

/// The tangent of the window with the rest of the body as springs: K_WW - B C^-1 B^T.
class WindowSolver::WithSprings : public Operator {
 public:
  explicit WithSprings(const Teuchos::RCP<Operator>& tangent) : tangent_(tangent) {}
  Teuchos::RCP<const Map> getDomainMap() const override { return tangent_->getDomainMap(); }
  Teuchos::RCP<const Map> getRangeMap() const override { return tangent_->getRangeMap(); }

  void apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp mode, double alpha, double beta) const override {
    tangent_->apply(x, y, mode, alpha, beta);
    if (fields_ == nullptr) return;
    for (std::size_t column = 0; column < x.getNumVectors(); ++column) {
      const auto own_x = x.getVector(column);
      const auto numbers = numbers_of(static_cast<const MultiVector&>(*own_x));
      const VectorXd q = fields_->inverse() * forces_on_fields({numbers.begin(), numbers.end()});
      numbers_of(*y.getVectorNonConst(column)).noalias() -= alpha * (b_ * q);
    }
  }

  /// B^T y.
  VectorXd forces_on_fields(const std::vector<double>& y) const {
    return fields_->sum(b_.transpose() * Eigen::Map<const VectorXd>(y.data(), static_cast<Index>(y.size())));
  }

  /// @param rows of the window's unknowns
  void set_springs(const FarFields& fields, const std::vector<int>& rows) {
    fields_ = &fields;
    const auto ku = fields.ku();
    b_.resize(static_cast<Index>(rows.size()), ku.cols());
    for (std::size_t i = 0; i < rows.size(); ++i) b_.row(static_cast<Index>(i)) = ku.row(rows[i]);
  }
  /// The rest of the body is held fast.
  void drop_springs() { fields_ = nullptr; }

 private:
  Teuchos::RCP<Operator> tangent_;
  const FarFields* fields_ = nullptr;
  FarFields::Dense b_;
};

WindowSolver::WindowSolver(const base::Comm& comm, SolverParameters parameters, base::Profile& profile)
    : comm_(comm), parameters_(std::move(parameters)), profile_(profile) {
  constexpr int most_iterations = 60;
  parameters_.max_iterations = std::min(parameters_.max_iterations, most_iterations);
  parameters_.has_resorts = false;
}

WindowSolver::~WindowSolver() = default;

void WindowSolver::set_operator(const Teuchos::RCP<Operator>& linear_operator,
                                const Teuchos::RCP<Matrix>& preconditioner_matrix, const NearNullSpace& near_null_space,
                                const std::vector<int>& old_nodes) {
  leave_window();
  operator_ = linear_operator;
  preconditioner_matrix_ = preconditioner_matrix;
  near_null_space_ = near_null_space;
  dim_ = static_cast<int>(near_null_space.coordinates->getNumVectors());
  if (fields_ == nullptr) return;
  fields_ = std::make_unique<FarFields>(fields_->moved_to(operator_, old_nodes, dim_));
  products_are_old_ = true;
}

void WindowSolver::note_change(const std::vector<int>& nodes) {
  if (window_ == nullptr) return;
  std::vector<int> changed;
  for (const int node : nodes) {
    const int row = submatrix_->place_of(node * dim_);
    if (row < 0) continue;
    for (int c = 0; c < dim_; ++c) submatrix_->refresh(row + c);
    changed.push_back(row / dim_);
  }
  in_window_->note_change(changed);
}

void WindowSolver::forget() {
  window_ = nullptr;
  leave_window();
  fields_.reset();
}

/// What the window has found itself becomes a far field, whose product is not known yet. Returns its place, or -1.
int WindowSolver::leave_window() {
  in_window_.reset();
  with_springs_ = Teuchos::null;
  submatrix_.reset();
  shares_.clear();
  if (std::exchange(window_, nullptr) == nullptr) return -1;
  Vector found(fields_->field(0)->getMap());
  for (std::size_t i = 0; i < rows_.size(); ++i) found.replaceLocalValue(rows_[i], own_[i]);
  return found.norm2() > 0. ? fields_->add(found) : -1;
}

void WindowSolver::place(const std::shared_ptr<operators::Window>& window) {
  const int last = leave_window();
  window_ = window;
  if (products_are_old_ || !window->knows_changes()) {
    fields_->multiply();
    window->changes({});
  } else {
    follow_changes();
    if (last >= 0) fields_->multiply(last);
  }
  products_are_old_ = false;
  rows_.clear();
  for (const int node : window->nodes()) {
    for (int c = 0; c < dim_; ++c) rows_.push_back(node * dim_ + c);
  }
  own_.assign(rows_.size(), 0.);
  make_solver();
  for (int j = 0; j < fields_->size(); ++j) make_harmonic(j);
  fields_->renew_energies();
  for (int j = 0; j < fields_->size(); ++j) window->note_field(j, *fields_->field(j));
}

void WindowSolver::make_solver() {
  const auto& nodes = window_->nodes();
  const auto node_map = Teuchos::rcp(new Map(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(), nodes.size(), 0,
                                             window_->unknowns()->getComm()));
  submatrix_ = std::make_unique<Submatrix>(preconditioner_matrix_, rows_, window_->unknowns());
  with_springs_ = Teuchos::rcp(new WithSprings(window_->tangent()));
  in_window_ = std::make_unique<LinearSolver>(comm_, parameters_, profile_);
  in_window_->set_operator(with_springs_, submatrix_->matrix(),
                           {rows_of(*near_null_space_.modes, rows_, window_->unknowns()),
                            rows_of(*near_null_space_.coordinates, nodes, node_map)},
                           window_->basis());
}

std::optional<std::vector<double>> WindowSolver::solve_in_window(const std::vector<double>& b, double target) {
  Vector right(window_->unknowns()), y(window_->unknowns());
  std::copy(b.begin(), b.end(), numbers_of(right).begin());
  if (!in_window_->solve(right, y, target).converged) return std::nullopt;
  const auto found = numbers_of(std::as_const(y));
  return std::vector<double>(found.begin(), found.end());
}

/// u -= E_W K_WW^-1 (K u)_W, nearly: no forces are left in the window, where a field would be what the window can find
/// itself.
void WindowSolver::make_harmonic(int field) {
  constexpr double enough = 0.3;  // of the forces, may be left
  auto u = numbers_of(*fields_->field(field)), ku = numbers_of(*fields_->product(field));
  std::vector<double> forces;
  double squares = 0.;
  for (const int row : rows_) {
    forces.push_back(ku[row]);
    squares += ku[row] * ku[row];
  }
  const auto found = solve_in_window(forces, enough * std::sqrt(base::sum(comm_, squares)));
  if (!found) return;
  const auto& z = *found;
  Vector change(operator_->getDomainMap());
  for (std::size_t i = 0; i < rows_.size(); ++i) change.replaceLocalValue(rows_[i], z[i]);
  const auto [dofs, lost] = window_->product(change);
  for (std::size_t i = 0; i < rows_.size(); ++i) u[rows_[i]] -= z[i];
  for (std::size_t i = 0; i < dofs.size(); ++i) ku[dofs[i]] -= lost[i];
  fields_->scale(field);
}

/// What has changed the operator, in the products.
void WindowSolver::follow_changes() const { fields_->take(window_->changes(fields_->all())); }

bool WindowSolver::solve(const std::shared_ptr<operators::Window>& window, const Vector& b, Vector& x, double target) {
  PERIMORPH_ASSERT(!operator_.is_null() && window != nullptr, "an operator or a window is missing");
  shares_.clear();
  if (fields_ == nullptr) return false;
  {
    const auto timer = profile_.measure(base::Phase::preconditioner);
    window == window_ ? follow_changes() : place(window);
  }
  const auto timer = profile_.measure(base::Phase::cg);
  const auto residual = numbers_of(b);
  const auto u = fields_->u(), ku = fields_->ku();
  const VectorXd g = fields_->sum(u.transpose() * residual), alone = fields_->inverse() * g;
  std::vector<double> right;
  for (const int row : rows_) right.push_back(residual[row] - ku.row(row).dot(alone));
  with_springs_->set_springs(*fields_, rows_);
  const auto found = solve_in_window(right, target);
  const VectorXd back = found ? with_springs_->forces_on_fields(*found) : VectorXd();
  with_springs_->drop_springs();
  if (!found) return false;
  const auto& y = *found;
  const VectorXd q = fields_->inverse() * (g - back);
  auto solution = numbers_of(x);
  solution.noalias() = u * q;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    solution[rows_[i]] += y[i];
    own_[i] += y[i];
  }
  shares_.assign(q.begin(), q.end());
  return true;
}

/// A correction that follows the window's solution has no forces in the window left, nor have the far fields: what both
/// are together, but for the window's own unknowns, is the next far field.
void WindowSolver::learn(const Vector& correction) {
  const auto timer = profile_.measure(base::Phase::preconditioner);
  if (fields_ == nullptr) fields_ = std::make_unique<FarFields>(comm_, operator_);
  if (window_ == nullptr) {
    fields_->add(correction);
    products_are_old_ = true;
    return;
  }
  const bool is_harmonic = !shares_.empty();
  if (!is_harmonic) follow_changes();  // as solve() has done otherwise
  Vector field(correction, Teuchos::Copy), product(operator_->getDomainMap());
  operator_->apply(correction, product);
  if (is_harmonic) {
    const Eigen::Map<const VectorXd> q(shares_.data(), static_cast<Index>(shares_.size()));
    numbers_of(field) += fields_->u() * q;
    numbers_of(product) += fields_->ku() * q;
    shares_.clear();
  }
  const int place = fields_->add(field);
  fields_->product(place)->assign(product);
  fields_->scale(place);
  if (!is_harmonic) make_harmonic(place);
  fields_->renew_energies();
  window_->note_field(place, *fields_->field(place));
}

}  // namespace perimorph::solvers
