#include "perimorph/materials/softening.hpp"

#include <Eigen/LU>
#include <boost/math/constants/constants.hpp>
#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>

namespace perimorph::materials {

namespace {

/// A body of bonds in all directions, strained uniformly along an axis and across it.
template <int dim>
class UniformBody {
 public:
  UniformBody(const BondLaw& law, double dilatational_ratio)
      : law_(law), dilatation_factor_(dim * dilatational_ratio / (2 * (dim + 2))) {}

  struct Stress {
    double along = 0., across = 0.;  ///< in one unit for all
  };
  /// Along the axis, with none across it.
  double uniaxial_stress(double along) const {
    boost::uintmax_t n = 100;  // within these bounds the stress across changes its sign, for any Poisson's ratio
    const auto bracket =
        boost::math::tools::toms748_solve([&](double across) { return stress(along, across).across; }, -2. * along,
                                          2. * along, boost::math::tools::eps_tolerance<double>(40), n);
    return stress(along, 0.5 * (bracket.first + bracket.second)).along;
  }

 private:
  BondLaw law_;
  double dilatation_factor_;  ///< g M

  /// Over directions, with what the dilatation adds to the stretch (operators/dilatation.hpp).
  Stress stress(double along, double across) const {
    constexpr int n = 64;
    constexpr double half_pi = boost::math::constants::half_pi<double>();
    double weights = 0., stretches = 0.;
    Stress of_stretch, of_dilatation;
    for (int i = 0; i < n; ++i) {
      const double x = (i + 0.5) / n, cosine = dim == 2 ? std::cos(half_pi * x) : x;
      const double to_axis = cosine * cosine, from_axis = (1. - to_axis) / (dim - 1);
      const double stretch = to_axis * along + (1. - to_axis) * across,
                   share = stretch > 0. ? law_.share_left(stretch) : 1.;
      weights += share;
      stretches += share * stretch;
      of_stretch.along += share * stretch * to_axis;
      of_stretch.across += share * stretch * from_axis;
      of_dilatation.along += share * to_axis;
      of_dilatation.across += share * from_axis;
    }
    const double p = weights > 0. ? dilatation_factor_ * stretches / weights : 0.;
    return {of_stretch.along + 2. * p * of_dilatation.along, of_stretch.across + 2. * p * of_dilatation.across};
  }
};

/// Strain at which an elastic body bears a stress; between two materials the mean.
template <int dim>
double uniaxial_strain(const Material<dim>& one, const Material<dim>& other, double stress) {
  return 0.5 * stress * (one.e0.inverse()(0, 0) + other.e0.inverse()(0, 0));
}

}  // namespace

template <int dim>
double strength_over_limit(const BondLaw& law, double dilatational_ratio) {
  PERIMORPH_ASSERT(law.softens(), "bonds that break at a stretch of {} do not soften", law.limit());
  constexpr int bits = 20;
  constexpr double largest = 8.;  // strain in limits; the peak is far below
  const UniformBody<dim> body(law, dilatational_ratio);
  const auto minimum = boost::math::tools::brent_find_minima(
      [&](double strain) { return -body.uniaxial_stress(strain * law.limit()); }, 0.9, largest, bits);
  return -minimum.second / UniformBody<dim>(BondLaw(), dilatational_ratio).uniaxial_stress(law.limit());
}

template <int dim>
double least_fracture_energy(const Material<dim>& one, const Material<dim>& other, double tensile_strength) {
  PERIMORPH_ASSERT(tensile_strength > 0., "a tensile strength of {}", tensile_strength);
  const double strain = uniaxial_strain(one, other, tensile_strength);
  return strain * strain * energy_of_bonds(one, other);
}

template <int dim>
Toughness softening_toughness(const Material<dim>& one, const Material<dim>& other, Softening softening,
                              double tensile_strength, double energy) {
  PERIMORPH_ASSERT(energy > least_fracture_energy(one, other, tensile_strength), "a fracture energy of {}", energy);
  const double strain = uniaxial_strain(one, other, tensile_strength);
  const double area = 0.5 * energy / energy_of_bonds(one, other);
  const double ratio = 0.5 * (one.dilatational_ratio + other.dilatational_ratio);
  const auto excess = [&](double limit) {
    return limit * strength_over_limit<dim>(BondLaw::softening(softening, limit, area), ratio) - strain;
  };
  boost::uintmax_t n = 100;
  const auto bracket =
      boost::math::tools::toms748_solve(excess, 0.4 * strain, strain, boost::math::tools::eps_tolerance<double>(20), n);
  return {BondLaw::softening(softening, 0.5 * (bracket.first + bracket.second), area), energy};
}

#define PERIMORPH_INSTANTIATE(dim)                                                           \
  template double strength_over_limit<dim>(const BondLaw&, double);                          \
  template double least_fracture_energy(const Material<dim>&, const Material<dim>&, double); \
  template Toughness softening_toughness(const Material<dim>&, const Material<dim>&, Softening, double, double);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::materials
