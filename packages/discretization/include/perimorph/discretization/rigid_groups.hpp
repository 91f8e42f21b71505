#pragma once

#include <string>
#include <vector>

#include "perimorph/base/parallel.hpp"
#include "perimorph/discretization/amplitude.hpp"
#include "perimorph/mesh/mesh.hpp"

namespace perimorph::discretization {

struct PrescribedComponent;

/// A node set that moves as a rigid body, by small rotations, or shares one component of its displacement.
struct RigidGroup {
  std::string name, node_set;
  int shared_component = -1;        ///< the one that it shares; -1: it is a rigid body
  std::vector<double> center = {};  ///< about which it turns, (dim), [length]; empty: the mean of its nodes
};

/// The point about which a group turns, [length]. Collective. @throws UserError on all ranks if it has no nodes
template <int dim>
base::Point<dim> center_of(const base::Comm& comm, const mesh::Mesh<dim>& mesh, const RigidGroup& group);

/// The group that a condition moves as a whole; null if it prescribes nodes. Local.
const RigidGroup* moved_by(const PrescribedComponent& condition, const std::vector<RigidGroup>& groups);

/// The displacement at the end of an arm, [length], for a motion of 1: along each axis, then about the z axis in two
/// dimensions, about all three in three. Local.
template <int dim>
base::Point<dim> rigid_displacement(int motion, const base::Point<dim>& arm);

/// How a rigid group moves, as rigid_displacement() counts motions; one that shares a component only along that one.
template <int dim>
struct GroupMotion {
  static constexpr int n_motions = dim == 2 ? 3 : 6;

  struct Prescribed {
    int motion;          ///< from 0
    Ramp<double> value;  ///< [length], or [rad]
  };

  int shared_component;                ///< -1: none
  std::vector<int> nodes;              ///< those on this rank, of the reference mesh, ascending
  std::vector<base::Point<dim>> arms;  ///< from the center to them, [length]
  std::vector<Prescribed> prescribed = {};
};

/// A node of a group that something else moves as well.
struct GroupConflict {
  std::string group, other;  ///< the other group or condition, with its kind: displacement "hold"
  int node;                  ///< local, of the reference mesh
};

/// One for each two that have nodes in common. Node sets that the mesh does not have are left out. Local.
template <int dim>
std::vector<GroupConflict> group_conflicts(const mesh::Mesh<dim>& mesh, const std::vector<RigidGroup>& groups,
                                           const std::vector<PrescribedComponent>& conditions);

/// Collective.
/// @param conditions of which those that move a group are taken
/// @throws UserError if there are conflicts
template <int dim>
std::vector<GroupMotion<dim>> group_motions(const base::Comm& comm, const mesh::Mesh<dim>& mesh,
                                            const std::vector<RigidGroup>& groups,
                                            const std::vector<PrescribedComponent>& conditions);

}  // namespace perimorph::discretization
