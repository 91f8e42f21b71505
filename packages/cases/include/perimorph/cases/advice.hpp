#pragma once

#include <string>
#include <vector>

#include "perimorph/cases/case.hpp"

namespace perimorph::cases {

/// What a case would choose better, a line each with the parameter, what was found and what it costs; it runs all the
/// same. Local.
/// @param element_size in the seeds, [length] (model/calibration.hpp)
std::vector<std::string> advice(const Case& input, double element_size);

/// Whether the critical stretch, given or derived, looks like a mistake of units. Local.
/// @param critical_stretch s_crit, infinite if nothing breaks [-]
std::vector<std::string> advice_on_stretch(const Case& input, double critical_stretch);

/// Whether the increments fit the load at which the first bond breaks. Local.
/// @param first_break its load factor; infinite if no bond is stretched [-]
std::vector<std::string> advice_on_load(const Case& input, double first_break);

}  // namespace perimorph::cases
