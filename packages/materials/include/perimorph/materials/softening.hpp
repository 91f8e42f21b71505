#pragma once

#include "perimorph/materials/material.hpp"

namespace perimorph::materials {

/// The largest stress of a body of bonds that is pulled uniformly along one axis and free across it, over the stress at
/// which it would stretch by the limit if nothing softened, [-], > 1: bonds oblique to the pull soften later than those
/// along it. By integration over their directions, without surfaces.
/// @param law that softens
/// @param dilatational_ratio kappa / mu, [-]
template <int dim>
double strength_over_limit(const BondLaw& law, double dilatational_ratio = 0.);

/// The smallest fracture energy that bonds between two materials (or within one) of a tensile strength may have, that
/// of brittle ones, [energy / area]. @param tensile_strength f_t > 0, [stress]
template <int dim>
double least_fracture_energy(const Material<dim>& one, const Material<dim>& other, double tensile_strength);

/// Bonds between two materials (or within one) that soften so that a uniform body bears f_t, and a crack takes G_f =
/// 2 tau0 I6 times the area under their law (in three dimensions pi tau0 I7): what dilatation adds for brittle bonds
/// has gone before they part (tests/verification/softening.cpp).
/// @param softening not none
/// @param energy G_f, above the least one, [energy / area]
template <int dim>
Toughness softening_toughness(const Material<dim>& one, const Material<dim>& other, Softening softening,
                              double tensile_strength, double energy);

}  // namespace perimorph::materials
