#include "perimorph/materials/material.hpp"

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>

#include "perimorph/materials/bond_materials.hpp"

namespace perimorph::materials {

namespace {

template <int dim>
double energy_of_dilatation(const Material<dim>& material) {
  const double with = fracture_energy<dim>(material.micromodulus, 1., material.dilatational_ratio);
  return with - fracture_energy<dim>(material.micromodulus, 1.);
}

/// The share of the stretch by compression that does not count; none for a material that never breaks.
template <int dim>
std::optional<double> uncounted_share(const Material<dim>& material) {
  if (!material.toughness.breaks()) return std::nullopt;
  if (!material.compressive_strength) return 0.;
  return 1. - compressive_strength_of_stretch(material) / *material.compressive_strength;
}

}  // namespace

template <int dim>
Material<dim> elastic_material(ElasticModel model, double youngs_modulus, double poissons_ratio,
                               double characteristic_length, double horizon) {
  Material<dim> material{};
  material.e0 = elasticity_tensor<dim>(model, youngs_modulus, poissons_ratio);
  material.dilatational_ratio = dilatational_ratio(model, poissons_ratio);
  material.micromodulus = calibrate<dim>(model, youngs_modulus, poissons_ratio, characteristic_length, horizon);
  material.youngs_modulus = youngs_modulus;
  material.poissons_ratio = poissons_ratio;
  return material;
}

template <int dim>
double compressive_strength_of_stretch(const Material<dim>& material) {
  if (material.poissons_ratio <= 0.) return std::numeric_limits<double>::infinity();
  return material.youngs_modulus * material.toughness.law.limit() / material.poissons_ratio;
}

template <int dim>
LateralCompression lateral_compression(const Material<dim>& one, const Material<dim>& other, const BondLaw& law) {
  const auto of_one = uncounted_share(one), of_other = uncounted_share(other);
  if (law.softens() || (!of_one && !of_other)) return {};
  const double uncounted = std::min(of_one.value_or(1.), of_other.value_or(1.));
  if (uncounted == 0.) return {};
  const auto mean = [&](auto of) { return 0.5 * (of(one) + of(other)); };
  return {uncounted, mean([](const Material<dim>& m) { return m.e0(0, 1) / m.youngs_modulus; }),
          mean([](const Material<dim>& m) { return m.poissons_ratio / (1. + m.poissons_ratio); })};
}

template <int dim>
double energy_of_bonds(const Material<dim>& one, const Material<dim>& other) {
  const auto at = [&](double r) {
    return harmonic_mean(one.micromodulus(r), other.micromodulus(r)) * std::pow(r, dim + 4);
  };
  return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(at, 0., one.micromodulus.horizon) *
         (dim == 2 ? 1. : boost::math::constants::half_pi<double>());
}

template <int dim>
double fracture_energy(const Material<dim>& one, const Material<dim>& other, double critical_stretch) {
  PERIMORPH_ASSERT(critical_stretch >= 0., "a critical stretch of {}", critical_stretch);
  const double of_dilatation = 0.5 * (energy_of_dilatation(one) + energy_of_dilatation(other));
  return critical_stretch * critical_stretch * (energy_of_bonds(one, other) + of_dilatation);
}

template <int dim>
double critical_stretch(const Material<dim>& one, const Material<dim>& other, double energy) {
  PERIMORPH_ASSERT(energy >= 0., "a fracture energy of {}", energy);
  return std::sqrt(energy / fracture_energy(one, other, 1.));
}

template <int dim>
Toughness perfect_interface(const Material<dim>& one, const Material<dim>& other) {
  Toughness toughness =
      one.toughness.fracture_energy <= other.toughness.fracture_energy ? one.toughness : other.toughness;
  if (!toughness.breaks()) return toughness;
  if (toughness.law.softens()) {
    const double area = 0.5 * toughness.fracture_energy / energy_of_bonds(one, other);
    toughness.law = toughness.law.scaled(std::sqrt(area / toughness.law.area()));
  } else {
    toughness.law = critical_stretch(one, other, toughness.fracture_energy);
  }
  return toughness;
}

#define PERIMORPH_INSTANTIATE(dim)                                                       \
  template Material<dim> elastic_material(ElasticModel, double, double, double, double); \
  template double fracture_energy(const Material<dim>&, const Material<dim>&, double);   \
  template double critical_stretch(const Material<dim>&, const Material<dim>&, double);  \
  template Toughness perfect_interface(const Material<dim>&, const Material<dim>&);      \
  template double energy_of_bonds(const Material<dim>&, const Material<dim>&);           \
  template double compressive_strength_of_stretch(const Material<dim>&);                 \
  template LateralCompression lateral_compression(const Material<dim>&, const Material<dim>&, const BondLaw&);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::materials
