#pragma once

#include <Eigen/Cholesky>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Operator.hpp>

#include "perimorph/solvers/linear_solver.hpp"

namespace perimorph::solvers {

/// A preconditioner B that holds the unknowns of groups fast, completed by their motions Q, which take the rest of the
/// body along: B + Z (Z^T A Z)^-1 Z^T, where Z is Q after some steps Z - B A Z. It is the factorization by blocks, with
/// B for the inverse of the stiffness of all that is not held.
class WithGroups : public Operator {
 public:
  /// Collective. Operator and groups are read here only.
  /// @throws ComputationError if Z^T A Z is not positive definite, on all ranks
  WithGroups(const Operator& linear_operator, const Teuchos::RCP<const Operator>& inner, const GroupMotions& groups);

  Teuchos::RCP<const Tpetra::Map<>> getDomainMap() const override { return inner_->getDomainMap(); }
  Teuchos::RCP<const Tpetra::Map<>> getRangeMap() const override { return inner_->getRangeMap(); }
  void apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp mode, double alpha, double beta) const override;

 private:
  Teuchos::RCP<const Operator> inner_;
  std::vector<int> rows_;
  Teuchos::RCP<MultiVector> motions_;  ///< Z; null: none is free
  Eigen::LLT<Eigen::MatrixXd> stiffness_;
  mutable MultiVector input_, output_;

  void hold(MultiVector& values) const;
  void apply_inner(const MultiVector& x, MultiVector& y) const;
  Eigen::MatrixXd products(const MultiVector& other) const;
};

}  // namespace perimorph::solvers
