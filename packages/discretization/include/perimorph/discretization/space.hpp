#pragma once

#include <Tpetra_Vector_fwd.hpp>
#include <vector>

#include "perimorph/base/field.hpp"
#include "perimorph/discretization/boundary_conditions.hpp"

namespace perimorph::discretization {

/// What turns the unknowns of a topology into displacements at all nodes of this rank, and forces on nodes back into
/// forces on unknowns. So far unknowns are the displacements of owned nodes, copied to where other ranks need them, and
/// some are prescribed. Fields on nodes are (n_nodes, dim), owned nodes first.
template <int dim>
class Space {
 public:
  using Vector = Tpetra::Vector<double>;

  /// Local. The arguments must outlive this.
  Space(const DofMap<dim>& dofs, const Dirichlet<dim>& dirichlet);

  const DofMap<dim>& dofs() const { return dofs_; }
  std::size_t n_local() const { return fixed_.size(); }  ///< degrees of freedom with copies
  std::size_t n_owned() const { return static_cast<std::size_t>(dofs_.n_owned_nodes()) * dim; }
  bool is_prescribed(int dof) const {
    PERIMORPH_DEBUG_ASSERT(dof >= 0 && dof < static_cast<int>(n_local()), "degree of freedom {} of {}", dof, n_local());
    return fixed_[dof] != 0;
  }
  const std::vector<int>& prescribed() const { return prescribed_; }  ///< local degrees of freedom, ascending

  /// Completes a displacement from its values on owned nodes: copies, and what is prescribed. Collective.
  /// @param u on all local degrees of freedom, [length]
  /// @param load_factor at which it is prescribed [-]
  void expand(base::Field u, double load_factor) const;

  /// A change of the displacement on all local degrees of freedom from one on owned ones: zero where prescribed. It
  /// stays valid until the next call. Collective.
  /// @param x on owned degrees of freedom, [length]
  base::ConstField expand_change(const Vector& x) const;

  /// How fast prescribed displacements grow with the load factor in a step up to it, on average, on all local degrees
  /// of freedom; zero where nothing is prescribed, [length]. Local.
  std::vector<double> prescribed_rates(double load_factor, double step) const;

  /// Takes forces on nodes to forces on unknowns: none where the displacement is prescribed. Local.
  /// @param forces on all local degrees of freedom, or on owned ones, [force]
  void restrict_forces(base::Field forces) const;

 private:
  const DofMap<dim>& dofs_;
  const Dirichlet<dim>& dirichlet_;
  std::vector<char> fixed_;      ///< per local degree of freedom
  std::vector<int> prescribed_;  ///< those that are
  Teuchos::RCP<Vector> owned_, all_;

  Ramp<double> ramp(int dof) const { return dirichlet_.ramp(dofs_.reference_node(dof / dim), dof % dim); }
};

}  // namespace perimorph::discretization
