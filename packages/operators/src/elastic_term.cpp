#include "perimorph/operators/elastic_term.hpp"

#include <numeric>

namespace perimorph::operators {

template <int dim>
ElasticTerm<dim>::ElasticTerm(const CoupledModel<dim>& model)
    : LinearTerm<dim>(static_cast<std::size_t>(model.dofs.n_owned_nodes()) * dim), model_(model) {}

template <int dim>
void ElasticTerm<dim>::add_force(base::ConstField u, base::Field force) const {
  if (model_.eigenstrain == nullptr) return this->add_tangent_product(u, force);
  add_force_at(u, model_.eigenstrain->at_points(), force);
}

template <int dim>
void ElasticTerm<dim>::add_load_derivative(base::Field force) const {
  if (model_.eigenstrain == nullptr) return;
  const std::vector<double> held_still(force.size(), 0.);
  add_force_at(base::field(held_still), model_.eigenstrain->rates(0.), force);
}

/// 1/2 (F . u + dEnergy / d eigenstrain . eigenstrain), since it is of second degree in both.
template <int dim>
double ElasticTerm<dim>::energy(base::ConstField u) const {
  const double of_forces = LinearTerm<dim>::energy(u);
  if (model_.eigenstrain == nullptr) return of_forces;
  std::vector<double> confinement(model_.points.size(), 0.);
  this->add_confinement(u, base::field(confinement));
  const auto n_owned = model_.points.first(model_.mesh.n_owned_elements);
  return of_forces + 0.5 * std::inner_product(confinement.begin(), confinement.begin() + n_owned,
                                              model_.eigenstrain->at_points().begin(), 0.);
}

template class ElasticTerm<2>;
template class ElasticTerm<3>;

}  // namespace perimorph::operators
