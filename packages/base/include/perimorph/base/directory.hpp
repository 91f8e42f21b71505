#pragma once

#include <vector>

#include "perimorph/base/inquiry.hpp"
#include "perimorph/base/slices.hpp"

namespace perimorph::base {

/// Lets ranks that have copies of numbered items meet: items 0 ... n - 1 lie in even slices. What ranks say of an item
/// goes to the holder of its slice, whose answer goes back to all of them, so that nobody needs to know who has an
/// item.
class Directory {
 public:
  /// Collective; the communicator must outlive this.
  /// @param n how many items there are, the same on all ranks
  /// @param items of which this rank has copies, in any order
  /// @throws Bug on all ranks if an item is none of them
  Directory(const Comm& comm, GlobalId n, const std::vector<GlobalId>& items)
      : comm_(comm), slices_(Slices::even(comm, n)), items_(comm, holders_of(items), items) {}

  const Slices& slices() const { return slices_; }
  /// How many items this rank has copies of.
  std::size_t n_own() const { return items_.ranks().size(); }
  /// How many items are in this rank's slice.
  std::size_t n_here() const { return slices_.size(comm_.getRank()); }

  /// What the ranks say of the items in this rank's slice, put together. Collective.
  /// @param said one for each of this rank's items, in their order
  /// @param nothing what an item has before anything is said of it
  /// @param add add(item, said): adds what a rank, the lowest first, says of an item, to what it has
  /// @return (n_here())
  template <class T, class Add>
  std::vector<T> collect(const std::vector<T>& said, const T& nothing, Add add) const {
    const Inquiry<T> telling(comm_, items_.ranks(), said);
    std::vector<T> slice(n_here(), nothing);
    for (std::size_t rank = 0; rank < telling.received().size(); ++rank) {
      const auto& items = items_.received()[rank];
      for (std::size_t i = 0; i < items.size(); ++i) add(slice[place_of(items[i])], telling.received()[rank][i]);
    }
    return slice;
  }

  /// The same of items of which all ranks say the same, or only one has a copy. Collective.
  template <class T>
  std::vector<T> collect(const std::vector<T>& said) const {
    return collect(said, T(), [](T& item, const T& value) { item = value; });
  }

  /// What the holders know of this rank's items, in their order, (n_own()). Collective.
  /// @param slice of the items that this rank holds, (n_here())
  template <class T>
  std::vector<T> answers(const std::vector<T>& slice) const {
    PERIMORPH_ASSERT(slice.size() == n_here(), "{} values of {} items", slice.size(), n_here());
    return items_.template answers<T>([&](GlobalId item) { return slice[place_of(item)]; });
  }

 private:
  const Comm& comm_;
  Slices slices_;
  Inquiry<GlobalId> items_;  ///< of which each rank has copies, at their holders

  std::size_t place_of(GlobalId item) const { return static_cast<std::size_t>(item - slices_.begin(comm_.getRank())); }

  /// Collective.
  std::vector<int> holders_of(const std::vector<GlobalId>& items) const {
    std::vector<int> holders;
    on_all_ranks(comm_, [&] {
      for (const GlobalId item : items) holders.push_back(slices_.holder(item));
    });
    return holders;
  }
};

}  // namespace perimorph::base
