#pragma once

#include <Tpetra_Vector_fwd.hpp>
#include <map>
#include <string>
#include <vector>

#include "perimorph/discretization/amplitude.hpp"
#include "perimorph/discretization/dof_map.hpp"
#include "perimorph/elements/material_points.hpp"

namespace perimorph::discretization {

/// One displacement component, prescribed on a node set, [length].
struct PrescribedComponent {
  std::string name, node_set;
  int component;
  Ramp<double> value;
};

/// A node of which two conditions prescribe one component differently.
struct Contradiction {
  int first, second;  ///< conditions, by their place in the list; the first is the first of all that prescribe it
  int node;           ///< local, of the reference mesh
};

/// All contradictions, in the order of the second condition. Conditions on node sets that the mesh does not have are
/// left out. Local.
template <int dim>
std::vector<Contradiction> contradictions(const mesh::Mesh<dim>& mesh,
                                          const std::vector<PrescribedComponent>& conditions);

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

/// Prescribed displacements by node of the reference mesh: every node of the topology that stands on it obeys them, up
/// to the load factor at which they end.
template <int dim>
class Dirichlet {
 public:
  /// @throws UserError if two conditions contradict each other on a node. Collective.
  Dirichlet(const base::Comm& comm, const mesh::Mesh<dim>& mesh, const std::vector<PrescribedComponent>& conditions);

  /// From now on this load factor holds; returns whether other components are prescribed than before, on any rank.
  /// Local, with the same answer on all ranks.
  bool apply_load(double load_factor);

  /// Whether it does at the present load factor.
  /// @param reference_node local node of the reference mesh, here and below
  bool prescribes(int reference_node, int component) const {
    PERIMORPH_DEBUG_ASSERT(component >= 0 && component < dim, "component {}", component);
    return fixed_[reference_node * dim + component] && load_factor_ <= ramp(reference_node, component).end;
  }
  /// The displacement over the load factor, [length]; zero where none is prescribed.
  const Ramp<double>& ramp(int reference_node, int component) const {
    return values_[reference_node * dim + component];
  }

 private:
  std::vector<char> fixed_;
  std::vector<Ramp<double>> values_;
  std::vector<double> ends_;  ///< of the conditions that end, load factors
  double load_factor_ = 0.;
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
