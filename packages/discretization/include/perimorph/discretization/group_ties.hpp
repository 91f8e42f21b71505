#pragma once

#include <Eigen/Core>
#include <vector>

#include "perimorph/base/field.hpp"
#include "perimorph/discretization/dof_map.hpp"
#include "perimorph/discretization/rigid_groups.hpp"

namespace perimorph::discretization {

/// The degrees of freedom of groups that move as one, in a topology: their displacement is a combination of rigid
/// motions, of which some are prescribed. Fields on nodes are (n_nodes, dim), owned nodes first. What is collective
/// costs one sum over all ranks, and nothing where there are no groups.
template <int dim>
class GroupTies {
 public:
  /// Collective. @param load_factor at which motions are prescribed, or not any more [-]
  GroupTies(const DofMap<dim>& dofs, const std::vector<GroupMotion<dim>>& groups, double load_factor);

  bool is_empty() const { return ties_.empty(); }
  std::vector<int> dofs() const;        ///< local degrees of freedom, ascending
  std::vector<int> owned_dofs() const;  ///< those of them that this rank owns
  /// The local nodes of each group, (n_groups), some more than once.
  std::vector<std::vector<int>> nodes() const;
  /// The motions that are free, orthonormal over all ranks, on owned degrees of freedom: (n_owned) each, [-]. Local.
  std::vector<std::vector<double>> free_motions() const;
  /// Whether what is prescribed at a node decides about a component, at least in part.
  bool decides(int node, int component) const;

  /// Brings a displacement to the nearest that the groups can have, with what is prescribed, [length]. Collective.
  void prescribe(base::Field u, double load_factor) const;
  /// Adds how fast what is prescribed grows with the load factor in a step up to it, on average, [length]. Local.
  void add_rates(base::Field rates, double load_factor, double step) const;
  /// Leaves of a change of the displacement, or of forces, what belongs to the free motions, in place. Collective.
  /// @param values on all local degrees of freedom, or on owned ones
  void project(base::Field values) const;

 private:
  struct Tie {
    std::vector<int> dofs;             ///< local, ascending
    Eigen::MatrixXd free, prescribed;  ///< motions, (dofs, n); the free ones are orthonormal over all ranks
    std::vector<Ramp<double>> values;  ///< of the prescribed ones
  };
  Teuchos::RCP<const base::Comm> comm_;
  int n_owned_;
  std::vector<Tie> ties_;

  Tie make(const DofMap<dim>& dofs, const GroupMotion<dim>& group, double load_factor) const;
  template <class Of>
  void add_prescribed(base::Field field, Of of) const;
};

}  // namespace perimorph::discretization
