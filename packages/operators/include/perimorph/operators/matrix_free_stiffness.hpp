#pragma once

#include <Tpetra_Operator.hpp>
#include <Tpetra_Vector_fwd.hpp>

#include "perimorph/operators/bond_forces.hpp"
#include "perimorph/operators/local_forces.hpp"
#include "perimorph/operators/supports.hpp"

namespace perimorph::operators {

/// The coupled stiffness K of WHL19, eq. 22, without a matrix: the same operator as CoupledStiffness. Every rank
/// computes the forces on its own degrees of freedom whole.
template <int dim>
class MatrixFreeStiffness : public Tpetra::Operator<double> {
 public:
  using MultiVector = Tpetra::MultiVector<double>;
  using Map = Tpetra::Map<>;

  /// Local. The model is read again and must outlive this.
  MatrixFreeStiffness(const CoupledModel<dim>& model, const Supports<dim>& supports);

  Teuchos::RCP<const Map> getDomainMap() const override { return model_.dofs.owned_dofs(); }
  Teuchos::RCP<const Map> getRangeMap() const override { return model_.dofs.owned_dofs(); }

  /// y = beta y + alpha K x. Collective. K is symmetric: the mode makes no difference.
  void apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp mode = Teuchos::NO_TRANS, double alpha = 1.,
             double beta = 0.) const override;

  /// Forces of the deformed body on its nodes, K u without any supports, on the owned degrees of freedom, [force]. No
  /// rank needs another's result. Local.
  /// @param u on all local degrees of freedom (copies too), [length]
  std::vector<double> internal_force(const double* u) const;

  /// Takes newly broken bonds out. Local.
  void subtract(const std::vector<std::size_t>& broken) { bonds_.subtract(broken); }

  /// Multiplies the springs that anchor the nodes of discontinuous elements. Local.
  void scale_anchors(double factor);

  std::size_t bytes() const { return bonds_.bytes() + local_.bytes(); }  ///< of memory

 private:
  CoupledModel<dim> model_;
  LocalForces<dim> local_;
  BondForces<dim> bonds_;
  std::vector<int> fixed_;        ///< local degrees of freedom that are prescribed
  std::vector<double> diagonal_;  ///< of the supports
  Teuchos::RCP<Tpetra::Vector<double>> all_x_;
  mutable std::vector<double> forces_;  ///< on all local degrees of freedom

  void compute_forces(const double* u) const;
};

}  // namespace perimorph::operators
