#include "perimorph/operators/matrix_free_stiffness.hpp"

#include <Tpetra_Import.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>

namespace perimorph::operators {

template <int dim>
MatrixFreeStiffness<dim>::MatrixFreeStiffness(const CoupledModel<dim>& model, const Supports<dim>& supports)
    : model_(model),
      local_(model),
      bonds_(model),
      diagonal_(supports.diagonal),
      all_x_(Teuchos::rcp(new Tpetra::Vector<double>(model.dofs.all_dofs()))),
      forces_(supports.fixed.size()) {
  for (std::size_t dof = 0; dof < supports.fixed.size(); ++dof) {
    if (supports.fixed[dof]) fixed_.push_back(static_cast<int>(dof));
  }
}

template <int dim>
void MatrixFreeStiffness<dim>::apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp /*mode*/, double alpha,
                                     double beta) const {
  for (std::size_t column = 0; column < x.getNumVectors(); ++column) {
    const auto one = x.getVector(column);
    all_x_->doImport(*one, *model_.dofs.import(), Tpetra::INSERT);
    const auto all = all_x_->getLocalViewHost(Tpetra::Access::ReadWrite);
    for (const int dof : fixed_) all(dof, 0) = 0.;
    compute_forces(all.data());
    const auto own_x = one->getLocalViewHost(Tpetra::Access::ReadOnly);
    const auto own_y = y.getVectorNonConst(column)->getLocalViewHost(Tpetra::Access::ReadWrite);
    for (const int dof : fixed_) forces_[dof] = 0.;
    for (std::size_t dof = 0; dof < diagonal_.size(); ++dof) {
      const double result = alpha * (forces_[dof] + diagonal_[dof] * own_x(dof, 0));
      own_y(dof, 0) = beta == 0. ? result : beta * own_y(dof, 0) + result;
    }
  }
}

template <int dim>
void MatrixFreeStiffness<dim>::scale_anchors(double factor) {
  for (std::size_t dof = 0; dof < diagonal_.size(); ++dof) {
    if (!std::binary_search(fixed_.begin(), fixed_.end(), static_cast<int>(dof))) diagonal_[dof] *= factor;
  }
}

template <int dim>
std::vector<double> MatrixFreeStiffness<dim>::internal_force(const double* u) const {
  compute_forces(u);
  return {forces_.begin(), forces_.begin() + static_cast<std::ptrdiff_t>(diagonal_.size())};
}

template <int dim>
void MatrixFreeStiffness<dim>::compute_forces(const double* u) const {
  std::fill(forces_.begin(), forces_.end(), 0.);
  local_.add(u, forces_.data());
  bonds_.add(u, forces_.data());
}

template class MatrixFreeStiffness<2>;
template class MatrixFreeStiffness<3>;

}  // namespace perimorph::operators
