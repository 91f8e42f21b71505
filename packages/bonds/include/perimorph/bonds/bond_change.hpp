#pragma once

#include <vector>

#include "perimorph/bonds/bond.hpp"

namespace perimorph::bonds {

/// Bonds that have just broken. Published once, and taken by everything that depends on bonds; every rank that holds a
/// bond receives it.
struct BondChange {
  std::vector<BondId> broken;   ///< bonds of this rank, ascending
  base::GlobalId n_broken = 0;  ///< over all ranks, each counted once
  double energy = 0.;           ///< that they held, over all ranks, [energy]
};

}  // namespace perimorph::bonds
