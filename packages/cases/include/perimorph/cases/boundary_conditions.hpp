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

/// What holds the body and what loads it.
struct BoundaryConditions {
  std::vector<discretization::PrescribedComponent> displacements;
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

/// No numbers at all become zeros.
void complete_boundary_conditions(Teuchos::ParameterList& values, int dimension);

}  // namespace perimorph::cases
