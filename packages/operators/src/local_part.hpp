#pragma once

#include "perimorph/base/field.hpp"
#include "perimorph/elements/strain.hpp"
#include "perimorph/operators/coupled_model.hpp"

namespace perimorph::operators {

/// Calls visit(q, strain, stress, w) for each point of an element: those of its continuous part, E(x) strain. The
/// strain is what it is more than the eigenstrain. Local.
template <int dim, class Visit>
void visit_local_part(const CoupledModel<dim>& model, int e, base::ConstField u, Visit visit) {
  elements::with_corners<dim>(model.mesh.n_corners(e), [&](auto corners) {
    constexpr int n = decltype(corners)::value;
    Eigen::Matrix<double, dim * n, 1> d;
    for (int k = 0; k < n; ++k) {
      d.template segment<dim>(k * dim) = base::at_node<dim>(u, model.dofs.nodes_of(e)[k]);
    }
    for (int q = 0; q < model.points.count(e); ++q) {
      const int point = model.points.first(e) + q;
      base::Voigt<dim> strain = elements::strain_matrix<dim, n>(model.points.gradients(e, q)) * d;
      if (model.eigenstrain != nullptr) strain.template head<dim>().array() -= model.eigenstrain->at_points()[point];
      const base::Voigt<dim> stress = model.elasticity.at(e, q) * strain;
      visit(q, strain, stress, model.points.weight(point));
    }
  });
}

}  // namespace perimorph::operators
