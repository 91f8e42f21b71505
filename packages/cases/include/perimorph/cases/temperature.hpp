#pragma once

#include <string>
#include <vector>

#include "perimorph/input/section.hpp"
#include "perimorph/input/values.hpp"

namespace perimorph::cases {

/// A change of temperature: rate * increment + constant, [temperature], times a profile along a direction.
struct Temperature {
  std::string name;
  std::vector<std::string> blocks;  ///< of the mesh; none: the whole body
  double rate = 0., constant = 0.;
  std::vector<double> direction;           ///< (dim); none: the same everywhere
  std::vector<double> positions, factors;  ///< along it, [length], and by what it is multiplied there, [-]
};

void declare(const input::Section& section, Temperature& temperature);

/// What the changes of temperature must agree on with each other and with the materials.
/// @param root of a case
void check_temperatures(const input::Values& root, int dimension);

}  // namespace perimorph::cases
