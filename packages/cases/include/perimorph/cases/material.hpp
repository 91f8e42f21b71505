#pragma once

#include <optional>

#include "perimorph/input/section.hpp"
#include "perimorph/input/values.hpp"
#include "perimorph/materials/elasticity.hpp"
#include "perimorph/model/problem.hpp"

namespace perimorph::cases {

/// One homogeneous, isotropic, linearly elastic, brittle material.
struct Material {
  double youngs_modulus = 0.;  ///< [stress]
  double poissons_ratio = 0.;  ///< [-]
  materials::ElasticModel elastic_model = materials::ElasticModel::plane_stress;
  std::optional<double> critical_stretch, fracture_energy;  ///< [-], [energy / area]; at most one; none: nothing breaks
  model::Calibration calibration = model::Calibration::mesh_consistent;

  bool breaks() const { return critical_stretch || fracture_energy; }
};

void declare(const input::Section& section, Material& material);
void check_material(const input::Values& section, int dimension);

/// A Poisson's ratio that stands for the exact one (0.333 for 1/3) becomes that.
void complete_material(Teuchos::ParameterList& values);

/// Whether the dilatation carries what bonds alone cannot: for other Poisson's ratios than theirs.
bool has_dilatation(const input::Values& material);

}  // namespace perimorph::cases
