#include "share_exchange.hpp"

#include <algorithm>

#include "perimorph/base/errors.hpp"
#include "share.hpp"

namespace perimorph::mesh_files {

namespace {

/// One rank alone needs no MPI, which may not even run.
template <class T>
std::vector<std::vector<T>> exchange(const base::Comm& comm, std::vector<std::vector<T>> outgoing) {
  return comm.getSize() == 1 ? std::move(outgoing) : base::exchange(comm, outgoing);
}

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

/// Spreads numbers evenly, whatever their pattern: the last step of the generator SplitMix64.
std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31U);
}

std::size_t home_of(std::int64_t number, int n_ranks) {
  return mixed(static_cast<std::uint64_t>(number)) % static_cast<std::uint64_t>(n_ranks);
}

std::size_t home_of(const Edge& edge, int n_ranks) {
  const std::uint64_t both = mixed(static_cast<std::uint64_t>(edge[0])) + static_cast<std::uint64_t>(edge[1]);
  return mixed(both) % static_cast<std::uint64_t>(n_ranks);
}

/// Sends each item to the rank that answers for it.
template <class T>
std::vector<std::vector<T>> sent_home(const base::Comm& comm, const std::vector<T>& items) {
  std::vector<std::vector<T>> outgoing(comm.getSize());
  for (const T& item : items) outgoing[home_of(item, comm.getSize())].push_back(item);
  return exchange(comm, std::move(outgoing));
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
  std::vector<std::int64_t> received = joined(sent_home(comm, numbers));
  return !have_two_alike_anywhere(received);
}

std::vector<std::int64_t> items_at(const base::Comm& comm, const std::vector<std::int64_t>& own, std::int64_t n,
                                   const std::vector<std::int64_t>& places) {
  const Share share = {comm.getRank(), comm.getSize()};
  PERIMORPH_ASSERT(static_cast<std::int64_t>(own.size()) == share.of(n).size(), "{} items, not {}", own.size(),
                   share.of(n).size());
  std::vector<std::int64_t> needed = places;
  std::sort(needed.begin(), needed.end());
  needed.erase(std::unique(needed.begin(), needed.end()), needed.end());
  std::vector<std::vector<std::int64_t>> requests(comm.getSize());
  for (const std::int64_t place : needed) requests[static_cast<std::size_t>(share.owner(place, n))].push_back(place);
  auto answers = exchange(comm, std::move(requests));
  for (auto& answer : answers) {
    for (std::int64_t& item : answer) item = own[static_cast<std::size_t>(item - share.of(n).begin)];
  }
  const std::vector<std::int64_t> found = joined(exchange(comm, std::move(answers)));  // in the order of needed
  std::vector<std::int64_t> items;
  items.reserve(places.size());
  for (const std::int64_t place : places) {
    items.push_back(
        found[static_cast<std::size_t>(std::lower_bound(needed.begin(), needed.end(), place) - needed.begin())]);
  }
  return items;
}

BoundaryEdges::BoundaryEdges(const base::Comm& comm, const std::vector<Edge>& edges) {
  std::vector<Edge> received = joined(sent_home(comm, edges));
  std::sort(received.begin(), received.end());
  for (std::size_t i = 0, end = 0; i < received.size(); i = end) {
    for (end = i + 1; end < received.size() && received[end] == received[i];) ++end;
    if (end == i + 1) edges_.push_back(received[i]);
  }
  is_empty_ = base::max(comm, base::GlobalId{edges_.empty() ? 0 : 1}) == 0;
}

std::vector<char> BoundaryEdges::have(const base::Comm& comm, const std::vector<Edge>& edges) const {
  const auto incoming = sent_home(comm, edges);
  std::vector<std::vector<char>> answers;
  for (const auto& asked : incoming) {
    auto& answer = answers.emplace_back();
    for (const Edge& edge : asked) answer.push_back(std::binary_search(edges_.begin(), edges_.end(), edge) ? 1 : 0);
  }
  const auto answered = exchange(comm, std::move(answers));
  std::vector<std::size_t> n_used(answered.size(), 0);
  std::vector<char> found;
  for (const Edge& edge : edges) {
    const std::size_t home = home_of(edge, comm.getSize());
    found.push_back(answered[home][n_used[home]++]);
  }
  return found;
}

}  // namespace perimorph::mesh_files
