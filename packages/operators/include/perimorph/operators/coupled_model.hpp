#pragma once

#include "perimorph/bonds/bond_families.hpp"
#include "perimorph/discretization/boundary_conditions.hpp"
#include "perimorph/operators/morphed_stiffness.hpp"

namespace perimorph::operators {

/// What the coupled operator K = K_local + B^T K_bonds B is made of, in the current topology. A view: owns nothing.
template <int dim>
struct CoupledModel {
  const mesh::Mesh<dim>& mesh;
  const elements::MaterialPoints<dim>& points;
  const bonds::BondFamilies<dim>& bonds;
  const morphing::MorphingField<dim>& alpha;
  const MorphedStiffness<dim>& elasticity;
  const discretization::DofMap<dim>& dofs;

  /// Stiffness of an intact bond's spring, c0 (alpha(x) + alpha(p)) / 2 w_x w_p  [WHL19, eq. 15, 21].
  double spring(std::size_t bond, int first_point, int second_point) const {
    return bonds.stiffness(bond, first_point, second_point) * 0.5 * (alpha(first_point) + alpha(second_point));
  }
};

}  // namespace perimorph::operators
