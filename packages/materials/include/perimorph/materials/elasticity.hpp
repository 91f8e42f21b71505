#pragma once

#include "perimorph/base/algebra.hpp"

namespace perimorph::materials {

/// What the third dimension does: is free of stress, is not strained, or is computed.
enum class ElasticModel { plane_stress, plane_strain, three_dimensional };

/// The one Poisson's ratio that central pair forces can represent: 1/3 in plane stress, 1/4 in plane strain and 3D
/// [-]. It makes E0 fully symmetric, as [WHL19, eq. 17] needs it.
double bond_based_poissons_ratio(ElasticModel model);

/// (lambda - mu) / mu, lambda Lame's first constant in the plane, [-]: what the volume carries in state-based
/// peridynamics beside bonds that carry mu. Exactly 0 at bond_based_poissons_ratio().
/// @param poissons_ratio as for elasticity_tensor()
double dilatational_ratio(ElasticModel model, double poissons_ratio);

/// How much more an unloaded body expands in the plane than it would if it could expand across it too, [-]: 1 + nu in
/// plane strain, where the stress across the plane that this takes, -E alpha dT, pushes by Poisson's effect; 1
/// otherwise. With it stress = E0 (strain - factor alpha dT I) in the plane.
double expansion_factor(ElasticModel model, double poissons_ratio);

/// Isotropic linear elasticity tensor E0 in Voigt notation with engineering shear, [stress].
/// @param model plane stress or plane strain in 2D, three_dimensional in 3D
/// @param youngs_modulus E > 0, [stress]
/// @param poissons_ratio nu, -1 < nu < 1/2, in plane stress -1 < nu < 1, [-]
/// @return (n_voigt, n_voigt)
template <int dim>
base::Stiffness<dim> elasticity_tensor(ElasticModel model, double youngs_modulus, double poissons_ratio);

}  // namespace perimorph::materials
