#pragma once

#include <memory>
#include <string>
#include <vector>

#include "perimorph/discretization/amplitude.hpp"
#include "perimorph/input/section.hpp"
#include "perimorph/input/values.hpp"

namespace perimorph::cases {

/// A stage of the load: so many increments, at the end of which conditions have reached values.
struct Step {
  std::string name;
  int increments = 1;
  std::vector<std::string> conditions;
  std::vector<double> values;  ///< of each condition, by which its rate is multiplied, [-]
};

void declare(const input::Section& section, Step& step);

/// @param root of the case: steps name conditions
void check_steps(const input::Values& root);

/// What a condition's rate is multiplied by over the increments: 0 at first, linear to a value within the step that
/// names it, and held otherwise. Local.
std::shared_ptr<const discretization::Amplitude> amplitude_of(const std::string& condition,
                                                              const std::vector<Step>& steps);

}  // namespace perimorph::cases
