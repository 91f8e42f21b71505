#include "perimorph/discretization/space.hpp"

#include <Tpetra_Import.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>

#include "perimorph/base/errors.hpp"

namespace perimorph::discretization {

template <int dim>
Space<dim>::Space(const DofMap<dim>& dofs, const Dirichlet<dim>& dirichlet)
    : dofs_(dofs),
      dirichlet_(dirichlet),
      owned_(Teuchos::rcp(new Vector(dofs.owned_dofs()))),
      all_(Teuchos::rcp(new Vector(dofs.all_dofs()))) {
  for (int n = 0; n < dofs.n_nodes(); ++n) {
    for (int c = 0; c < dim; ++c) {
      fixed_.push_back(dirichlet.prescribes(dofs.reference_node(n), c));
      if (fixed_.back() != 0) prescribed_.push_back(n * dim + c);
    }
  }
}

template <int dim>
void Space<dim>::expand(base::Field u, double load_factor) const {
  PERIMORPH_ASSERT(static_cast<std::size_t>(u.size()) == n_local(), "{} values for {} degrees of freedom", u.size(),
                   n_local());
  {
    const auto owned = owned_->getLocalViewHost(Tpetra::Access::OverwriteAll);
    std::copy_n(u.getRawPtr(), n_owned(), owned.data());
  }
  all_->doImport(*owned_, *dofs_.import(), Tpetra::INSERT);
  const auto all = all_->getLocalViewHost(Tpetra::Access::ReadOnly);
  std::copy_n(all.data(), n_local(), u.getRawPtr());
  for (const int dof : prescribed_) u[dof] = ramp(dof).at(load_factor);
}

template <int dim>
base::ConstField Space<dim>::expand_change(const Vector& x) const {
  PERIMORPH_ASSERT(x.getLocalLength() == n_owned(), "{} values for {} unknowns", x.getLocalLength(), n_owned());
  all_->doImport(x, *dofs_.import(), Tpetra::INSERT);
  const auto all = all_->getLocalViewHost(Tpetra::Access::ReadWrite);
  for (const int dof : prescribed_) all(dof, 0) = 0.;
  return {all.data(), static_cast<base::ConstField::size_type>(n_local())};
}

template <int dim>
std::vector<double> Space<dim>::prescribed_rates(double load_factor, double step) const {
  std::vector<double> rates(n_local(), 0.);
  for (const int dof : prescribed_) rates[dof] = ramp(dof).rate_in(load_factor, step);
  return rates;
}

template <int dim>
void Space<dim>::restrict_forces(base::Field forces) const {
  const auto n = static_cast<std::size_t>(forces.size());
  PERIMORPH_ASSERT(n == n_local() || n == n_owned(), "{} forces for {} degrees of freedom", n, n_local());
  for (const int dof : prescribed_) {
    if (dof < forces.size()) forces[dof] = 0.;
  }
}

template class Space<2>;
template class Space<3>;

}  // namespace perimorph::discretization
