#pragma once

#include <string>
#include <vector>

#include "perimorph/input/section.hpp"
#include "perimorph/input/values.hpp"

namespace perimorph::cases {

/// Points, and lines between them, at which displacement and stress are recorded.
struct Probe {
  std::string name;
  std::vector<double> points;  ///< x1 y1 x2 y2 ..., at least one point, [length]
  int divisions = 1;           ///< of each segment between a point and the next
};

/// What is written.
struct Output {
  int every = 1;                       ///< fields: every so many increments, at every break, and at the last one
  bool spread_files = false;           ///< fields in a file of each rank
  int checkpoint_every = 0;            ///< increments; 0: not by these
  double checkpoint_minutes = 10.;     ///< 0: not by time
  std::vector<std::string> reactions;  ///< groups whose reaction is recorded; default: all with prescribed displacement
  bool records_crack = false;          ///< its size and path
  std::vector<int> bond_increments;    ///< after which all bonds are written
  std::vector<Probe> probes;
};

void declare(const input::Section& section, Output& output);
void check_output(const input::Values& section, int dimension);

}  // namespace perimorph::cases
