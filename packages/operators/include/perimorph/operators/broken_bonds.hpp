#pragma once

#include <vector>

#include "perimorph/operators/coupled_model.hpp"

namespace perimorph::operators {

/// Takes the forces of newly broken bonds out of an internal force. Local.
/// @param broken of this rank, (n), each once
/// @param at_points displacement at which the force was computed, (n_points), [length]
/// @param force on owned degrees of freedom, [force]
template <int dim>
void subtract_bond_forces(const CoupledModel<dim>& model, const std::vector<std::size_t>& broken,
                          const PointFields<dim>& at_points, std::vector<double>& force);

/// Energy stored in bonds just before they break, counted by the rank that owns a bond's first element:
/// Sum 1/2 k (xi . eta)^2 [WHL19, eq. 21], [energy]. Local.
/// @param bonds of this rank, (n)
/// @param at_points displacement, (n_points), [length]
template <int dim>
double bond_energy(const CoupledModel<dim>& model, const std::vector<std::size_t>& bonds,
                   const PointFields<dim>& at_points);

}  // namespace perimorph::operators
