#include "perimorph/operators/supports.hpp"

#include <cmath>

namespace perimorph::operators {

template <int dim>
Supports<dim>::Supports(const CoupledModel<dim>& model, const discretization::Dirichlet<dim>& dirichlet,
                        const std::vector<char>& discontinuous)
    : diagonal(static_cast<std::size_t>(model.dofs.n_owned_nodes()) * dim, 0.) {
  for (int n = 0; n < model.dofs.n_nodes(); ++n) {
    for (int c = 0; c < dim; ++c) fixed.push_back(dirichlet.prescribes(model.dofs.reference_node(n), c));
  }
  for (int e = 0; e < model.mesh.n_elements(); ++e) {
    double volume = 0.;
    for (int p = model.points.first(e); p < model.points.first(e + 1); ++p) volume += model.points.weight(p);
    const double stiffness = model.elasticity.e0()(0, 0) * std::pow(volume, (dim - 2.) / dim);
    for (int k = 0; k < model.mesh.n_corners(e); ++k) {
      const int node = model.dofs.nodes_of(e)[k];
      if (node >= model.dofs.n_owned_nodes()) continue;
      for (int dof = node * dim; dof < (node + 1) * dim; ++dof) {
        if (fixed[dof]) {
          diagonal[dof] = std::max(diagonal[dof], stiffness);
        } else if (discontinuous[e]) {
          diagonal[dof] = anchor * stiffness;
        }
      }
    }
  }
}

template struct Supports<2>;
template struct Supports<3>;

}  // namespace perimorph::operators
