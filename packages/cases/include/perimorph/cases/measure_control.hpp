#pragma once

#include <string>
#include <vector>

#include "perimorph/input/section.hpp"
#include "perimorph/input/values.hpp"

namespace perimorph::cases {

/// What increments prescribe.
enum class Control { load, measure };

/// A displacement that increments prescribe instead of the load factor.
struct MeasureControl {
  std::string group, other_group;          ///< "" where there is a point instead, or no other place
  std::vector<double> point, other_point;  ///< [length]
  std::vector<double> direction;
  double rate = 0.;      ///< [length per increment]
  double constant = 0.;  ///< [length]
};

void declare(const input::Section& section, MeasureControl& measure);
void check_measure_control(const input::Values& loading, int dimension);

}  // namespace perimorph::cases
