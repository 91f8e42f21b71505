#include "perimorph/discretization/space.hpp"

#include <Tpetra_Import.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <iterator>
#include <utility>

#include "perimorph/base/errors.hpp"

namespace perimorph::discretization {

template <int dim>
Space<dim>::Space(const DofMap<dim>& dofs, const Dirichlet<dim>& dirichlet, std::vector<double> starts)
    : dofs_(dofs),
      dirichlet_(dirichlet),
      starts_(std::move(starts)),
      frames_(dofs, dirichlet),
      groups_(dofs, dirichlet.groups(), dirichlet.load_factor()),
      hanging_(dofs),
      is_constrained_(static_cast<std::size_t>(dofs.n_nodes()) * dim, 0),
      owned_(Teuchos::rcp(new Vector(dofs.owned_dofs()))),
      all_(Teuchos::rcp(new Vector(dofs.all_dofs()))) {
  PERIMORPH_ASSERT(starts_.empty() || starts_.size() == n_local(), "{} starts for {} degrees of freedom",
                   starts_.size(), n_local());
  for (int dof = 0; dof < dofs.n_real_nodes() * dim; ++dof) {
    if (dirichlet.prescribes(dofs.reference_node(dof / dim), dof % dim)) prescribed_.push_back(dof);
  }
  const auto& across = dofs.across_planes();
  std::set_union(prescribed_.begin(), prescribed_.end(), across.begin(), across.end(), std::back_inserter(along_axes_));
  prescribed_.clear();
  const auto in_frames = frames_.prescribed();
  std::merge(along_axes_.begin(), along_axes_.end(), in_frames.begin(), in_frames.end(),
             std::back_inserter(prescribed_));
  const auto tied = groups_.dofs();
  add_hanging(tied);
  std::merge(prescribed_.begin(), prescribed_.end(), tied.begin(), tied.end(), std::back_inserter(constrained_));
  for (const int dof : constrained_) is_constrained_[dof] = 1;
  if (dofs.images().empty()) return;
  with_images_.resize(n_local());
  for (int dof = dofs.n_real_nodes() * dim; dof < static_cast<int>(n_local()); ++dof) {
    is_constrained_[dof] = is_constrained_[dofs.image(dof / dim).node * dim + dof % dim];
  }
}

/// Those of hanging nodes are prescribed by their parents', but for groups', which move with these.
template <int dim>
void Space<dim>::add_hanging(const std::vector<int>& tied) {
  const auto hanging = hanging_.dofs();
  std::vector<int> of_no_group, all;
  std::set_difference(hanging.begin(), hanging.end(), tied.begin(), tied.end(), std::back_inserter(of_no_group));
  std::set_union(prescribed_.begin(), prescribed_.end(), of_no_group.begin(), of_no_group.end(),
                 std::back_inserter(all));
  prescribed_ = std::move(all);
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
  std::copy_n(all.data(), all.extent(0), u.getRawPtr());
  for (const int dof : along_axes_) u[dof] = ramp(dof).at(load_factor) + (starts_.empty() ? 0. : starts_[dof]);
  frames_.prescribe(u, load_factor);
  groups_.prescribe(u, load_factor);
  hanging_.complete(u);
  dofs_.complete_images(u);
}

template <int dim>
base::ConstField Space<dim>::expand_change(const Vector& x) const {
  PERIMORPH_ASSERT(x.getLocalLength() == n_owned(), "{} values for {} unknowns", x.getLocalLength(), n_owned());
  all_->doImport(x, *dofs_.import(), Tpetra::INSERT);
  const auto all = all_->getLocalViewHost(Tpetra::Access::ReadWrite);
  if (!with_images_.empty()) std::copy_n(all.data(), all.extent(0), with_images_.begin());
  const base::Field change(with_images_.empty() ? all.data() : with_images_.data(),
                           static_cast<base::Field::size_type>(n_local()));
  complete_change(change);
  return change;
}

template <int dim>
void Space<dim>::complete_change(base::Field change) const {
  PERIMORPH_ASSERT(static_cast<std::size_t>(change.size()) == n_local(), "{} values for {} degrees of freedom",
                   change.size(), n_local());
  for (const int dof : prescribed_) change[dof] = 0.;
  frames_.turn_back(change);
  groups_.project(change);
  hanging_.complete(change);
  dofs_.complete_images(change);
}

template <int dim>
std::vector<double> Space<dim>::prescribed_rates(double load_factor, double step) const {
  std::vector<double> rates(n_local(), 0.);
  for (const int dof : along_axes_) rates[dof] = ramp(dof).rate_in(load_factor, step);
  frames_.add_rates(base::field(rates), load_factor, step);
  groups_.add_rates(base::field(rates), load_factor, step);
  hanging_.complete(base::field(rates));
  dofs_.complete_images(base::field(rates));
  return rates;
}

template <int dim>
void Space<dim>::restrict_forces(base::Field forces) const {
  const auto n = static_cast<std::size_t>(forces.size());
  PERIMORPH_ASSERT(n == n_local() || n == n_owned(), "{} forces for {} degrees of freedom", n, n_local());
  if (n == n_local()) hanging_.gather(forces);
  frames_.turn(forces);
  for (const int dof : prescribed_) {
    if (dof < forces.size()) forces[dof] = 0.;
  }
  groups_.project(forces);
}

template <int dim>
bool Space<dim>::is_held(int node, int component) const {
  return std::binary_search(along_axes_.begin(), along_axes_.end(), node * dim + component) ||
         frames_.decides(node, component) || groups_.decides(node, component);
}

template <int dim>
void Space<dim>::turn(Tpetra::MultiVector<double>& vectors) const {
  if (frames_.is_empty()) return;
  const auto values = vectors.getLocalViewHost(Tpetra::Access::ReadWrite);
  for (std::size_t column = 0; column < values.extent(1); ++column) {
    frames_.turn({&values(0, column), static_cast<base::Field::size_type>(n_owned())});
  }
}

template class Space<2>;
template class Space<3>;

}  // namespace perimorph::discretization
