#pragma once

#include <vector>

#include "perimorph/base/parallel.hpp"
#include "perimorph/mesh/mesh.hpp"

namespace perimorph::mesh {

/// Partitions a mesh anew among the ranks, whichever of them have it now: by Zoltan2's multijagged algorithm on element
/// centroids. A node belongs to the lowest rank that owns an element around it. Every rank gets its own elements, all
/// elements around its own nodes and around those that hang on them ("active" elements), and as halo every element of
/// which some point may lie within halo_width of an active one: |c_e - c_a| <= halo_width + R_e + R_a. The same mesh is
/// always parted in the same way among as many ranks. Collective.
/// @param part the mesh as this rank has it: a whole one (read_mesh(), open_along()) that belongs to rank 0, and
/// nothing
///        elsewhere, or what an earlier call returned. All elements are owned by one rank each, which knows their sides
///        in sets and on the boundary and their hanging nodes; that a node is in a set, one rank that has it may know
///        for all. What belongs to another rank is ignored. Images are left out.
/// @param halo_width how far beyond its active elements a rank must see, such as the horizon, [length]
/// @param weights cost of each element that is owned here, (part.n_owned_elements), in any unit; empty on all ranks for
///        equal costs
/// @return this rank's part
/// @throws Bug on all ranks if an element is owned by none or several, or a cost is negative
template <int dim>
Mesh<dim> distribute(const base::Comm& comm, const Mesh<dim>& part, double halo_width,
                     const std::vector<double>& weights = {});

/// The whole mesh on rank 0, an empty one elsewhere: for what is seldom and needs all of it, such as saying what is
/// wrong with a mesh. Collective.
/// @param part what distribute() has made, or a whole mesh on rank 0
template <int dim>
Mesh<dim> gather(const base::Comm& comm, const Mesh<dim>& part);

/// Per local element, (n_elements): owned here, or around a node owned here, or around one that hangs on such a node.
/// The rows of this rank's matrix come from these.
template <int dim>
std::vector<char> active_elements(const Mesh<dim>& mesh);

}  // namespace perimorph::mesh
