#pragma once

#include <string>
#include <vector>

#include "perimorph/fracture/case.hpp"

namespace perimorph::fracture {

/// What a case would choose better, a line each with the parameter, what was found and what it costs; it runs all the
/// same. Local.
/// @param element_size in the seeds, [length] (see calibration.hpp)
std::vector<std::string> advice(const Case& input, double element_size);

}  // namespace perimorph::fracture
