#pragma once

#include <optional>

#include "perimorph/input/section.hpp"
#include "perimorph/input/values.hpp"
#include "perimorph/materials/elasticity.hpp"
#include "perimorph/model/problem.hpp"

namespace perimorph::cases {

/// When something breaks. Brittle bonds: at most one of stretch and energy is given; with neither it never does. Bonds
/// that soften: strength and energy are.
struct Fracture {
  materials::Softening bond_law = materials::Softening::none;
  std::optional<double> critical_stretch;  ///< [-]
  std::optional<double> fracture_energy;   ///< [energy / area]
  std::optional<double> tensile_strength;  ///< [stress]

  bool breaks() const { return critical_stretch || fracture_energy; }
  bool softens() const { return bond_law != materials::Softening::none; }
};

/// A homogeneous, isotropic, linearly elastic material.
struct Solid : Fracture {
  std::string name = "body";
  std::vector<std::string> blocks;              ///< of the mesh, that it fills
  double youngs_modulus = 0.;                   ///< [stress]
  double poissons_ratio = 0.;                   ///< [-]
  double density = 0.;                          ///< [mass / volume]
  double thermal_expansion = 0.;                ///< [1 / temperature]
  std::optional<double> characteristic_length;  ///< [length]; none: that of all
  std::optional<double> compressive_strength;   ///< [stress]; none: that of bonds which break by their stretch alone
};

/// The material of all blocks that no other fills, and what holds for all materials.
struct Material : Solid {
  materials::ElasticModel elastic_model = materials::ElasticModel::plane_stress;
  model::Calibration calibration = model::Calibration::mesh_consistent;
};

/// Where two materials meet.
struct Interface : Fracture {
  std::string name;
  std::vector<std::string> materials;  ///< two
};

void declare(const input::Section& section, Material& material);
void declare(const input::Section& section, Solid& solid);
void declare(const input::Section& section, Interface& interface);

/// What the values of the materials and of their interfaces must agree on.
/// @param root of a case
void check_materials(const input::Values& root, int dimension);

/// Poisson's ratios that stand for the exact one (0.333 for 1/3) become that.
/// @param root of a case's values
void complete_materials(Teuchos::ParameterList& root);

/// Whether bonds of any material, or between any two, soften.
/// @param root of a case
bool softens(const input::Values& root);

/// Whether bonds of any material, or between any two, break.
/// @param root of a case
bool breaks(const input::Values& root);

/// Whether the dilatation carries in any material what bonds alone cannot: for other Poisson's ratios than theirs.
bool has_dilatation(const input::Values& root);

}  // namespace perimorph::cases
