#pragma once

#include "perimorph/bonds/bond_families.hpp"
#include "perimorph/discretization/boundary_conditions.hpp"
#include "perimorph/discretization/eigenstrain.hpp"
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
  const discretization::Eigenstrain<dim>* eigenstrain = nullptr;  ///< null: none

  bool has_dilatation() const { return elasticity.has_dilatation(); }

  /// Stiffness of an intact bond's spring, c0 (alpha(x) + alpha(p)) / 2 w_x w_p, [force / length^3]
  /// [WHL19, eq. 15, 21].
  double intact_spring(const bonds::Bond<dim>& bond) const {
    return bonds.stiffness(bond) * 0.5 * (alpha(bond.first_point) + alpha(bond.second_point));
  }
  const materials::BondLaw& law(const bonds::Bond<dim>& bond) const {
    return bonds.materials().law(bond.first_element, bond.second_element);
  }
  /// What softening has left of it; of a broken bond when it broke.
  double spring(const bonds::Bond<dim>& bond) const { return intact_spring(bond) * bonds.share_left(bond); }
  /// What breaking or softening has taken of it; all of a bond that has never been (bonds_across_faces), [-].
  double share_lost(const bonds::Bond<dim>& bond) const { return bond.is_broken ? 1. : 1. - bonds.share_left(bond); }
};

/// A bond that is lost, or as far as it is, and resists being pressed together (contact_forces.hpp).
template <int dim>
struct ContactSpring {
  bonds::Bond<dim> bond;
  base::Point<dim> pull;  ///< that it takes to hold its second end; its first the opposite, [force]
  double energy;          ///< that it stores, [energy]
  double slid_energy;     ///< what 1/2 pull . eta is more than that, where faces have slid, [energy]
};

/// What bonds see of a displacement, at material points.
template <int dim>
struct PointFields {
  std::vector<base::Point<dim>> displacement;  ///< (n_points), [length]
  /// p = g S, the stretch that the dilatation of a point adds to all of its bonds (dilatation.hpp), (n_points),
  /// [-]; empty without dilatation
  std::vector<double> dilatational_stretch = {};
  std::vector<ContactSpring<dim>> contacts = {};  ///< that are closed; those that this rank holds
  std::vector<double> eigenstrain = {};           ///< (n_points), [-]; empty without

  /// eta of a bond, u(p) - u(x) without what the mean eigenstrain of both ends makes of xi, [length].
  base::Point<dim> relative_displacement(const bonds::Bond<dim>& bond) const {
    const base::Point<dim> eta = displacement[bond.second_point] - displacement[bond.first_point];
    return eigenstrain.empty() ? eta : base::Point<dim>(eta - bond.mean_of(eigenstrain) * bond.xi);
  }
};

/// The law of a bond at its present damage [WHL19, eq. 14, 15]: a spring along xi, stretched by eta = u(p) - u(x), as
/// far as that is more than the eigenstrain, and by the dilatation at its ends.
template <int dim>
struct BondSpring {
  base::Point<dim> xi;  ///< [length]
  double elongation;    ///< xi . eta, [length^2]
  double tension;       ///< k (xi . eta + |xi|^2 (p(x) + p(p))), [force / length]

  BondSpring(const CoupledModel<dim>& model, const bonds::Bond<dim>& bond, const PointFields<dim>& at_points)
      : BondSpring(model.spring(bond), bond, at_points) {}

  /// @param stiffness k, [force / length^3]
  BondSpring(double stiffness, const bonds::Bond<dim>& bond, const PointFields<dim>& at_points)
      : xi(bond.xi),
        elongation(bond.xi.dot(at_points.relative_displacement(bond))),
        tension(stiffness * (elongation + dilatation(bond, at_points))) {}

  /// The force on its first point, (dim), [force]; on the second the opposite.
  base::Point<dim> pull() const { return tension * xi; }

  /// Of both its points' shares [WHL19, eq. 21] and what it adds to theirs of the dilatation, [energy].
  double energy() const { return 0.5 * tension * elongation; }

 private:
  static double dilatation(const bonds::Bond<dim>& bond, const PointFields<dim>& at_points) {
    const auto& p = at_points.dilatational_stretch;
    return p.empty() ? 0. : bond.xi.squaredNorm() * (p[bond.first_point] + p[bond.second_point]);
  }
};

}  // namespace perimorph::operators
