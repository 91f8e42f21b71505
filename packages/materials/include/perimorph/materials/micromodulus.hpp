#pragma once

#include <cmath>

#include "perimorph/base/errors.hpp"
#include "perimorph/materials/elasticity.hpp"

namespace perimorph::materials {

/// c0(r) = tau0 exp(-r/l) up to the horizon, 0 beyond [WHL19, eq. 24]. A bond's force is c0 (xi . eta) xi per volume^2.
struct Micromodulus {
  double tau0;                   ///< [stress / length^(dim+4) * length^2]: E0 = 1/2 Int c0 xi^4 dV  [WHL19, eq. 17]
  double characteristic_length;  ///< l, [length]
  double horizon;                ///< delta, [length]

  /// c0 at a distance >= 0, [length].
  double operator()(double distance) const {
    PERIMORPH_DEBUG_ASSERT(distance >= 0., "a distance of {}", distance);
    constexpr double slack = 1. + 1e-9;  // points a horizon apart, as in regular meshes, are in whatever their rounding
    return distance <= slack * horizon ? tau0 * std::exp(-distance / characteristic_length) : 0.;
  }
};

/// I_n = Int_0^delta r^n exp(-r/l) dr in closed form, [length^(n+1)].
/// @param n >= 0
/// @param characteristic_length l > 0, [length]
/// @param horizon delta > 0, [length]
double kernel_moment(int n, double characteristic_length, double horizon);

/// The micromodulus whose integral over a full neighbourhood gives E0 [WHL19, eq. 17] without what the volume carries,
/// analytic: tau0 = 8 C1111 / (3 pi I5) in 2D, tau0 = 5 C1111 / (2 pi I6) in 3D, with C1111 = 3 mu.
/// @param youngs_modulus E > 0, [stress]
/// @param poissons_ratio nu as for elasticity_tensor(), [-]
/// @param characteristic_length l > 0, [length]
/// @param horizon delta > 0, [length]
template <int dim>
Micromodulus calibrate(ElasticModel model, double youngs_modulus, double poissons_ratio, double characteristic_length,
                       double horizon);

/// Energy per new crack area of all bonds that cross it, broken at the critical stretch, [energy / area]:
/// G_c = s_c^2 (tau0 I6 + kappa J) in 2D, s_c^2 (tau0 I7 pi/2 + kappa J) in 3D (bond energy 1/2 c0 s^2 r^4, integrated
/// as Silling and Askari 2005), where kappa = lambda - mu and J = Int_0^delta theta1(z)^2 dz is of the dilatation at a
/// distance z from a plane all of whose crossing bonds have unit stretch.
/// @param critical_stretch s_c >= 0, [-]
/// @param dilatational_ratio kappa / mu, [-]; here and below
template <int dim>
double fracture_energy(const Micromodulus& micromodulus, double critical_stretch, double dilatational_ratio = 0.);

/// The critical stretch s_c >= 0 that goes with a fracture energy: the inverse of fracture_energy().
/// @param energy G_c >= 0, [energy / area]
template <int dim>
double critical_stretch(const Micromodulus& micromodulus, double energy, double dilatational_ratio = 0.);

}  // namespace perimorph::materials
