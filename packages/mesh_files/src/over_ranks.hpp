#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "perimorph/base/parallel.hpp"

// What ranks must know of what each has found.

namespace perimorph::mesh_files {

using base::GlobalId;

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
