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

  /// Stiffness of an intact bond's spring, c0 (alpha(x) + alpha(p)) / 2 w_x w_p, [force / length^3]
  /// [WHL19, eq. 15, 21].
  double spring(const bonds::Bond<dim>& bond) const {
    return bonds.stiffness(bond) * 0.5 * (alpha(bond.first_point) + alpha(bond.second_point));
  }
};

/// The law of an intact bond [WHL19, eq. 14, 15]: a spring along xi, stretched by eta = u(p) - u(x).
template <int dim>
struct BondSpring {
  double stiffness;     ///< k, [force / length^3]
  base::Point<dim> xi;  ///< [length]
  double elongation;    ///< xi . eta, [length^2]

  /// @param u displacement at the points, (n_points), [length]
  BondSpring(const CoupledModel<dim>& model, const bonds::Bond<dim>& bond, const std::vector<base::Point<dim>>& u)
      : stiffness(model.spring(bond)),
        xi(bond.xi),
        elongation(bond.xi.dot(u[bond.second_point] - u[bond.first_point])) {}

  /// The force on its first point, (dim), [force]; on the second the opposite.
  base::Point<dim> pull() const { return stiffness * elongation * xi; }

  /// Of both its points' shares [WHL19, eq. 21], [energy].
  double energy() const { return 0.5 * stiffness * elongation * elongation; }
};

}  // namespace perimorph::operators
