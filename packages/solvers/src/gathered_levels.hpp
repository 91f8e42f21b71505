#pragma once

#include <vector>

#include "single_precision_cycle.hpp"

namespace perimorph::solvers {

/// How many ranks hold a coarse level: as many as get `fewest_rows` each, but no more than `most`. Local.
int n_holders_of(const Matrix& matrix, int most, int fewest_rows);

/// The first coarse level that fewer ranks hold than the finest, which `n_ranks` hold; n_levels if there is none.
/// Local.
std::size_t first_on_fewer_ranks(const std::vector<CycleLevel>& levels, int n_ranks, int fewest_rows);

/// The same levels, small ones on fewer ranks: a cycle visits them often, and what a visit costs there is messages.
/// A level is held by as many ranks as get `fewest_rows` each, but by no more than the one above it; consecutive ranks
/// give their rows to the first of them, so that all rows keep their numbers. Ranks without rows exchange nothing.
/// Collective.
/// @param levels from fine to coarse, rows in the order of ranks; the finest stays where it is
/// @param n_ranks that hold the finest
/// @param fewest_rows of a rank that holds any, >= 1
std::vector<CycleLevel> gather_small_levels(std::vector<CycleLevel> levels, int n_ranks, int fewest_rows);

}  // namespace perimorph::solvers
