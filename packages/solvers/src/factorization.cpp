#include "perimorph/solvers/factorization.hpp"

#include <Eigen/SparseCholesky>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>

#include "perimorph/base/errors.hpp"
#include "perimorph/base/parallel.hpp"

namespace perimorph::solvers {

namespace {

using Map = Tpetra::Map<>;
using Factors = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>;

/// All rows on rank 0.
Teuchos::RCP<const Map> on_root(const Map& rows) {
  const std::size_t n = rows.getComm()->getRank() == 0 ? rows.getGlobalNumElements() : 0;
  return Teuchos::rcp(new Map(rows.getGlobalNumElements(), n, rows.getIndexBase(), rows.getComm()));
}

/// The entries of a matrix that lies on one rank as a whole.
Eigen::SparseMatrix<double> entries_of(const Matrix& matrix) {
  const auto local = matrix.getLocalMatrixHost();
  const auto columns = matrix.getColMap();
  std::vector<Eigen::Triplet<double>> entries;
  for (int row = 0; row < local.numRows(); ++row) {
    for (auto i = local.graph.row_map(row); i < local.graph.row_map(row + 1); ++i) {
      const auto column = static_cast<int>(columns->getGlobalElement(local.graph.entries(i)));
      entries.emplace_back(row, column, local.values(i));
    }
  }
  Eigen::SparseMatrix<double> sparse(local.numRows(), local.numRows());
  sparse.setFromTriplets(entries.begin(), entries.end());
  return sparse;
}

class Inverse : public Operator {
 public:
  explicit Inverse(const Matrix& matrix)
      : rows_(matrix.getRowMap()),
        import_(rows_, on_root(*rows_)),
        collected_(import_.getTargetMap(), 1),
        solution_(rows_, 1) {
    Matrix whole(import_.getTargetMap(), 0);
    whole.doImport(matrix, import_, Tpetra::INSERT);
    whole.fillComplete();
    base::on_all_ranks(*rows_->getComm(), [&] {
      if (rows_->getComm()->getRank() != 0) return;
      // A piece that is free to turn about a pin has no stiffness against that: a shift far below all others keeps it
      // definite, and the preconditioner need not be exact.
      const auto entries = entries_of(whole);
      factors_.setShift(1e-11 * entries.diagonal().maxCoeff());
      factors_.compute(entries);
      if (factors_.info() != Eigen::Success || factors_.vectorD().minCoeff() <= 0.) {
        throw base::ComputationError("the stiffness is not positive definite");
      }
    });
  }

  Teuchos::RCP<const Map> getDomainMap() const override { return rows_; }
  Teuchos::RCP<const Map> getRangeMap() const override { return rows_; }

  void apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp, double alpha, double beta) const override {
    for (std::size_t column = 0; column < x.getNumVectors(); ++column) {
      collected_.doImport(*x.getVector(column), import_, Tpetra::INSERT);
      if (rows_->getComm()->getRank() == 0) solve_in_place();
      solution_.doExport(collected_, import_, Tpetra::INSERT);
      y.getVectorNonConst(column)->update(alpha, solution_, beta);
    }
  }

 private:
  void solve_in_place() const {
    const auto values = collected_.getLocalViewHost(Tpetra::Access::ReadWrite);
    Eigen::Map<Eigen::VectorXd> b(values.data(), static_cast<Eigen::Index>(values.extent(0)));
    b = factors_.solve(b).eval();
  }

  Teuchos::RCP<const Map> rows_;
  Tpetra::Import<> import_;
  mutable MultiVector collected_;  ///< on rank 0
  mutable MultiVector solution_;
  Factors factors_;
};

}  // namespace

Factorization::Factorization(const Teuchos::RCP<Matrix>& matrix) {
  PERIMORPH_ASSERT(!matrix.is_null(), "there is no matrix");
  operator_ = Teuchos::rcp(new Inverse(*matrix));
}

}  // namespace perimorph::solvers
