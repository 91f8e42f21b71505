#pragma once

#include "perimorph/input/resolved.hpp"

namespace perimorph::fracture {

/// The one Poisson's ratio of bond-based peridynamics for an "Elastic Model": pair-wise central forces leave no other.
double poissons_ratio_of(const std::string& elastic_model);

/// The checks that concern several parameters together. Those that lack a value they need say nothing: that mistake is
/// already listed.
void check_case(const input::Resolved& resolved, input::Mistakes& mistakes);

}  // namespace perimorph::fracture
