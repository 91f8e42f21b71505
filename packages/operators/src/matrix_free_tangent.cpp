#include "perimorph/operators/matrix_free_tangent.hpp"

#include <Tpetra_Vector.hpp>
#include <algorithm>

#include "perimorph/base/errors.hpp"
#include "perimorph/base/profiler_mark.hpp"

namespace perimorph::operators {

template <int dim>
MatrixFreeTangent<dim>::MatrixFreeTangent(const discretization::Space<dim>& space, ForceTerms<dim> terms,
                                          std::vector<double> constraints)
    : space_(space), terms_(std::move(terms)), constraints_(std::move(constraints)), forces_(space.n_local()) {
  PERIMORPH_ASSERT(constraints_.size() == space.n_owned(), "{} constraints for {} degrees of freedom",
                   constraints_.size(), space.n_owned());
}

template <int dim>
void MatrixFreeTangent<dim>::apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp /*mode*/, double alpha,
                                   double beta) const {
  PERIMORPH_ASSERT(x.getNumVectors() == y.getNumVectors(), "{} vectors in, {} out", x.getNumVectors(),
                   y.getNumVectors());
  PERIMORPH_DEBUG_ASSERT(x.getMap()->isSameAs(*getDomainMap()) && y.getMap()->isSameAs(*getRangeMap()),
                         "other unknowns than the space's");
  PERIMORPH_ASSERT(&x != &y, "the result would replace the argument while it is read");
  const base::ProfilerMark mark(base::ProfilerMark::tangent, static_cast<double>(bytes()),
                                static_cast<double>(space_.n_owned()));
  for (std::size_t column = 0; column < x.getNumVectors(); ++column) {
    const auto one = x.getVector(column);
    const auto change = space_.expand_change(*one);
    std::fill(forces_.begin(), forces_.end(), 0.);
    for (const auto& term : terms_) term->add_tangent_product(change, base::field(forces_));
    space_.restrict_forces(base::field(forces_));

    const auto own_x = one->getLocalViewHost(Tpetra::Access::ReadOnly);
    const auto own_y = y.getVectorNonConst(column)->getLocalViewHost(Tpetra::Access::ReadWrite);
    for (const int dof : space_.prescribed()) {
      if (static_cast<std::size_t>(dof) < space_.n_owned()) forces_[dof] = constraints_[dof] * own_x(dof, 0);
    }
    for (std::size_t dof = 0; dof < constraints_.size(); ++dof) {
      const double result = alpha * forces_[dof];
      own_y(dof, 0) = beta == 0. ? result : beta * own_y(dof, 0) + result;
    }
  }
}

template <int dim>
std::size_t MatrixFreeTangent<dim>::bytes() const {
  std::size_t sum = 0;
  for (const auto& term : terms_) sum += term->bytes();
  return sum;
}

template class MatrixFreeTangent<2>;
template class MatrixFreeTangent<3>;

}  // namespace perimorph::operators
