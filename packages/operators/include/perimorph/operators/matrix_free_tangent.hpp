#pragma once

#include <Tpetra_Operator.hpp>
#include <vector>

#include "perimorph/discretization/space.hpp"
#include "perimorph/operators/force_term.hpp"

namespace perimorph::operators {

/// The tangent of terms without a matrix: the same operator as StiffnessMatrix. Every rank computes the forces on its
/// own degrees of freedom whole.
template <int dim>
class MatrixFreeTangent : public Tpetra::Operator<double> {
 public:
  using MultiVector = Tpetra::MultiVector<double>;
  using Map = Tpetra::Map<>;

  /// Local. The space must outlive this.
  /// @param constraints stiffness on the diagonal where displacements are prescribed, per owned degree of freedom,
  ///        [force / length]; 0 elsewhere
  MatrixFreeTangent(const discretization::Space<dim>& space, ForceTerms<dim> terms, std::vector<double> constraints);

  Teuchos::RCP<const Map> getDomainMap() const override { return space_.dofs().owned_dofs(); }
  Teuchos::RCP<const Map> getRangeMap() const override { return space_.dofs().owned_dofs(); }

  /// y = beta y + alpha K x, on owned degrees of freedom. Collective. K is symmetric: the mode makes no difference.
  void apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp mode = Teuchos::NO_TRANS, double alpha = 1.,
             double beta = 0.) const override;

  std::size_t bytes() const;  ///< of memory

 private:
  const discretization::Space<dim>& space_;
  ForceTerms<dim> terms_;
  std::vector<double> constraints_;
  mutable std::vector<double> forces_;  ///< on all local degrees of freedom
};

}  // namespace perimorph::operators
