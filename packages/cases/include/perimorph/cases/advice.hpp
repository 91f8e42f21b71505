#pragma once

#include <string>
#include <vector>

#include "perimorph/cases/case.hpp"

namespace perimorph::cases {

/// What a case would choose better, a line each with the parameter, what was found and what it costs; it runs all the
/// same. Local.
/// @param element_size in the seeds, [length] (model/calibration.hpp)
std::vector<std::string> advice(const Case& input, double element_size);

/// Whether critical stretches, given or derived, look like a mistake of units. Local.
/// @param critical_stretches s_crit of each material (solids_of), infinite if it does not break at once, [-]
std::vector<std::string> advice_on_stretches(const Case& input, const std::vector<double>& critical_stretches);

/// Whether the increments fit the load at which the first bond breaks. Local.
/// @param first_break its load factor; infinite if no bond is stretched [-]
std::vector<std::string> advice_on_load(const Case& input, double first_break);

}  // namespace perimorph::cases
