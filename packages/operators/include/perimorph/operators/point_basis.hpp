#pragma once

#include <Tpetra_MultiVector_fwd.hpp>
#include <Tpetra_Operator.hpp>
#include <map>
#include <memory>
#include <vector>

#include "perimorph/discretization/space.hpp"
#include "perimorph/operators/coupled_model.hpp"

namespace perimorph::operators {

/// Displacements at the quadrature points of discontinuous elements as unknowns, in the place of those at their nodes.
/// A point is coupled to the points that it has bonds with and not to all nodes of their elements: the matrix is the
/// same operator with a third of the entries. As an operator this is u = T v from the unknowns v to those of the nodes;
/// transposed, it takes forces on nodes to forces on unknowns.
///
/// It holds for elements without stiffness of their own and supports, with as many points as nodes, all of which are
/// one rank's.
template <int dim>
class PointBasis : public Tpetra::Operator<double> {
 public:
  using MultiVector = Tpetra::MultiVector<double>;
  using Map = Tpetra::Map<>;

  /// Collective. It keeps what it needs of the arguments.
  /// @param discontinuous per local element, right in the halo too
  PointBasis(const CoupledModel<dim>& model, const discretization::Space<dim>& space,
             const std::vector<char>& discontinuous);

  /// Whether the q-th "node" of a local element is its q-th point. The same on every rank that has the element.
  bool holds(int element) const {
    PERIMORPH_DEBUG_ASSERT(element >= 0 && element < static_cast<int>(holds_.size()), "element {} of {}", element,
                           holds_.size());
    return holds_[element];
  }

  /// Moves nodes whose unknowns are a point's to that point. Local.
  /// @param coordinates of the owned nodes, [length]
  void move_to_points(std::vector<base::Point<dim>>& coordinates) const;

  /// On some of the nodes, none or all of each element's. Local.
  /// @param nodes owned, ascending
  /// @param unknowns theirs, in their order
  PointBasis within(const std::vector<int>& nodes, const Teuchos::RCP<const Map>& unknowns) const;

  Teuchos::RCP<const Map> getDomainMap() const override { return unknowns_; }
  Teuchos::RCP<const Map> getRangeMap() const override { return unknowns_; }
  bool hasTransposeApply() const override { return true; }

  /// y = beta y + alpha T x. Local.
  void apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp mode = Teuchos::NO_TRANS, double alpha = 1.,
             double beta = 0.) const override;

 private:
  using CornerMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, mesh::max_corners, mesh::max_corners>;

  Teuchos::RCP<const Map> unknowns_;
  std::vector<char> holds_;
  struct Element {
    std::size_t first;  ///< in nodes_
    int n_nodes;
    std::shared_ptr<const CornerMatrix> added;  ///< T - 1 for one component
  };
  std::vector<Element> elements_;         ///< those whose nodes are owned
  std::vector<int> nodes_;                ///< theirs
  std::vector<base::Point<dim>> points_;  ///< positions of the points that stand for these nodes, [length]
  std::map<const elements::ReferenceElement<dim>*, std::shared_ptr<const CornerMatrix>> tables_;

  std::shared_ptr<const CornerMatrix> table_of(const elements::ReferenceElement<dim>& reference);
};

/// The unknowns of a topology from those of the one before, by owned node: those that nodes have parted from, and for
/// those that have become a point's the shape functions there. A node and the one that it has parted from have the same
/// owner. Local.
/// @param basis, old_basis null: nodal displacements
template <int dim>
base::NodeWeights weights_of_old_unknowns(const CoupledModel<dim>& model, const PointBasis<dim>* basis,
                                          const discretization::DofMap<dim>& old_dofs,
                                          const PointBasis<dim>* old_basis);

}  // namespace perimorph::operators
