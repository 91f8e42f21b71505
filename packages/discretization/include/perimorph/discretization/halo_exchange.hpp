#pragma once

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
  HaloExchange(const base::Comm& comm, const std::vector<base::GlobalId>& keys, const std::vector<int>& owners);

  /// Overwrites the values of items owned elsewhere. Collective.
  /// @param values of each local item, (n_items)
  template <class T>
  void update(std::vector<T>& values) const {
    PERIMORPH_ASSERT(values.size() == n_items_, "{} values for {} items", values.size(), n_items_);
    std::vector<std::vector<T>> outgoing(sent_.size());
    for (std::size_t r = 0; r < sent_.size(); ++r) {
      for (const int item : sent_[r]) outgoing[r].push_back(values[item]);
    }
    const auto incoming = base::exchange(comm_, outgoing);
    for (std::size_t r = 0; r < received_.size(); ++r) {
      for (std::size_t i = 0; i < received_[r].size(); ++i) values[received_[r][i]] = incoming[r][i];
    }
  }

 private:
  const base::Comm& comm_;
  std::size_t n_items_;
  std::vector<std::vector<int>> sent_, received_;  ///< local items by rank
};

}  // namespace perimorph::discretization
