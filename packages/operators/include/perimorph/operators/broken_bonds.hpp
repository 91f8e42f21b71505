#pragma once

#include <vector>

#include "perimorph/operators/coupled_model.hpp"

namespace perimorph::operators {

/// Takes the forces of newly broken bonds out of an internal force. Local.
template <int dim>
void subtract_bond_forces(const CoupledModel<dim>& model, const std::vector<std::size_t>& broken,
                          const std::vector<base::Point<dim>>& at_points, std::vector<double>& force);

/// Energy stored in bonds just before they break, counted by the rank that owns a bond's first element:
/// Sum 1/2 k (xi . eta)^2, [energy]. Local.
template <int dim>
double bond_energy(const CoupledModel<dim>& model, const std::vector<std::size_t>& bonds,
                   const std::vector<base::Point<dim>>& at_points);

}  // namespace perimorph::operators
