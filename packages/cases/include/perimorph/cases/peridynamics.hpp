#pragma once

#include "perimorph/input/section.hpp"
#include "perimorph/input/values.hpp"
#include "perimorph/model/numerical_options.hpp"

namespace perimorph::cases {

/// The nonlocal model. Lengths in the mesh's unit.
struct Peridynamics {
  double horizon = 0., characteristic_length = 0.;  ///< [length]
};

void declare(const input::Section& section, Peridynamics& peridynamics, model::NumericalOptions& numerical);
void check_peridynamics(const input::Values& section);

}  // namespace perimorph::cases
