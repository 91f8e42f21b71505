#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "perimorph/base/parallel.hpp"

// What ranks must know of each other's shares of a list, or of what each has found in its own.

namespace perimorph::mesh_files {

using base::GlobalId;

/// A list whose items are on all ranks, those of rank 0 first: which item is the first of each rank, and, as the last
/// number, how many there are, (n_ranks + 1). Collective.
/// @param n items of this rank
inline std::vector<GlobalId> first_items(const base::Comm& comm, std::size_t n) {
  std::vector<GlobalId> first = {0};
  for (const GlobalId count : base::gather_on_all(comm, std::vector<GlobalId>{static_cast<GlobalId>(n)})) {
    first.push_back(first.back() + count);
  }
  return first;
}

/// The least of what the ranks have found, by some order, of the lowest rank if several are alike; nothing if no rank
/// has found anything. Collective.
template <class T, class Less>
std::optional<T> least(const base::Comm& comm, const std::optional<T>& found, Less less) {
  const auto all = base::gather_on_all(comm, found ? std::vector<T>{*found} : std::vector<T>());
  const auto first = std::min_element(all.begin(), all.end(), less);
  return first == all.end() ? std::nullopt : std::optional<T>(*first);
}

/// What the lowest rank has found that has found anything. Collective.
template <class T>
std::optional<T> first(const base::Comm& comm, const std::optional<T>& found) {
  return least(comm, found, [](const T&, const T&) { return false; });
}

inline std::size_t sum(const base::Comm& comm, std::size_t n) {
  return static_cast<std::size_t>(base::sum(comm, static_cast<GlobalId>(n)));
}

}  // namespace perimorph::mesh_files
