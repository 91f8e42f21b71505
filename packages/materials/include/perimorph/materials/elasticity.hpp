#pragma once

#include "perimorph/base/algebra.hpp"

namespace perimorph::materials {

enum class ElasticModel { plane_stress, plane_strain, three_dimensional };

/// The one Poisson's ratio that central pair forces can represent: 1/3 in plane stress, 1/4 in plane strain and 3D.
double bond_based_poissons_ratio(ElasticModel model);

/// Isotropic linear elasticity tensor E0 in Voigt notation with engineering shear, [stress].
/// @param youngs_modulus [stress]
template <int dim>
base::Stiffness<dim> elasticity_tensor(ElasticModel model, double youngs_modulus, double poissons_ratio);

}  // namespace perimorph::materials
