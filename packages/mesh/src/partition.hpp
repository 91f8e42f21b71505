#pragma once

#include <vector>

#include "perimorph/base/algebra.hpp"
#include "perimorph/base/parallel.hpp"

namespace perimorph::mesh {

/// Parts points by Zoltan2's multijagged cuts: boxes of equal cost, one for each rank. Whichever rank has which points,
/// the same ones get the same parts from the same number of ranks. Some parts are empty if there are more ranks than
/// points. Collective.
/// @param ids     of this rank's points, (n), over all ranks each of 0 ... n_global - 1 once
/// @param points  (n), [length]
/// @param weights one cost per point, (n), finite and not negative
/// @return each point's part, (n), 0 ... n_ranks - 1
template <int dim>
std::vector<int> partition(const base::Comm& comm, const std::vector<base::GlobalId>& ids,
                           const std::vector<base::Point<dim>>& points, const std::vector<double>& weights);

}  // namespace perimorph::mesh
