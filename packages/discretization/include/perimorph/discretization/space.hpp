#pragma once

#include <Tpetra_MultiVector_fwd.hpp>
#include <Tpetra_Vector_fwd.hpp>
#include <vector>

#include "perimorph/base/field.hpp"
#include "perimorph/discretization/boundary_conditions.hpp"
#include "perimorph/discretization/group_ties.hpp"
#include "perimorph/discretization/hanging_nodes.hpp"
#include "perimorph/discretization/node_frames.hpp"

namespace perimorph::discretization {

/// What turns the unknowns of a topology into displacements at all nodes of this rank, and forces on nodes back into
/// forces on unknowns. Every degree of freedom is an unknown, by and large the displacement of an owned node along an
/// axis, but for those that are constrained: prescribed, across a plane of symmetry, of a hanging node, or one of a
/// group's that moves as one. Fields on nodes are (n_nodes, dim), owned nodes first, mirror images last. What is
/// collective says so; what else there is of groups and frames is local.
template <int dim>
class Space {
 public:
  using Vector = Tpetra::Vector<double>;

  /// Collective. Degrees of freedom and what is prescribed must outlive this.
  /// @param starts displacements from which what is prescribed along axes counts, on all local degrees of freedom, or
  ///        none for zeros, [length]
  Space(const DofMap<dim>& dofs, const Dirichlet<dim>& dirichlet, std::vector<double> starts = {});

  const DofMap<dim>& dofs() const { return dofs_; }
  std::size_t n_local() const { return is_constrained_.size(); }  ///< degrees of freedom with copies
  std::size_t n_owned() const { return static_cast<std::size_t>(dofs_.n_owned_nodes()) * dim; }
  bool is_constrained(int dof) const {
    PERIMORPH_DEBUG_ASSERT(dof >= 0 && dof < static_cast<int>(n_local()), "degree of freedom {} of {}", dof, n_local());
    return is_constrained_[dof] != 0;
  }
  const std::vector<int>& constrained() const {
    return constrained_;
  }  ///< local degrees of freedom, ascending, images without
  /// Of these, those that are none of a group's: they follow from what is prescribed and from other nodes.
  const std::vector<int>& prescribed() const { return prescribed_; }

  /// Completes a displacement from its values on owned nodes: copies, and what is constrained. Collective.
  /// @param u on all local degrees of freedom, [length]
  /// @param load_factor at which it is prescribed [-]
  void expand(base::Field u, double load_factor) const;

  /// A change of the displacement on all local degrees of freedom from one of the unknowns: zero where it is
  /// prescribed. It stays valid until the next call. Collective.
  /// @param x on owned degrees of freedom, [length]
  base::ConstField expand_change(const Vector& x) const;

  /// The same from values of unknowns that have been copied to all nodes already, images not, in place. Collective
  /// where there are groups.
  void complete_change(base::Field change) const;

  /// How fast prescribed displacements grow with the load factor in a step up to it, on average, on all local degrees
  /// of freedom; zero where nothing is prescribed, [length]. Local.
  std::vector<double> prescribed_rates(double load_factor, double step) const;

  /// Takes forces on nodes to forces on unknowns: none where the displacement is prescribed, those on hanging nodes to
  /// their parents, and of a group's those that move it. Collective where there are groups.
  /// @param forces on all local degrees of freedom, or on owned ones without hanging nodes' (HangingNodes::gather),
  ///        [force]
  void restrict_forces(base::Field forces) const;

  /// Whether what is prescribed at a node decides about a component of its displacement, at least in part.
  bool is_held(int node, int component) const;

  /// From components along x, y, z to unknowns, on owned degrees of freedom, in place, but for groups.
  void turn(Tpetra::MultiVector<double>& vectors) const;

  const NodeFrames<dim>& frames() const { return frames_; }
  const GroupTies<dim>& groups() const { return groups_; }
  const HangingNodes<dim>& hanging_nodes() const { return hanging_; }

 private:
  const DofMap<dim>& dofs_;
  const Dirichlet<dim>& dirichlet_;
  std::vector<double> starts_;
  NodeFrames<dim> frames_;
  GroupTies<dim> groups_;
  HangingNodes<dim> hanging_;
  std::vector<int> along_axes_;  ///< of those that are prescribed, along x, y or z; zero across planes of symmetry
  std::vector<int> prescribed_, constrained_;
  std::vector<char> is_constrained_;  ///< per local degree of freedom
  Teuchos::RCP<Vector> owned_, all_;
  mutable std::vector<double> with_images_;  ///< (n_local); empty without images

  void add_hanging(const std::vector<int>& tied);
  Ramp<double> ramp(int dof) const { return dirichlet_.ramp(dofs_.reference_node(dof / dim), dof % dim); }
};

}  // namespace perimorph::discretization
