#pragma once

#include <algorithm>
#include <vector>

#include "perimorph/base/errors.hpp"
#include "perimorph/base/parallel.hpp"

namespace perimorph::discretization {

/// Brings values of items from the ranks that own them to the ranks that hold copies. The plan is made once.
class HaloExchange {
 public:
  /// Collective.
  /// @param keys global id of each local item, (n_items)
  /// @param owners rank that owns it, (n_items); it holds the item itself
  /// @param twins further items, each by the one whose values it takes over here
  HaloExchange(const base::Comm& comm, const std::vector<base::GlobalId>& keys, const std::vector<int>& owners,
               std::vector<int> twins = {});

  /// Overwrites the values of items owned elsewhere. Collective.
  /// @param values of each local item, (n_items)
  template <class T>
  void update(std::vector<T>& values) const {
    PERIMORPH_ASSERT(values.size() == n_items_, "{} values for {} items", values.size(), n_items_);
    update(values, [](int item) { return item; });
  }

  /// The same where items have several values. Collective.
  /// @param first first(i) up to first(i + 1) are the places of those of item i
  template <class T, class First>
  void update(std::vector<T>& values, First first) const {
    std::vector<std::vector<T>> outgoing(sent_.size());
    for (std::size_t r = 0; r < sent_.size(); ++r) {
      for (const int item : sent_[r]) {
        for (int i = first(item); i < first(item + 1); ++i) outgoing[r].push_back(values[i]);
      }
    }
    const auto incoming = base::exchange(comm_, outgoing);
    for (std::size_t r = 0; r < received_.size(); ++r) {
      auto next = incoming[r].begin();
      for (const int item : received_[r]) {
        for (int i = first(item); i < first(item + 1); ++i) values[i] = *next++;
      }
    }
    const int n_own = static_cast<int>(n_items_ - twins_.size());
    for (std::size_t t = 0; t < twins_.size(); ++t) {
      std::copy(values.begin() + first(twins_[t]), values.begin() + first(twins_[t] + 1),
                values.begin() + first(n_own + static_cast<int>(t)));
    }
  }

 private:
  const base::Comm& comm_;
  std::size_t n_items_;
  std::vector<std::vector<int>> sent_, received_;  ///< local items by rank
  std::vector<int> twins_;
};

}  // namespace perimorph::discretization
