#pragma once

#include "perimorph/base/field.hpp"
#include "perimorph/operators/coupled_model.hpp"

namespace perimorph::operators {

/// Displacement of the q-th point of an element, (dim), [length]. Local.
/// @param u on all local degrees of freedom, [length]
template <int dim>
base::Point<dim> displacement_at(const CoupledModel<dim>& model, base::ConstField u, int element, int q) {
  const int* nodes = model.dofs.nodes_of(element);
  const auto& shape = model.points.shape(element, q);
  base::Point<dim> sum = base::Point<dim>::Zero();
  for (int k = 0; k < model.mesh.n_corners(element); ++k) sum += shape[k] * base::at_node<dim>(u, nodes[k]);
  return sum;
}

/// Spreads a force at the q-th point of an element to its corners. Local.
/// @param force on all local degrees of freedom, or on owned ones, [force]
template <int dim>
void spread(const CoupledModel<dim>& model, int element, int q, const base::Point<dim>& at_point, base::Field force) {
  const int* nodes = model.dofs.nodes_of(element);
  const auto& shape = model.points.shape(element, q);
  for (int k = 0; k < model.mesh.n_corners(element); ++k) {
    if (nodes[k] * dim >= force.size()) continue;
    for (int c = 0; c < dim; ++c) force[nodes[k] * dim + c] += shape[k] * at_point[c];
  }
}

}  // namespace perimorph::operators
