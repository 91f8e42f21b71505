#pragma once

#include "perimorph/base/parallel.hpp"

namespace perimorph::base {

/// Sums over all ranks, in place, of numbers that stand in different places: one message for all of them, and no list
/// whose order somebody must know. Collective.
inline void sum(const Comm& comm, const std::vector<double*>& values) {
  std::vector<double> sums;
  for (const double* value : values) sums.push_back(*value);
  sum(comm, sums);
  for (std::size_t i = 0; i < values.size(); ++i) *values[i] = sums[i];
}

}  // namespace perimorph::base
