#pragma once

#include "perimorph/base/field.hpp"
#include "perimorph/discretization/dof_map.hpp"

namespace perimorph::discretization {

/// Where elements of different sizes meet: the displacement of a hanging node is the mean of its parents', which get
/// the forces on it in turn. None of them is at a discontinuous element. Fields on nodes are (n_nodes, dim). All local.
template <int dim>
class HangingNodes {
 public:
  struct Tie {
    int node;
    std::vector<int> parents;
  };

  /// @param dofs of a topology without discontinuous elements at hanging nodes
  explicit HangingNodes(const DofMap<dim>& dofs);

  const std::vector<Tie>& ties() const { return ties_; }  ///< by ascending node
  std::vector<int> dofs() const;                          ///< of the hanging nodes, ascending
  /// The parents of a local node; empty if it does not hang.
  const std::vector<int>& parents_of(int node) const;

  /// Makes displacements, or their changes, at hanging nodes what they are by those of their parents.
  void complete(base::Field values) const;
  /// Takes the forces on hanging nodes to their parents.
  void gather(base::Field forces) const;

 private:
  std::vector<Tie> ties_;
  std::vector<int> tie_of_;  ///< per node, -1 without; empty without ties
  std::vector<int> none_;
};

}  // namespace perimorph::discretization
