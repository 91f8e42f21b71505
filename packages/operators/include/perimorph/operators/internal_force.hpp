#pragma once

#include <vector>

#include "perimorph/operators/coupled_model.hpp"

namespace perimorph::operators {

/// Displacement at every point of the elements that have bonds (zero elsewhere): B u.
/// @param u on all local degrees of freedom (copies too), [length]
template <int dim>
std::vector<base::Point<dim>> displacements_at_points(const CoupledModel<dim>& model, const double* u);

/// Forces of the deformed body on its nodes, f = K_local u + B^T K_bonds B u, without any matrix; on the owned degrees
/// of freedom, [force]. No rank needs another's result. Local.
template <int dim>
std::vector<double> internal_force(const CoupledModel<dim>& model, const double* u,
                                   const std::vector<base::Point<dim>>& at_points);

/// Takes the forces of newly broken bonds out of an internal force. Local.
template <int dim>
void subtract_bond_forces(const CoupledModel<dim>& model, const std::vector<std::size_t>& broken,
                          const std::vector<base::Point<dim>>& at_points, std::vector<double>& force);

}  // namespace perimorph::operators
