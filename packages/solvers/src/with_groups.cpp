#include "with_groups.hpp"

#include <Tpetra_Vector.hpp>
#include <algorithm>

#include "perimorph/base/errors.hpp"
#include "perimorph/base/parallel.hpp"

namespace perimorph::solvers {

WithGroups::WithGroups(const Operator& linear_operator, const Teuchos::RCP<const Operator>& inner,
                       const GroupMotions& groups)
    : inner_(inner), rows_(groups.rows), input_(inner->getDomainMap(), 1), output_(inner->getRangeMap(), 1) {
  if (groups.motions.empty()) return;
  constexpr int n_passes = 3;  // with 1, 24 iterations where without groups there are 16
  motions_ = Teuchos::rcp(new MultiVector(inner->getDomainMap(), groups.motions.size()));
  MultiVector forces(inner->getDomainMap(), groups.motions.size());
  for (std::size_t k = 0; k < groups.motions.size(); ++k) {
    const auto motion = motions_->getVectorNonConst(k);
    PERIMORPH_ASSERT(groups.motions[k].size() == motion->getLocalLength(), "a motion of {} unknowns of {}",
                     groups.motions[k].size(), motion->getLocalLength());
    std::copy(groups.motions[k].begin(), groups.motions[k].end(),
              motion->getLocalViewHost(Tpetra::Access::OverwriteAll).data());
    const auto force = forces.getVectorNonConst(k);
    linear_operator.apply(*motion, *force);
    for (int pass = 0; pass < n_passes; ++pass) {
      apply_inner(*force, output_);
      motion->update(-1., output_, 1.);
      linear_operator.apply(*motion, *force);
    }
  }
  stiffness_.compute(products(forces));
  if (stiffness_.info() != Eigen::Success) {
    throw base::ComputationError("the stiffness against the motions of rigid groups is not positive definite");
  }
}

/// Sets the groups' unknowns to zero.
void WithGroups::hold(MultiVector& values) const {
  const auto view = values.getLocalViewHost(Tpetra::Access::ReadWrite);
  for (const int row : rows_) view(row, 0) = 0.;
}

void WithGroups::apply_inner(const MultiVector& x, MultiVector& y) const {
  input_.assign(x);
  hold(input_);
  inner_->apply(input_, y);
  hold(y);
}

/// With all motions, (n_motions, n_vectors). Collective.
Eigen::MatrixXd WithGroups::products(const MultiVector& other) const {
  const auto z = motions_->getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto x = other.getLocalViewHost(Tpetra::Access::ReadOnly);
  std::vector<double> sums(z.extent(1) * x.extent(1), 0.);
  for (std::size_t k = 0; k < x.extent(1); ++k) {
    for (std::size_t j = 0; j < z.extent(1); ++j) {
      for (std::size_t row = 0; row < z.extent(0); ++row) sums[k * z.extent(1) + j] += z(row, j) * x(row, k);
    }
  }
  base::sum(*getDomainMap()->getComm(), sums);
  return Eigen::Map<const Eigen::MatrixXd>(sums.data(), static_cast<Eigen::Index>(z.extent(1)),
                                           static_cast<Eigen::Index>(x.extent(1)));
}

void WithGroups::apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp /*mode*/, double alpha,
                       double beta) const {
  PERIMORPH_ASSERT(x.getNumVectors() == 1 && y.getNumVectors() == 1, "{} vectors in, {} out", x.getNumVectors(),
                   y.getNumVectors());
  apply_inner(x, output_);
  if (!motions_.is_null()) {
    const Eigen::VectorXd moved = stiffness_.solve(products(x).col(0));
    for (Eigen::Index k = 0; k < moved.size(); ++k) output_.update(moved[k], *motions_->getVector(k), 1.);
  }
  y.update(alpha, output_, beta);
}

}  // namespace perimorph::solvers
