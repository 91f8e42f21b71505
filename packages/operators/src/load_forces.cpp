#include "perimorph/operators/load_forces.hpp"

#include <cmath>

#include "perimorph/base/errors.hpp"

namespace perimorph::operators {

template <int dim>
void LoadForces<dim>::apply_load(double load_factor) {
  PERIMORPH_ASSERT(std::isfinite(load_factor), "load factor {}", load_factor);
  forces_ = loads_.forces(model_.mesh, model_.points, model_.dofs, load_factor);
}

template <int dim>
void LoadForces<dim>::add_force(base::ConstField /*u*/, base::Field force) const {
  PERIMORPH_ASSERT(static_cast<int>(forces_.size()) == model_.dofs.n_owned_nodes() * dim,
                   "no load factor has been applied: {} forces", forces_.size());
  for (std::size_t dof = 0; dof < forces_.size(); ++dof) force[dof] -= forces_[dof];
}

template <int dim>
void LoadForces<dim>::add_load_derivative(base::Field force) const {
  const auto rates = loads_.rates(model_.mesh, model_.points, model_.dofs);
  for (std::size_t dof = 0; dof < rates.size(); ++dof) force[dof] -= rates[dof];
}

/// The potential -f . u.
template <int dim>
double LoadForces<dim>::energy(base::ConstField u) const {
  double energy = 0.;
  for (std::size_t dof = 0; dof < forces_.size(); ++dof) energy -= forces_[dof] * u[dof];
  return energy;
}

template class LoadForces<2>;
template class LoadForces<3>;

}  // namespace perimorph::operators
