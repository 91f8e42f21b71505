#include "perimorph/fracture/damage.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "perimorph/base/errors.hpp"
#include "perimorph/operators/broken_bonds.hpp"

namespace perimorph::fracture {

namespace {

/// From how many times their critical stretches on bonds break: once, or as the last bond among the worst. Those that
/// stretch as far up to rounding, such as mirror images, go together.
template <int dim>
double breaking_ratio(const base::Comm& comm, const bonds::BondFamilies<dim>& bonds,
                      const std::vector<base::Point<dim>>& u, const std::vector<morphing::ElementClass>& classes,
                      const BreakingRule& rule) {
  constexpr double rounding = 1e-12;  // of stretches
  if (rule.fraction >= 1.) return 1.;
  auto all = base::gather_on_all(comm, bonds.overstretches(u, rule.critical, classes));
  if (all.empty()) return 1.;
  const auto n_worst = static_cast<long>(std::ceil(rule.fraction * static_cast<double>(all.size())));
  std::nth_element(all.begin(), all.begin() + (n_worst - 1), all.end(), std::greater<>());
  return std::max(1., all[static_cast<std::size_t>(n_worst - 1)] - rounding / rule.critical.smallest());
}

}  // namespace

template <int dim>
bonds::BondChange bonds_that_break(const base::Comm& comm, const operators::CoupledModel<dim>& model,
                                   const operators::PointFields<dim>& at_points,
                                   const std::vector<morphing::ElementClass>& classes, const BreakingRule& rule) {
  PERIMORPH_ASSERT(rule.critical.smallest() > 0. && rule.fraction > 0. && rule.fraction <= 1.,
                   "critical stretch {}, share {}", rule.critical.smallest(), rule.fraction);
  PERIMORPH_ASSERT(static_cast<int>(at_points.displacement.size()) == model.points.size() &&
                       static_cast<int>(classes.size()) == model.mesh.n_elements(),
                   "displacements at {} of {} points, {} classes", at_points.displacement.size(), model.points.size(),
                   classes.size());
  const auto& bonds = model.bonds;
  const double ratio = breaking_ratio(comm, bonds, at_points.displacement, classes, rule);
  bonds::BondChange change;
  change.broken = bonds.overstretched(at_points.displacement, rule.critical, classes, ratio);
  change.energy = base::sum(comm, operators::bond_energy(model, change.broken, at_points));
  const auto is_counted_here = [&](bonds::BondId b) {
    return bonds.bond(b).first_element < model.mesh.n_owned_elements;
  };
  const auto n_own = std::count_if(change.broken.begin(), change.broken.end(), is_counted_here);
  change.n_broken = base::sum(comm, static_cast<base::GlobalId>(n_own));
  return change;
}

#define PERIMORPH_INSTANTIATE(dim)                                                                    \
  template bonds::BondChange bonds_that_break(const base::Comm&, const operators::CoupledModel<dim>&, \
                                              const operators::PointFields<dim>&,                     \
                                              const std::vector<morphing::ElementClass>&, const BreakingRule&);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::fracture
