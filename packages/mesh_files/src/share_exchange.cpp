#include "share_exchange.hpp"

#include <algorithm>

#include "homes.hpp"
#include "perimorph/base/directory.hpp"

namespace perimorph::mesh_files {

namespace {

template <class T>
std::vector<T> joined(const std::vector<std::vector<T>>& parts) {
  std::vector<T> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

template <class T>
bool has_equal_neighbours(const std::vector<T>& ascending) {
  return std::adjacent_find(ascending.begin(), ascending.end()) != ascending.end();
}

using mesh_files::home_of;

int home_of(const Edge& edge, int n_ranks) {
  const std::uint64_t first = mixed(static_cast<std::uint64_t>(edge[0]));
  return home_of(static_cast<std::int64_t>(first + static_cast<std::uint64_t>(edge[1])), n_ranks);
}

/// Sends each item to the rank that answers for it.
template <class T>
base::Inquiry<T> sent_home(const base::Comm& comm, const std::vector<T>& items) {
  std::vector<int> homes;
  homes.reserve(items.size());
  for (const T& item : items) homes.push_back(home_of(item, comm.getSize()));
  return {comm, std::move(homes), items};
}

}  // namespace

/// Only where no rank finds two alike by itself are they sent: a number that occurs often would all go to one rank.
bool are_all_different(const base::Comm& comm, std::vector<std::int64_t> numbers) {
  const auto have_two_alike_anywhere = [&comm](std::vector<std::int64_t>& items) {
    std::sort(items.begin(), items.end());
    return base::max(comm, base::GlobalId{has_equal_neighbours(items) ? 1 : 0}) > 0;
  };
  if (have_two_alike_anywhere(numbers)) return false;
  if (comm.getSize() == 1) return true;
  std::vector<std::int64_t> received = joined(sent_home(comm, numbers).received());
  return !have_two_alike_anywhere(received);
}

std::vector<std::int64_t> items_at(const base::Comm& comm, const std::vector<std::int64_t>& own, std::int64_t n,
                                   const std::vector<std::int64_t>& places) {
  std::vector<std::int64_t> needed = places;
  std::sort(needed.begin(), needed.end());
  needed.erase(std::unique(needed.begin(), needed.end()), needed.end());
  const std::vector<base::GlobalId> numbers(needed.begin(), needed.end());
  const auto found = base::Directory(comm, n, numbers).answers(own);  // in the order of needed
  std::vector<std::int64_t> items;
  items.reserve(places.size());
  for (const std::int64_t place : places) {
    items.push_back(
        found[static_cast<std::size_t>(std::lower_bound(needed.begin(), needed.end(), place) - needed.begin())]);
  }
  return items;
}

BoundaryEdges::BoundaryEdges(const base::Comm& comm, const std::vector<Edge>& edges) {
  std::vector<Edge> received = joined(sent_home(comm, edges).received());
  std::sort(received.begin(), received.end());
  for (std::size_t i = 0, end = 0; i < received.size(); i = end) {
    for (end = i + 1; end < received.size() && received[end] == received[i];) ++end;
    if (end == i + 1) edges_.push_back(received[i]);
  }
  is_empty_ = base::max(comm, base::GlobalId{edges_.empty() ? 0 : 1}) == 0;
}

std::vector<char> BoundaryEdges::have(const base::Comm& comm, const std::vector<Edge>& edges) const {
  return sent_home(comm, edges).answers<char>([&](const Edge& edge) -> char {
    return std::binary_search(edges_.begin(), edges_.end(), edge) ? 1 : 0;
  });
}

}  // namespace perimorph::mesh_files
