#pragma once

#include <vector>

#include "perimorph/fracture/body.hpp"

namespace perimorph::output {

/// What each element of the whole mesh will cost, before there are bonds: by how many it is likely to have, in
/// classical elements [-]. The mesh is whole on rank 0, elsewhere the result is empty. Local.
template <int dim>
std::vector<double> expected_costs(const mesh::Mesh<dim>& whole, const model::Problem<dim>& problem,
                                   discretization::DiscontinuousElements discontinuous);

/// What each element costs in an iteration, in classical elements, by its global id; on rank 0, empty elsewhere.
/// Collective.
template <int dim>
std::vector<double> partition_costs(const base::Comm& comm, const fracture::Body<dim>& body);

/// How the ranks share the work, in the same unit.
struct WorkShare {
  double total;
  double imbalance;  ///< the largest of a rank over the mean of ranks [-]
};
/// Collective.
template <int dim>
WorkShare measure_work(const base::Comm& comm, const fracture::Body<dim>& body);

}  // namespace perimorph::output
