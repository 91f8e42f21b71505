#pragma once

#include <Tpetra_Vector_fwd.hpp>
#include <map>
#include <string>
#include <vector>

#include "perimorph/discretization/amplitude.hpp"
#include "perimorph/discretization/dof_map.hpp"
#include "perimorph/discretization/rigid_groups.hpp"
#include "perimorph/elements/material_points.hpp"

namespace perimorph::discretization {

/// One component of the displacement, prescribed on a node set, [length]; of a rigid group also an angle, [rad].
struct PrescribedComponent {
  static constexpr int first_rotation = 3;  ///< about x; then about y and z

  std::string name, node_set;
  int component = -1;  ///< -1: the one along a direction
  Ramp<double> value = {0., 0.};
  std::vector<double> direction = {};  ///< (dim), of length 1; empty: that of the component
};

/// "x displacement", "displacement along (0.6, 0.8)", or "rotation about x". Local.
std::string name_of_displacement(const PrescribedComponent& condition);

/// Along which it prescribes the displacement, of length 1; it must not be a rotation. Local.
template <int dim>
base::Point<dim> direction_of(const PrescribedComponent& condition);

/// A node whose displacement two conditions prescribe differently: the same component, or one that others have decided.
struct Contradiction {
  int first, second;  ///< conditions, by their place in the list; the first is the first of all that prescribe it
  int node;           ///< local, of the reference mesh
};

/// All contradictions, in the order of the second condition. Conditions on node sets that the mesh does not have, and
/// those that move rigid groups, are left out. Local.
template <int dim>
std::vector<Contradiction> contradictions(const mesh::Mesh<dim>& mesh,
                                          const std::vector<PrescribedComponent>& conditions,
                                          const std::vector<RigidGroup>& groups = {});

/// Force per area, prescribed on a side set, (dim), [stress].
template <int dim>
struct SurfaceTraction {
  std::string side_set;
  Ramp<base::Point<dim>> value;
};

/// Pressure on a side set, along its normal in the reference; against the body where it is positive, [stress].
struct SurfacePressure {
  std::string side_set;
  Ramp<double> value;
};

/// Weight of what fills the body: a force per volume of density times acceleration.
template <int dim>
struct SelfWeight {
  Ramp<base::Point<dim>> acceleration = {base::Point<dim>::Zero(), base::Point<dim>::Zero()};  ///< [length / time^2]
  std::map<std::string, double> densities = {};  ///< by block, [mass / volume]
  double other_density = 0.;                     ///< of all other blocks
};

/// Prescribed displacements by node of the reference mesh: every node of the topology that stands on it obeys them,
/// between the load factors at which they begin and end. With the groups that move as one.
template <int dim>
class Dirichlet {
 public:
  /// What is prescribed along a direction of length 1, [length].
  struct Along {
    base::Point<dim> direction;
    Ramp<double> value;
  };

  /// @throws UserError if two conditions contradict each other on a node. Collective. The mesh must outlive this.
  Dirichlet(const base::Comm& comm, const mesh::Mesh<dim>& mesh, const std::vector<PrescribedComponent>& conditions,
            const std::vector<RigidGroup>& groups = {});

  /// From now on this load factor holds; returns whether other components are prescribed than before, on any rank.
  /// Local, with the same answer on all ranks.
  bool apply_load(double load_factor);

  /// Whether the last apply_load() has made conditions begin, on any rank: what they prescribe counts from where nodes
  /// are then.
  bool has_begun() const { return has_begun_; }
  /// Whether one of them prescribes that. @param reference_node local node of the reference mesh, here and below
  bool has_begun(int reference_node, int component) const { return begun_[reference_node * dim + component] != 0; }

  /// Whether it does at the present load factor, and no oblique direction besides.
  bool prescribes(int reference_node, int component) const {
    PERIMORPH_DEBUG_ASSERT(component >= 0 && component < dim, "component {}", component);
    return fixed_[reference_node * dim + component];
  }
  /// All that is prescribed at the nodes where that is so along directions that are oblique to the axes, by node.
  const std::map<int, std::vector<Along>>& oblique() const { return oblique_; }
  const std::vector<GroupMotion<dim>>& groups() const { return groups_; }
  double load_factor() const { return load_factor_; }  ///< the present one
  /// The displacement over the load factor, [length]; zero where none is prescribed.
  const Ramp<double>& ramp(int reference_node, int component) const {
    return values_[reference_node * dim + component];
  }

 private:
  const mesh::Mesh<dim>& mesh_;
  std::vector<PrescribedComponent> on_nodes_;  ///< conditions that move no group
  std::vector<Ramp<double>> of_groups_;        ///< values of those that do
  std::vector<char> fixed_, begun_;
  std::vector<Ramp<double>> values_;
  std::map<int, std::vector<Along>> oblique_;
  std::vector<GroupMotion<dim>> groups_;
  double load_factor_ = 0.;
  bool has_begun_ = false;

  void follow_conditions();
  void prescribe(const PrescribedComponent& condition);
  void gather_oblique();
};

/// Forces of tractions, pressures and body forces on the nodes of the current topology, consistent with the shape
/// functions [WHL19, eq. 12, 19].
template <int dim>
class Loads {
 public:
  /// @param body_force per volume, the same everywhere, (dim), [force / volume]
  /// @param self_weight of what fills the body
  Loads(std::vector<SurfaceTraction<dim>> tractions, Ramp<base::Point<dim>> body_force,
        SelfWeight<dim> self_weight = {}, std::vector<SurfacePressure> pressures = {})
      : tractions_(std::move(tractions)),
        pressures_(std::move(pressures)),
        body_force_(body_force),
        self_weight_(std::move(self_weight)) {}

  /// Force on each owned degree of freedom, (n_owned_nodes * dim), [force]. Local.
  /// @param load_factor [-]
  std::vector<double> forces(const mesh::Mesh<dim>& mesh, const elements::MaterialPoints<dim>& points,
                             const DofMap<dim>& dofs, double load_factor) const;

  /// How fast they grow with the load factor, (n_owned_nodes * dim), [force]. Local.
  std::vector<double> rates(const mesh::Mesh<dim>& mesh, const elements::MaterialPoints<dim>& points,
                            const DofMap<dim>& dofs) const;

 private:
  std::vector<SurfaceTraction<dim>> tractions_;
  std::vector<SurfacePressure> pressures_;
  Ramp<base::Point<dim>> body_force_;
  SelfWeight<dim> self_weight_;

  template <class Value>
  std::vector<double> integrate(const mesh::Mesh<dim>& mesh, const elements::MaterialPoints<dim>& points,
                                const DofMap<dim>& dofs, Value value) const;
};

}  // namespace perimorph::discretization
