#pragma once

#include <vector>

#include "single_precision_cycle.hpp"

namespace perimorph::solvers {

/// The same levels, small ones on fewer ranks: a cycle visits them often, and what a visit costs there is messages.
/// A level is held by as many ranks as get `fewest_rows` each, but by no more than the one above it; consecutive ranks
/// give their rows to the first of them, so that all rows keep their numbers. Ranks without rows exchange nothing.
/// Collective.
/// @param levels from fine to coarse, rows in the order of ranks; the finest stays where it is
/// @param fewest_rows of a rank that holds any, >= 1
std::vector<CycleLevel> gather_small_levels(std::vector<CycleLevel> levels, int fewest_rows);

}  // namespace perimorph::solvers
