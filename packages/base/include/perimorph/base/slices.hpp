#pragma once

#include <algorithm>
#include <vector>

#include "perimorph/base/errors.hpp"
#include "perimorph/base/parallel.hpp"

namespace perimorph::base {

/// A list of which each rank has a slice, one after the other in the order of ranks.
class Slices {
 public:
  /// About as much on each rank. Local.
  /// @param n length of the list, the same on all ranks
  static Slices even(const Comm& comm, GlobalId n) {
    Slices slices;
    for (int rank = 0; rank <= comm.getSize(); ++rank) slices.begin_.push_back(first_of_share(comm, n, rank));
    return slices;
  }

  /// With so many items on this rank. Collective.
  static Slices of(const Comm& comm, std::size_t n_here) {
    Slices slices;
    slices.begin_ = {0};
    const auto sizes = gather_on_all(comm, std::vector<GlobalId>{static_cast<GlobalId>(n_here)});
    for (const GlobalId size : sizes) slices.begin_.push_back(slices.begin_.back() + size);
    return slices;
  }

  /// The length of the whole list.
  GlobalId n() const { return begin_.back(); }
  /// The first item of a rank's slice; of n_ranks: n().
  GlobalId begin(int rank) const { return begin_[static_cast<std::size_t>(rank)]; }
  /// How long a rank's slice is.
  std::size_t size(int rank) const { return static_cast<std::size_t>(begin(rank + 1) - begin(rank)); }

  /// The rank in whose slice an item is. @throws Bug if it is none of the list
  int holder(GlobalId item) const {
    PERIMORPH_ASSERT(item >= 0 && item < n(), "item {} of {}", item, n());
    return static_cast<int>(std::upper_bound(begin_.begin(), begin_.end(), item) - begin_.begin()) - 1;
  }

 private:
  std::vector<GlobalId> begin_;  ///< of each rank, and n()
};

}  // namespace perimorph::base
