#pragma once

#include <vector>

#include "perimorph/base/algebra.hpp"

namespace perimorph::mesh {

/// Parts points by Zoltan2's multijagged cuts: boxes of equal cost. The same input gives the same parts. Some parts are
/// empty if there are more parts than points. Local.
/// @param points  (n), [length]
/// @param weights one cost per point, (n), finite and not negative, or empty for equal costs
/// @param n_parts at least 1
/// @return each point's part, 0 ... n_parts - 1
template <int dim>
std::vector<int> partition(const std::vector<base::Point<dim>>& points, const std::vector<double>& weights,
                           int n_parts);

}  // namespace perimorph::mesh
