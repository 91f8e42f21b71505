#include "perimorph/fracture/damage.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "perimorph/base/errors.hpp"

namespace perimorph::fracture {

namespace {

/// From how many times their critical stretches on bonds break: once, or as the last bond among the worst. Those that
/// stretch as far up to rounding, such as mirror images, go together.
template <int dim>
double breaking_ratio(const base::Comm& comm, const bonds::BondFamilies<dim>& bonds,
                      const std::vector<base::Point<dim>>& u, const bonds::PointStrains& strains,
                      const std::vector<morphing::ElementClass>& classes, double fraction) {
  constexpr double rounding = 1e-12;  // of stretches
  if (fraction >= 1.) return 1.;
  auto all = base::gather_on_all(comm, bonds.overstretches(u, classes, 1., strains));
  if (all.empty()) return 1.;
  const auto n_worst = static_cast<long>(std::ceil(fraction * static_cast<double>(all.size())));
  std::nth_element(all.begin(), all.begin() + (n_worst - 1), all.end(), std::greater<>());
  return std::max(1., all[static_cast<std::size_t>(n_worst - 1)] - rounding / bonds.materials().smallest_limit());
}

}  // namespace

template <int dim>
Damage find_damage(const base::Comm& comm, const operators::CoupledModel<dim>& model,
                   const operators::PointFields<dim>& at_points, const std::vector<double>& dilatation,
                   const std::vector<morphing::ElementClass>& classes, double fraction, bool may_recover) {
  PERIMORPH_ASSERT(fraction > 0. && fraction <= 1., "share {}", fraction);
  PERIMORPH_ASSERT(static_cast<int>(at_points.displacement.size()) == model.points.size() &&
                       static_cast<int>(classes.size()) == model.mesh.n_elements(),
                   "displacements at {} of {} points, {} classes", at_points.displacement.size(), model.points.size(),
                   classes.size());
  const auto& bonds = model.bonds;
  const auto& u = at_points.displacement;
  const bonds::PointStrains strains{at_points.eigenstrain, dilatation};
  const double ratio = breaking_ratio(comm, bonds, u, strains, classes, fraction);
  bonds::BondChange change;
  change.broken = bonds.overstretched(u, classes, ratio, strains);
  change.softened = bonds.softened(u, classes, may_recover, at_points.eigenstrain);
  const auto is_counted_here = [&](bonds::BondId b) { return bonds.counts_here(bonds.bond(b)); };
  const auto held = operators::energy_of_broken(model, change.broken, at_points);
  std::vector<double> sums = {
      held.all, held.brittle,
      static_cast<double>(std::count_if(change.broken.begin(), change.broken.end(), is_counted_here)),
      static_cast<double>(std::count_if(change.softened.begin(), change.softened.end(),
                                        [&](const auto& softened) { return is_counted_here(softened.id); }))};
  base::sum(comm, sums);
  change.energy = sums[1];
  change.n_broken = static_cast<base::GlobalId>(sums[2]);
  change.n_softened = static_cast<base::GlobalId>(sums[3]);
  return {std::move(change), sums[0]};
}

#define PERIMORPH_INSTANTIATE(dim)                                                            \
  template Damage find_damage(const base::Comm&, const operators::CoupledModel<dim>&,         \
                              const operators::PointFields<dim>&, const std::vector<double>&, \
                              const std::vector<morphing::ElementClass>&, double, bool);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::fracture
