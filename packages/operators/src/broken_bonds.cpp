#include "perimorph/operators/broken_bonds.hpp"

#include <algorithm>

#include "at_points.hpp"
#include "perimorph/base/errors.hpp"

namespace perimorph::operators {

namespace {

template <int dim>
void subtract(const CoupledModel<dim>& model, const bonds::Bond<dim>& bond, const BondSpring<dim>& spring,
              std::vector<double>& force) {
  spread<dim>(model, bond.first_element, bond.first_end, spring.pull(), base::field(force));
  spread<dim>(model, bond.second_element, bond.second_end, -spring.pull(), base::field(force));
}

/// What a bond releases over its loss of stiffness, in units of 1/2 s^2, s being its stretch, [energy]: k |xi|^4, and
/// with it goes what it adds to the dilatation at its ends (Dilatation), which it is weighted by.
template <int dim>
double energy_release(const CoupledModel<dim>& model, const bonds::Bond<dim>& bond, const PointFields<dim>& at_points,
                      double to) {
  const double squared_length = bond.xi.squaredNorm();
  const double unit = model.intact_spring(bond) * squared_length * squared_length;
  const auto& p = at_points.dilatational_stretch;
  if (p.empty()) return unit;
  const double stretch = std::max(to, BondSpring<dim>(0., bond, at_points).elongation / squared_length);
  const auto share = [&](int element, double p_here) {
    const double factor = model.elasticity.dilatation_factor(element);
    const double ratio = p_here / stretch;
    return factor == 0. ? 2. * ratio : ratio * (2. - ratio / factor);
  };
  return unit *
         (1. + share(bond.first_element, p[bond.first_point]) + share(bond.second_element, p[bond.second_point]));
}

}  // namespace

template <int dim>
void subtract_lost_forces(const CoupledModel<dim>& model, const bonds::BondChange& change,
                          const PointFields<dim>& at_points, std::vector<double>& force) {
  PERIMORPH_ASSERT(static_cast<int>(at_points.displacement.size()) == model.points.size(),
                   "displacements at {} of {} points", at_points.displacement.size(), model.points.size());
  PERIMORPH_ASSERT(static_cast<int>(force.size()) == model.dofs.n_owned_nodes() * dim, "{} forces on {} owned nodes",
                   force.size(), model.dofs.n_owned_nodes());
  for (const auto b : change.broken) {
    const auto bond = model.bonds.bond(b);
    subtract(model, bond, BondSpring<dim>(model, bond, at_points), force);
  }
  for (const auto& [b, stretch, loss] : change.softened) {
    const auto bond = model.bonds.bond(b);
    subtract(model, bond, BondSpring<dim>(loss * model.intact_spring(bond), bond, at_points), force);
  }
}

template <int dim>
HeldEnergy energy_of_broken(const CoupledModel<dim>& model, const std::vector<bonds::BondId>& broken,
                            const PointFields<dim>& at_points) {
  PERIMORPH_ASSERT(static_cast<int>(at_points.displacement.size()) == model.points.size(),
                   "displacements at {} of {} points", at_points.displacement.size(), model.points.size());
  HeldEnergy held;
  for (const auto b : broken) {
    const auto bond = model.bonds.bond(b);
    const double share = model.bonds.share_here(bond);
    if (share == 0.) continue;
    const double energy = share * BondSpring<dim>(model, bond, at_points).energy();
    held.all += energy;
    if (!model.law(bond).softens()) held.brittle += energy;
  }
  return held;
}

template <int dim>
double dissipation_of_softening(const CoupledModel<dim>& model, const PointFields<dim>& at_points) {
  PERIMORPH_ASSERT(static_cast<int>(at_points.displacement.size()) == model.points.size(),
                   "displacements at {} of {} points", at_points.displacement.size(), model.points.size());
  double dissipated = 0.;
  model.bonds.for_each_bond([&](const bonds::Bond<dim>& bond) {
    const double share = model.bonds.share_here(bond);
    if (share == 0. || !model.law(bond).softens()) return;
    const auto& law = model.law(bond);
    const auto [accepted, largest] = model.bonds.softening(bond.id);
    const double to = bond.is_broken ? law.critical_stretch() : static_cast<double>(largest);
    if (to == accepted) return;
    dissipated +=
        share * energy_release(model, bond, at_points, to) * (law.dissipation(to) - law.dissipation(accepted));
  });
  return dissipated;
}

#define PERIMORPH_INSTANTIATE(dim)                                                                                \
  template void subtract_lost_forces(const CoupledModel<dim>&, const bonds::BondChange&, const PointFields<dim>&, \
                                     std::vector<double>&);                                                       \
  template HeldEnergy energy_of_broken(const CoupledModel<dim>&, const std::vector<bonds::BondId>&,               \
                                       const PointFields<dim>&);                                                  \
  template double dissipation_of_softening(const CoupledModel<dim>&, const PointFields<dim>&);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::operators
