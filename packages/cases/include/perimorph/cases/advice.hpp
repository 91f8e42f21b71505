#pragma once

#include <string>
#include <vector>

#include "perimorph/cases/case.hpp"

namespace perimorph::cases {

/// What a case would choose better, a line each with the parameter, what was found and what it costs; it runs all the
/// same. Local.
/// @param element_size in the seeds, [length] (model/calibration.hpp)
std::vector<std::string> advice(const Case& input, double element_size);

}  // namespace perimorph::cases
