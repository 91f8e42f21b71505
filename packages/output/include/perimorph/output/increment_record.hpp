#pragma once

#include <functional>

#include "perimorph/output/reactions.hpp"

namespace perimorph::output {

/// What an accepted increment came to, over all ranks.
struct IncrementRecord {
  int increment = 0;
  double load_factor = 0.;
  discretization::Counts counts;
  discretization::Energies energies;
  double seconds = 0.;                ///< wall-clock time since the start of the run, [s]
  double overlap = 0.;                ///< of crack faces, the largest, [length]
  std::vector<double> overlap_place;  ///< where that is in the reference mesh, (dim), [length]
  std::vector<Reaction> reactions;
  double measured = 0.;  ///< by which increments are controlled, [length]
};

/// A column of history.csv, and the global variable of that name in the fields.
struct Column {
  std::string name;
  std::function<double(const IncrementRecord&)> value;
};

/// All of them, in the order in which they are written.
/// @param reactions those that each record will have
/// @param is_measured whether increments prescribe a measure
/// @param rubs whether crack faces do
std::vector<Column> history_columns(const std::vector<Reaction>& reactions, bool is_measured = false,
                                    bool rubs = false);

}  // namespace perimorph::output
