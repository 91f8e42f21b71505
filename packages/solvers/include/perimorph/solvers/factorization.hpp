#pragma once

#include "perimorph/solvers/multigrid.hpp"

namespace perimorph::solvers {

/// The inverse of a symmetric positive definite matrix by sparse Cholesky factorization on rank 0: robust where
/// multigrid is not, in a body of pieces that hang on few bonds, but with the memory of one rank.
class Factorization {
 public:
  /// Collective. @throws ComputationError if the matrix is not positive definite.
  explicit Factorization(const Teuchos::RCP<Matrix>& matrix);

  const Teuchos::RCP<Operator>& apply_inverse() const { return operator_; }

 private:
  Teuchos::RCP<Operator> operator_;
};

}  // namespace perimorph::solvers
