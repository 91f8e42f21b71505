#pragma once

#include <vector>

#include "perimorph/operators/coupled_model.hpp"

namespace perimorph::operators {

/// Takes out of an internal force what bonds no longer hold. Local.
/// @param at_points displacement at which the force was computed, (n_points), [length]
/// @param force on owned degrees of freedom, [force]
template <int dim>
void subtract_lost_forces(const CoupledModel<dim>& model, const bonds::BondChange& change,
                          const PointFields<dim>& at_points, std::vector<double>& force);

/// Energies that bonds held just before they broke: Sum 1/2 k (xi . eta)^2 [WHL19, eq. 21], [energy].
struct HeldEnergy {
  double all = 0., brittle = 0.;
};

/// Counted by the rank that owns a bond's first element. Local.
/// @param broken of this rank, (n)
/// @param at_points displacement, (n_points), [length]
template <int dim>
HeldEnergy energy_of_broken(const CoupledModel<dim>& model, const std::vector<bonds::BondId>& broken,
                            const PointFields<dim>& at_points);

/// What softening has dissipated since it was last accepted, each bond on its way from there to here: Sum Int 1/2 k
/// (xi . eta)^2 dD, [energy]. Counted likewise. Local.
/// @param at_points displacement, (n_points), [length]
template <int dim>
double dissipation_of_softening(const CoupledModel<dim>& model, const PointFields<dim>& at_points);

}  // namespace perimorph::operators
