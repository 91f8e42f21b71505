#pragma once

#include "perimorph/bonds/critical_stretches.hpp"
#include "perimorph/operators/coupled_model.hpp"

namespace perimorph::fracture {

/// Which bonds break: those whose stretch reached the critical one [WHL19, eq. 6, 7], or the worst of them.
struct BreakingRule {
  bonds::CriticalStretches critical;  ///< infinite where nothing breaks [-]
  double fraction = 1.;               ///< share of the overstretched bonds that break at once [-]
};

/// The bonds that break now. Collective.
/// @param classes per local element
template <int dim>
bonds::BondChange bonds_that_break(const base::Comm& comm, const operators::CoupledModel<dim>& model,
                                   const operators::PointFields<dim>& at_points,
                                   const std::vector<morphing::ElementClass>& classes, const BreakingRule& rule);

}  // namespace perimorph::fracture
