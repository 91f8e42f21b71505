#pragma once

#include <Tpetra_Vector_fwd.hpp>
#include <string>
#include <vector>

#include "perimorph/discretization/dof_map.hpp"
#include "perimorph/elements/material_points.hpp"

namespace perimorph::discretization {

/// A value that grows with the load: rate * load factor + constant.
template <class T>
struct Ramp {
  T rate, constant;
  T at(double load_factor) const { return rate * load_factor + constant; }
};

/// One displacement component, prescribed on a node set, [length].
struct PrescribedComponent {
  std::string name, node_set;
  int component;
  Ramp<double> value;
};

/// Force per area, prescribed on a side set.
template <int dim>
struct SurfaceTraction {
  std::string side_set;
  Ramp<base::Point<dim>> value;
};

/// Prescribed displacements by node of the reference mesh: every node of the topology that stands on it obeys them.
template <int dim>
class Dirichlet {
 public:
  /// @throws UserError if two conditions contradict each other on a node. Collective.
  Dirichlet(const base::Comm& comm, const mesh::Mesh<dim>& mesh, const std::vector<PrescribedComponent>& conditions);

  bool prescribes(int reference_node, int component) const { return fixed_[reference_node * dim + component]; }
  double value(int reference_node, int component, double load_factor) const {
    return values_[reference_node * dim + component].at(load_factor);
  }

 private:
  std::vector<char> fixed_;
  std::vector<Ramp<double>> values_;
};

/// Forces of tractions and body forces on the nodes of the current topology, consistent with the shape functions.
template <int dim>
class Loads {
 public:
  Loads(std::vector<SurfaceTraction<dim>> tractions, Ramp<base::Point<dim>> body_force)
      : tractions_(std::move(tractions)), body_force_(body_force) {}

  /// Force on each owned degree of freedom, (owned nodes * dim), [force]. Local.
  std::vector<double> forces(const mesh::Mesh<dim>& mesh, const elements::MaterialPoints<dim>& points,
                             const DofMap<dim>& dofs, double load_factor) const;

 private:
  std::vector<SurfaceTraction<dim>> tractions_;
  Ramp<base::Point<dim>> body_force_;
};

}  // namespace perimorph::discretization
