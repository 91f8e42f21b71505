#pragma once

#include "perimorph/input/section.hpp"
#include "perimorph/input/values.hpp"
#include "perimorph/model/numerical_options.hpp"

namespace perimorph::cases {

/// The longest horizon in characteristic lengths, [-]: the longest bonds are then 1e-43 as stiff as short ones.
inline constexpr double longest_horizon = 100.;

/// The nonlocal model. Lengths in the mesh's unit.
struct Peridynamics {
  double horizon = 0., characteristic_length = 0.;  ///< [length]
  discretization::CrackFaces crack_faces = discretization::CrackFaces::free;
  double friction = 0.;  ///< [-]
};

void declare(const input::Section& section, Peridynamics& peridynamics, model::NumericalOptions& numerical);
void check_peridynamics(const input::Values& root);

}  // namespace perimorph::cases
