#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

namespace perimorph::base {

/// The numbers from 0 to n - 1, joined into sets; the lowest of each stands for it. Local.
class DisjointSets {
 public:
  explicit DisjointSets(int n) : lower_(n) { std::iota(lower_.begin(), lower_.end(), 0); }

  int lowest(int i) {
    while (lower_[i] != i) i = lower_[i] = lower_[lower_[i]];
    return i;
  }

  void join(int i, int j) {
    const int a = lowest(i), b = lowest(j);
    lower_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<int> lower_;  ///< a number of the same set, itself for the lowest
};

}  // namespace perimorph::base
