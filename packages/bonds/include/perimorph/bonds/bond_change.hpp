#pragma once

#include <utility>
#include <vector>

#include "perimorph/bonds/bond.hpp"

namespace perimorph::bonds {

/// The largest stretch of a bond that softens, [-]: when an increment was last accepted, and with what the present one
/// has added so far.
struct SofteningHistory {
  float accepted = 0.F, largest = 0.F;
};

/// Bonds of a rank, and what they have come to.
using SofteningHistories = std::vector<std::pair<BondId, SofteningHistory>>;

/// A bond whose softening has changed.
struct SoftenedBond {
  BondId id;
  float largest_stretch;  ///< [-]
  double loss;  ///< of stiffness since before, as a share of the intact bond's; below 0 if it has recovered [-]
};

/// Bonds that have just broken or softened. Published once, and taken by everything that depends on bonds; every rank
/// that holds a bond receives it.
struct BondChange {
  std::vector<BondId> broken;               ///< bonds of this rank, ascending
  base::GlobalId n_broken = 0;              ///< over all ranks, each counted once
  double energy = 0.;                       ///< that this dissipates, over all ranks, [energy]
  std::vector<SoftenedBond> softened = {};  ///< bonds of this rank, ascending; none that broke
  base::GlobalId n_softened = 0;            ///< over all ranks, each counted once

  bool is_empty() const { return broken.empty() && softened.empty(); }
};

}  // namespace perimorph::bonds
