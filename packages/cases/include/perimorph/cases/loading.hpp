#pragma once

#include "perimorph/cases/measure_control.hpp"
#include "perimorph/cases/steps.hpp"
#include "perimorph/model/numerical_options.hpp"

namespace perimorph::cases {

/// How far to go, and when to give up.
struct Loading {
  int increments = 0;
  Control control = Control::load;
  MeasureControl measure;
  std::vector<Step> steps;            ///< none: all loads grow with the increment
  std::optional<int> largest_break;   ///< of bonds in an increment, beyond which it is cut
  int max_damage_iterations = 20000;  ///< solves within one increment
  int max_zone_growths = 5000;        ///< changes of topology within one increment
};

void declare(const input::Section& section, Loading& loading, model::NumericalOptions& numerical);

/// @param softens whether any bonds do
/// @param breaks whether any bonds do
void check_loading(const input::Values& section, int dimension, bool softens, bool breaks);

}  // namespace perimorph::cases
