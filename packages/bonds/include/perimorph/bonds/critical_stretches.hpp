#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "perimorph/base/errors.hpp"

namespace perimorph::bonds {

/// The critical stretches of bonds by the materials at their ends, >= 0, infinite where nothing breaks, [-].
class CriticalStretches {
 public:
  /// The same for all bonds.
  CriticalStretches(double all) : by_pair_{all} {}  // NOLINT(google-explicit-constructor): mostly so

  /// @param by_pair of the bonds between any two materials, (n, n), symmetric
  /// @param of_element place of each local element's material among them, (n_elements)
  CriticalStretches(std::vector<double> by_pair, std::vector<int> of_element)
      : n_(static_cast<int>(std::lround(std::sqrt(static_cast<double>(by_pair.size()))))),
        by_pair_(std::move(by_pair)),
        of_element_(std::move(of_element)) {
    PERIMORPH_ASSERT(static_cast<std::size_t>(n_) * n_ == by_pair_.size(), "{} stretches", by_pair_.size());
  }

  /// Of bonds between two local elements, [-].
  double operator()(int first, int second) const {
    return of_element_.empty() ? by_pair_[0] : by_pair_[of_element_[first] * n_ + of_element_[second]];
  }
  double smallest() const { return *std::min_element(by_pair_.begin(), by_pair_.end()); }  ///< [-]

 private:
  int n_ = 1;
  std::vector<double> by_pair_;
  std::vector<int> of_element_;  ///< empty: all alike
};

}  // namespace perimorph::bonds
