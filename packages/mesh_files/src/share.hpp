#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

namespace perimorph::mesh_files {

/// Places in a list: from the first to before the last.
struct Range {
  std::int64_t begin = 0, end = 0;

  std::int64_t size() const { return end - begin; }
  bool has(std::int64_t place) const { return place >= begin && place < end; }

  /// What both have; if nothing, an empty one at an end of this.
  Range overlap(const Range& other) const {
    const std::int64_t first = std::clamp(other.begin, begin, end);
    return {first, std::clamp(other.end, first, end)};
  }

  /// The same places, counted from another one.
  Range from(std::int64_t start) const { return {begin - start, end - start}; }
};

/// Of any list.
constexpr Range everything = {0, std::numeric_limits<std::int64_t>::max()};

/// Which part of each list in a file a rank reads: as many parts as ranks, about equal, one after the other.
struct Share {
  int rank = 0, n_ranks = 1;

  bool is_whole() const { return n_ranks == 1; }

  /// In a list of n items; n * n_ranks must fit 63 bits.
  Range of(std::int64_t n) const { return {n * rank / n_ranks, n * (rank + 1) / n_ranks}; }
};

}  // namespace perimorph::mesh_files
