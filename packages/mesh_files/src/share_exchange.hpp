#pragma once

// What ranks with a share each of a file ask each other.

#include <array>
#include <cstdint>
#include <vector>

#include "perimorph/base/parallel.hpp"

namespace perimorph::mesh_files {

/// Whether all numbers of all ranks are different. Collective.
bool are_all_different(const base::Comm& comm, std::vector<std::int64_t> numbers);

/// Items of a list of which each rank has its share. Collective.
/// @param own this rank's, (Share::of(n).size())
/// @param n length of the whole list, the same on all ranks
/// @param places of what this rank needs in the whole list, from 0 to n - 1
/// @return (places.size())
std::vector<std::int64_t> items_at(const base::Comm& comm, const std::vector<std::int64_t>& own, std::int64_t n,
                                   const std::vector<std::int64_t>& places);

/// Two nodes, the lower number first.
using Edge = std::array<std::int64_t, 2>;

/// The edges that belong to one element only, of elements that the ranks share.
class BoundaryEdges {
 public:
  /// @param edges of this rank's elements, each once per element that has it. Collective.
  BoundaryEdges(const base::Comm& comm, const std::vector<Edge>& edges);

  /// Whether there are none on all ranks.
  bool empty() const { return is_empty_; }

  /// For each edge whether it is one of them. Collective.
  std::vector<char> have(const base::Comm& comm, const std::vector<Edge>& edges) const;

 private:
  std::vector<Edge> edges_;  // ascending; those that this rank answers for
  bool is_empty_ = true;
};

}  // namespace perimorph::mesh_files
