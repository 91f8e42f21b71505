#pragma once

#include <limits>

namespace perimorph::operators {

/// Which bonds a matrix takes in, and by what their stiffness is multiplied.
struct BondSelection {
  double reach;  ///< bonds up to this length, [length]
  double scale;  ///< [-]
};
inline constexpr BondSelection all_bonds = {std::numeric_limits<double>::infinity(), 1.};

/// Reach of the short-range matrix if the case file says nothing, in horizons [-] (DECISIONS.md, 10).
constexpr double default_short_range_cut_off(int dimension) { return dimension == 2 ? 0.52 : 0.45; }

}  // namespace perimorph::operators
