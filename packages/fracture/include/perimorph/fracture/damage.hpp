#pragma once

#include "perimorph/operators/broken_bonds.hpp"

namespace perimorph::fracture {

/// Bonds that are to break and soften now.
struct Damage {
  bonds::BondChange change;  ///< its energy is that of brittle bonds
  double held_energy;        ///< by all that break, over all ranks, [energy]
};

/// The bonds whose stretch reached the critical one [WHL19, eq. 6, 7], or the worst of them, and those whose softening
/// follows the stretch. Collective.
/// @param classes per local element
/// @param dilatation at the points (CoupledSystem::dilatation), [-]
/// @param fraction share of the overstretched bonds that break at once, above 0, [-]
/// @param may_recover whether softening may be taken back as far as it is not accepted
template <int dim>
Damage find_damage(const base::Comm& comm, const operators::CoupledModel<dim>& model,
                   const operators::PointFields<dim>& at_points, const std::vector<double>& dilatation,
                   const std::vector<morphing::ElementClass>& classes, double fraction, bool may_recover);

}  // namespace perimorph::fracture
