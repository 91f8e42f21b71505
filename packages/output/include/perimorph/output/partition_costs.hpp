#pragma once

#include <vector>

#include "perimorph/fracture/body.hpp"

// What elements cost is known by their global ids, whichever rank has them: each rank has the costs of a slice of the
// whole mesh (base::Directory), in classical elements [-].

namespace perimorph::output {

/// Costs in slices, from those of each rank's elements. Collective.
/// @param costs of the elements that the part owns; what is not this rank's, it knows nothing of
template <int dim>
std::vector<double> in_slices(const base::Comm& comm, const mesh::Mesh<dim>& part, const std::vector<double>& costs);

/// The costs of the elements that the part owns, from those in slices. Collective.
template <int dim>
std::vector<double> costs_of(const base::Comm& comm, const mesh::Mesh<dim>& part, const std::vector<double>& slice);

/// What each element will cost, before there are bonds: by how many it is likely to have; in slices. Collective.
/// @param part a whole mesh on rank 0, or what each rank has of it
template <int dim>
std::vector<double> expected_costs(const base::Comm& comm, const mesh::Mesh<dim>& part,
                                   const model::Problem<dim>& problem,
                                   discretization::DiscontinuousElements discontinuous);

/// What each element costs in an iteration; in slices. Collective.
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
