#pragma once

#include <cstddef>
#include <vector>

#include "perimorph/base/algebra.hpp"

namespace perimorph::bonds {

/// Number of a bond on this rank; it keeps it when others are added.
using BondId = std::size_t;

/// A bond as BondFamilies hands it out: what it joins, and whether it is broken.
template <int dim>
struct Bond {
  BondId id;
  int first_element, second_element;  ///< local; the one with the lower global id comes first
  int first_end, second_end;          ///< the points that it joins, counted within their elements
  int first_point, second_point;      ///< the same points, as local material points
  base::Point<dim> xi;                ///< from the first point to the second in the undeformed body, [length]
  bool is_broken;

  /// Mean of numbers at points, (n_points), over both ends; of none it is 0.
  double mean_of(const std::vector<double>& at_points) const {
    return at_points.empty() ? 0. : 0.5 * (at_points[first_point] + at_points[second_point]);
  }
};

}  // namespace perimorph::bonds
