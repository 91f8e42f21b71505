#pragma once

#include <string>
#include <vector>

#include "perimorph/fracture/body.hpp"

namespace perimorph::output {

/// The force that supports exert on a group of nodes in one direction, over all ranks; on a rigid group also the moment
/// about its centre.
struct Reaction {
  std::string column;        ///< "<group>_<x|y|z>", or "<group>_rotation_<x|y|z>"
  std::string group;         ///< a node set of the mesh
  int component;             ///< as discretization::PrescribedComponent has it
  double force = 0.;         ///< in the last accepted increment, [force]; a moment, [force * length]
  double displacement = 0.;  ///< mean over the group, in the last accepted increment, [length]; a rotation, [rad]
  double peak = 0.;          ///< the largest force so far, with its sign
  int peak_increment = 0;    ///< in which that was
};

/// Those of each group in each direction, not yet measured. Local.
/// @param groups node sets of the mesh
template <int dim>
std::vector<Reaction> reactions_of(const std::vector<std::string>& groups,
                                   const std::vector<discretization::RigidGroup>& rigid_groups);

/// The largest force of all, but for moments; null if there is none. Local.
const Reaction* largest_force(const std::vector<Reaction>& reactions);

/// Measures all of them in an increment that has been accepted. Collective.
/// @param reactions the same groups on all ranks, (n); force, displacement and peak are brought up to date
template <int dim>
void measure(const base::Comm& comm, int increment, const fracture::Body<dim>& body, std::vector<Reaction>& reactions);

}  // namespace perimorph::output
