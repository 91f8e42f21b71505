#pragma once

#include <vector>

#include "perimorph/base/errors.hpp"
#include "perimorph/base/inquiry.hpp"
#include "perimorph/base/parallel.hpp"

namespace perimorph::base {

/// Lets ranks that have copies of numbered items meet: items 0 ... n - 1 lie in slices of about equal length, one for
/// each rank, in the order of ranks. What ranks say of an item goes to the holder of its slice, whose answer goes back
/// to all of them, so that nobody needs to know who has an item.
class Directory {
 public:
  /// Collective; the communicator must outlive this.
  /// @param n how many items there are, the same on all ranks
  /// @param items of which this rank has copies, each once, in any order
  /// @throws Bug on all ranks if an item is none of them
  Directory(const Comm& comm, GlobalId n, const std::vector<GlobalId>& items)
      : comm_(comm), n_(n), asked_(comm, holders_of(items), items), known_(asked_.received()) {
    for (auto& some : known_) {
      for (GlobalId& item : some) item -= begin(comm.getRank());
    }
  }

  /// The first item of a rank's slice; of n_ranks: n.
  GlobalId begin(int rank) const { return n_ * rank / comm_.getSize(); }
  /// How many items this rank has copies of.
  std::size_t n_own() const { return asked_.ranks().size(); }
  /// How many items are in this rank's slice.
  std::size_t n_here() const { return static_cast<std::size_t>(begin(comm_.getRank() + 1) - begin(comm_.getRank())); }
  /// The rank in whose slice an item is.
  int holder(GlobalId item) const { return static_cast<int>(((item + 1) * comm_.getSize() - 1) / n_); }

  /// Of which items in this rank's slice each rank has copies, by their places in the slice.
  const std::vector<std::vector<GlobalId>>& known() const { return known_; }

  /// Each rank says something of its items. Collective.
  /// @param values one for each of this rank's items, in their order
  /// @return (n_ranks), what was said of the items in known()
  template <class T>
  std::vector<std::vector<T>> tell(const std::vector<T>& values) const {
    return Inquiry<T>(comm_, asked_.ranks(), values).received();
  }

  /// The holders answer. Collective.
  /// @param answers (n_ranks), for the items in known()
  /// @return one for each of this rank's items, in their order
  template <class T>
  std::vector<T> answer(const std::vector<std::vector<T>>& answers) const {
    return asked_.send_back(answers);
  }

  /// The same, with one value for each item of this rank's slice. Collective.
  template <class T>
  std::vector<T> answer_all(const std::vector<T>& of_slice) const {
    PERIMORPH_ASSERT(of_slice.size() == n_here(), "{} values of {} items", of_slice.size(), n_here());
    std::vector<std::vector<T>> answers(known_.size());
    for (std::size_t rank = 0; rank < known_.size(); ++rank) {
      for (const GlobalId place : known_[rank]) answers[rank].push_back(of_slice[place]);
    }
    return answer(answers);
  }

 private:
  const Comm& comm_;
  GlobalId n_;
  Inquiry<GlobalId> asked_;  ///< who has copies of this rank's items
  std::vector<std::vector<GlobalId>> known_;

  /// Collective.
  std::vector<int> holders_of(const std::vector<GlobalId>& items) const {
    std::vector<int> holders;
    on_all_ranks(comm_, [&] {
      for (const GlobalId item : items) {
        PERIMORPH_ASSERT(item >= 0 && item < n_, "item {} of {}", item, n_);
        holders.push_back(holder(item));
      }
    });
    return holders;
  }
};

}  // namespace perimorph::base
