#pragma once

#include <vector>

#include "perimorph/io/disk.hpp"
#include "perimorph/io/exodus.hpp"
#include "perimorph/output/console.hpp"

namespace perimorph::output {

/// What results have come to, for a run that goes on after them; by default, before the first increment.
struct ResultsState {
  double seconds = 0.;         ///< wall-clock time since the start of the run, [s]
  double seconds_before = 0.;  ///< of them, before this process was started, [s]
  io::SeriesExtent series;
  Totals totals;
  std::vector<double> peaks;                          ///< of each reaction, [force]
  std::vector<base::GlobalId> peak_increments;        ///< in which increment
  std::vector<io::FileExtent> tables, fields, bonds;  ///< the files that there are; on rank 0
};

/// All of a state's files.
std::vector<io::FileExtent> files_of(const ResultsState& state);

}  // namespace perimorph::output
