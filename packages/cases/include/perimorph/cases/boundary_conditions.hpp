#pragma once

#include <string>
#include <vector>

#include "perimorph/cases/temperature.hpp"
#include "perimorph/discretization/boundary_conditions.hpp"
#include "perimorph/input/section.hpp"
#include "perimorph/input/values.hpp"

namespace perimorph::cases {

/// Force per area on a side set: rate * increment + constant, [stress], (dim) each.
struct Traction {
  std::string name, group;
  std::vector<double> rate, constant;
};

/// Pressure on a side set: rate * increment + constant, [stress].
struct Pressure {
  std::string name, group;
  double rate = 0., constant = 0.;
};

/// A plane beyond which the body goes on as its mirror image.
struct SymmetryPlane {
  std::string name, group;
};

/// What holds the body and what loads it.
struct BoundaryConditions {
  std::vector<discretization::PrescribedComponent> displacements;  ///< directions of any length
  std::vector<discretization::RigidGroup> rigid_groups;
  std::vector<SymmetryPlane> symmetry_planes;
  std::vector<Traction> tractions;
  std::vector<Pressure> pressures;
  std::vector<Temperature> temperatures;
  std::vector<double> body_force_rate, body_force_constant;    ///< (dim), [force / volume]
  std::vector<double> self_weight_rate, self_weight_constant;  ///< (dim), [length / time^2]

  /// Whether all grow with the increment from zero.
  bool are_proportional() const;
};

void declare(const input::Section& section, BoundaryConditions& conditions);
void check_boundary_conditions(const input::Values& section, int dimension);

/// The condition with a direction of length 1, or along an axis with that component. Local.
discretization::PrescribedComponent normalized(discretization::PrescribedComponent condition);
std::vector<discretization::PrescribedComponent> normalized(
    std::vector<discretization::PrescribedComponent> conditions);

/// What a rigid group's nodes have in common, in the words of the case file. Local.
std::string shared_by(const discretization::RigidGroup& group);

/// No numbers at all become zeros.
void complete_boundary_conditions(Teuchos::ParameterList& values, int dimension);

}  // namespace perimorph::cases
