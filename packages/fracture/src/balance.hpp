#pragma once

#include <vector>

#include "perimorph/fracture/body.hpp"

namespace perimorph::fracture {

/// What each element of the whole mesh will cost, before there are bonds: by how many it is likely to have. The mesh is
/// whole on rank 0, elsewhere the result is empty. Local.
template <int dim>
std::vector<double> expected_costs(const mesh::Mesh<dim>& whole, const Problem<dim>& problem,
                                   discretization::DiscontinuousElements discontinuous);

/// What each element costs in an iteration, in classical elements, by its global id; on rank 0, empty elsewhere.
/// Collective.
template <int dim>
std::vector<double> element_costs(const base::Comm& comm, const Body<dim>& body);

/// What all elements cost together, and the largest cost of a rank over the mean of ranks. Collective.
struct Load {
  double total, imbalance;
};
template <int dim>
Load measure_load(const base::Comm& comm, const Body<dim>& body);

}  // namespace perimorph::fracture
