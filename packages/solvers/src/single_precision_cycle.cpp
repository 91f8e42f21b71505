#include "single_precision_cycle.hpp"

#include <Eigen/Eigenvalues>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_MultiVector.hpp>
#include <memory>

#include "block_matrix.hpp"
#include "perimorph/base/profiler_mark.hpp"

namespace perimorph::solvers {

namespace {

using Values = std::vector<float>;

template <int size>
using Block = Eigen::Matrix<float, size, size>;
template <int size>
using BlockVector = Eigen::Matrix<float, size, 1>;

template <int size>
Eigen::Map<BlockVector<size>> at(Values& x, int row) {
  return Eigen::Map<BlockVector<size>>(x.data() + static_cast<std::ptrdiff_t>(row) * size);
}

/// Inverse of a symmetric, positive semi-definite block, but zero for what is below `smallest`.
template <int size>
Block<size> inverse(const Block<size>& block, double smallest) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, size, size>> eigen(block.template cast<double>());
  const Eigen::Matrix<double, size, 1> inverted =
      eigen.eigenvalues().unaryExpr([=](double value) { return value > smallest ? 1. / value : 0.; });
  return (eigen.eigenvectors() * inverted.asDiagonal() * eigen.eigenvectors().transpose()).template cast<float>();
}

/// Gauss-Seidel on the matrix of one level.
/// @tparam Number of its matrix
template <int size, class Number>
class Smoother {
 public:
  explicit Smoother(const Matrix& matrix) : matrix_(matrix) {
    float largest = 0.f;
    for (int row = 0; row < n_rows(); ++row) {
      std::size_t diagonal = matrix_.first(row);
      while (matrix_.column(diagonal) != row) ++diagonal;
      diagonal_.push_back(diagonal);
      largest = std::max(largest, matrix_.block(row, diagonal).diagonal().maxCoeff());
    }
    // A piece that floats has no stiffness but its anchors, and in single precision no forces but rounding errors.
    smallest_ = 1e-5 * largest;
    neglected_.resize(diagonal_.size());
    inverse_.resize(diagonal_.size());
    for (int row = 0; row < n_rows(); ++row) invert_diagonal(row);
  }

  /// Takes new values of the matrix in some rows.
  void refresh(const Matrix& matrix, const std::vector<int>& rows) {
    matrix_.read_values(matrix, rows);
    for (const int row : rows) invert_diagonal(row);
  }

  int n_rows() const { return matrix_.n_rows(); }
  double bytes() const { return matrix_.bytes(); }
  Values make_vector() const {
    return Values(static_cast<std::size_t>(matrix_.ghosts().n_all()) * size + BlockMatrix<size, size, Number>::padding,
                  0.f);
  }
  void update_ghosts(Values& x) const { matrix_.ghosts().update(x); }

  /// x after a forward sweep from zero, copies included.
  void start(Values& b, Values& x) const {
    for (int row = 0; row < n_rows(); ++row) {
      at<size>(x, row) =
          inverse_[row] * (at<size>(b, row) - matrix_.product(row, matrix_.first(row), diagonal_[row], x.data()));
    }
    update_ghosts(x);
  }

  /// b - A x just after start(): what the sweep has already used up cancels.
  void residual_after_start(Values& x, Values& residual) const {
    for (int row = 0; row < n_rows(); ++row) {
      at<size>(residual, row) = neglected_[row].cwiseProduct(at<size>(x, row)) -
                                matrix_.product(row, diagonal_[row] + 1, matrix_.end(row), x.data());
    }
  }

  /// b - A x, with the copies of x up to date.
  void residual(Values& b, Values& x, Values& residual) const {
    for (int row = 0; row < n_rows(); ++row) {
      at<size>(residual, row) = at<size>(b, row) - matrix_.product(row, x.data());
    }
  }

  /// A sweep from x, whose copies are up to date.
  void sweep_forward(Values& b, Values& x) const {
    for (int row = 0; row < n_rows(); ++row) relax(row, b, x);
  }
  void sweep_backward(Values& b, Values& x) const {
    for (int row = n_rows() - 1; row >= 0; --row) relax(row, b, x);
  }

 private:
  BlockMatrix<size, size, Number> matrix_;
  std::vector<std::size_t> diagonal_;
  std::vector<BlockVector<size>> neglected_;
  std::vector<Block<size>> inverse_;  ///< of the diagonal and what is neglected
  double smallest_;                   ///< eigenvalue that counts

  void invert_diagonal(int row) {
    neglected_[row].setZero();
    for (auto b = diagonal_[row] + 1; b < matrix_.end(row); ++b) {
      if (matrix_.column(b) >= n_rows()) neglected_[row] += 0.5f * matrix_.block(row, b).cwiseAbs().rowwise().sum();
    }
    Block<size> block = matrix_.block(row, diagonal_[row]);
    block.diagonal() += neglected_[row];
    inverse_[row] = inverse<size>(block, smallest_);
  }

  void relax(int row, Values& b, Values& x) const {
    at<size>(x, row) += inverse_[row] * (at<size>(b, row) - matrix_.product(row, x.data()));
  }
};

template <int rows, int cols>
class Transfer {
 public:
  explicit Transfer(const Matrix& matrix)
      : matrix_(matrix), gathered_(matrix_.ghosts().n_all() * cols + BlockMatrix<rows, cols>::padding) {}

  double bytes() const { return matrix_.bytes(); }

  /// The operator times x, of which only the owned part counts.
  template <class Assign>
  void apply(const Values& x, Assign assign) const {
    std::copy_n(x.begin(), matrix_.ghosts().n_owned() * cols, gathered_.begin());
    matrix_.ghosts().update(gathered_);
    for (int row = 0; row < matrix_.n_rows(); ++row) assign(row, matrix_.product(row, gathered_.data()));
  }

 private:
  BlockMatrix<rows, cols> matrix_;
  mutable Values gathered_;
};

/// A level and all below it.
/// @tparam Number of its matrix; of those below it is float
template <int size, int coarse, class Number = float>
class Level {
 public:
  Level(const CycleLevel* levels, std::size_t n_levels, int number = 0)
      : number_(number), smoother_(*levels->matrix), b_(smoother_.n_rows() * size), x_(smoother_.make_vector()) {
    if (n_levels == 1) return;
    restriction_ = std::make_unique<Transfer<coarse, size>>(*levels->restriction);
    prolongation_ = std::make_unique<Transfer<size, coarse>>(*levels->prolongation);
    residual_.resize(b_.size());
    below_ = std::make_unique<Level<coarse, coarse>>(levels + 1, n_levels - 1, number + 1);
  }

  void refresh(const Matrix& matrix, const std::vector<int>& rows) { smoother_.refresh(matrix, rows); }

  Values& right_hand_side() { return b_; }
  const Values& solution() const { return x_; }

  /// x after a cycle from zero.
  void solve() {
    const auto mark = mark_visit(below_ == nullptr ? 2. * n_symmetric_sweeps - 0.5 : 2.);
    smoother_.start(b_, x_);
    if (below_ == nullptr) return solve_coarsest();
    smoother_.residual_after_start(x_, residual_);
    correct();
  }

  /// x after another cycle.
  void improve() {
    if (below_ == nullptr) return;  // the coarsest level is solved well enough
    const auto mark = mark_visit(3.);
    smoother_.update_ghosts(x_);
    smoother_.sweep_forward(b_, x_);
    smoother_.update_ghosts(x_);
    smoother_.residual(b_, x_, residual_);
    correct();
  }

 private:
  int number_;  ///< 0 for the finest
  Smoother<size, Number> smoother_;
  std::unique_ptr<Transfer<coarse, size>> restriction_;
  std::unique_ptr<Transfer<size, coarse>> prolongation_;
  std::unique_ptr<Level<coarse, coarse>> below_;
  Values b_, x_, residual_;

  static constexpr int n_symmetric_sweeps = 10;  ///< on the coarsest level

  /// @param n_passes over the matrix
  base::ProfilerMark mark_visit(double n_passes) const {
    double bytes = n_passes * smoother_.bytes();
    if (below_ != nullptr) bytes += restriction_->bytes() + prolongation_->bytes();
    return {base::ProfilerMark::finest_level + number_, bytes, static_cast<double>(b_.size())};
  }

  /// The coarse correction of x with its residual, and the sweep after it.
  void correct() {
    restriction_->apply(residual_,
                        [this](int row, const auto& sum) { at<coarse>(below_->right_hand_side(), row) = sum; });
    below_->solve();
    below_->improve();
    prolongation_->apply(below_->solution(), [this](int row, const auto& sum) { at<size>(x_, row) += sum; });
    smoother_.update_ghosts(x_);
    smoother_.sweep_backward(b_, x_);
  }

  void solve_coarsest() {
    for (int sweep = 0; sweep < n_symmetric_sweeps; ++sweep) {
      if (sweep > 0) {
        smoother_.sweep_forward(b_, x_);
        smoother_.update_ghosts(x_);
      }
      smoother_.sweep_backward(b_, x_);
      smoother_.update_ghosts(x_);
    }
  }
};

template <int dim>
class WCycle : public SinglePrecisionCycle {
 public:
  explicit WCycle(const std::vector<CycleLevel>& levels)
      : matrix_(levels.front().matrix), finest_(levels.data(), levels.size()) {}

  Teuchos::RCP<const Tpetra::Map<>> getDomainMap() const override { return matrix_->getRowMap(); }
  Teuchos::RCP<const Tpetra::Map<>> getRangeMap() const override { return matrix_->getRowMap(); }

  void refresh_finest(const std::vector<int>& block_rows) override { finest_.refresh(*matrix_, block_rows); }

  void apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp, double alpha, double beta) const override {
    const auto input = x.getLocalViewHost(Tpetra::Access::ReadOnly);
    const auto output = y.getLocalViewHost(Tpetra::Access::ReadWrite);
    for (std::size_t column = 0; column < input.extent(1); ++column) {
      for (std::size_t i = 0; i < input.extent(0); ++i) {
        finest_.right_hand_side()[i] = static_cast<float>(input(i, column));
      }
      finest_.solve();
      for (std::size_t i = 0; i < input.extent(0); ++i) {
        output(i, column) = (beta == 0. ? 0. : beta * output(i, column)) + alpha * finest_.solution()[i];
      }
    }
  }

 private:
  Teuchos::RCP<const Matrix> matrix_;
  mutable Level<dim, dim*(dim + 1) / 2, Eigen::half> finest_;
};

}  // namespace

template <int dim>
Teuchos::RCP<SinglePrecisionCycle> make_single_precision_cycle(const std::vector<CycleLevel>& levels) {
  return Teuchos::rcp(new WCycle<dim>(levels));
}

template Teuchos::RCP<SinglePrecisionCycle> make_single_precision_cycle<2>(const std::vector<CycleLevel>&);
template Teuchos::RCP<SinglePrecisionCycle> make_single_precision_cycle<3>(const std::vector<CycleLevel>&);

}  // namespace perimorph::solvers
