#pragma once

#include <cstdint>

namespace perimorph::mesh_files {

/// All bits of a number mixed, so that numbers with any regular gaps spread evenly: the last step of the generator
/// SplitMix64.
inline std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31U);
}

/// The rank that answers for a number, whoever has it.
inline int home_of(std::int64_t number, int n_ranks) {
  return static_cast<int>(mixed(static_cast<std::uint64_t>(number)) % static_cast<std::uint64_t>(n_ranks));
}

}  // namespace perimorph::mesh_files
