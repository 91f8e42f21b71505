#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "perimorph/materials/bond_law.hpp"
#include "perimorph/materials/elasticity.hpp"
#include "perimorph/materials/micromodulus.hpp"

namespace perimorph::materials {

/// How bonds break, which goes with a fracture energy. Of critical stretch and energy one is given, the other follows.
struct Toughness {
  BondLaw law = {};                                                  ///< unbreakable if nothing else is said
  double fracture_energy = std::numeric_limits<double>::infinity();  ///< G_c, [energy / area]
  bool is_stretch_given = false;

  double critical_stretch() const { return law.critical_stretch(); }  ///< [-]; infinite: nothing breaks
  bool breaks() const { return !std::isinf(critical_stretch()); }
};

/// An isotropic, linearly elastic material that is brittle or softens.
template <int dim>
struct Material {
  std::string name;
  base::Stiffness<dim> e0;         ///< elasticity tensor, [stress]
  double dilatational_ratio = 0.;  ///< kappa / mu (materials::dilatational_ratio), [-]; 0: bonds alone carry
  Micromodulus micromodulus;
  Toughness toughness = {};
  double density = 0.;                              ///< [mass / volume]
  double youngs_modulus = 0., poissons_ratio = 0.;  ///< [stress], [-]
  /// None: that of bonds which break by their stretch alone, [stress].
  std::optional<double> compressive_strength = {};
  double thermal_expansion = 0.;  ///< alpha_T in the directions that are computed (expansion_factor), [1 / temperature]
};

/// A material that never breaks. Arguments as for elasticity_tensor() and calibrate().
template <int dim>
Material<dim> elastic_material(ElasticModel model, double youngs_modulus, double poissons_ratio,
                               double characteristic_length, double horizon);

/// Where two materials meet.
struct Interface {
  int first, second;  ///< materials, by their place in a list; first < second
  Toughness toughness;
};

/// Fracture energy of a plane between two materials (or within one) across which every bond breaks at a critical
/// stretch, [energy / area]: as fracture_energy(), with the bonds' mean micromodulus, and of the dilatation half of
/// each.
template <int dim>
double fracture_energy(const Material<dim>& one, const Material<dim>& other, double critical_stretch);

/// The inverse, [-]. @param energy G_c >= 0, [energy / area]
template <int dim>
double critical_stretch(const Material<dim>& one, const Material<dim>& other, double energy);

/// What bonds alone contribute to it at a critical stretch of 1, [energy / area].
template <int dim>
double energy_of_bonds(const Material<dim>& one, const Material<dim>& other);

/// The uniaxial compression at which bonds that break, or soften, by their stretch alone begin to do so: across it they
/// stretch by nu times its strain. E s0 / nu, infinite for nu <= 0, [stress].
template <int dim>
double compressive_strength_of_stretch(const Material<dim>& material);

/// What compression across them does to bonds between two materials (or within one), so that each bears its
/// compressive strength; between two the share that does not count is the smaller one of those that break.
/// @param law of these bonds; those that soften go by their stretch
template <int dim>
LateralCompression lateral_compression(const Material<dim>& one, const Material<dim>& other, const BondLaw& law);

/// The less tough of two materials; of two that never break neither.
/// @return toughness of a perfect interface between them
template <int dim>
Toughness perfect_interface(const Material<dim>& one, const Material<dim>& other);

}  // namespace perimorph::materials
