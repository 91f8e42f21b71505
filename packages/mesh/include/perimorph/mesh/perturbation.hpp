#pragma once

#include <cstdint>
#include <vector>

#include "perimorph/mesh/mesh.hpp"

namespace perimorph::mesh {

/// Names of nodes from which random numbers follow: by their numbers alone.
std::vector<std::uint64_t> node_keys(int n_nodes);

/// Moves inner nodes of a whole mesh at random, so that cracks find no rows of elements to follow: along each axis by
/// up to a share of the node's shortest edge. Nodes of groups, boundaries, pre-cracks and hanging nodes stay, and where
/// elements of several blocks meet; and so do all nodes of an element that would become too flat
/// (smallest_corner_volume below half of what it was). Local.
/// @param share 0 ... 0.5 [-]
/// @param keys of the nodes, (n_nodes), by which each of them is moved
/// @param are_meant elements, (n_elements): a node moves if all around it are
template <int dim>
void perturb(Mesh<dim>& whole, double share, const std::vector<std::uint64_t>& keys,
             const std::vector<char>& are_meant);

}  // namespace perimorph::mesh
