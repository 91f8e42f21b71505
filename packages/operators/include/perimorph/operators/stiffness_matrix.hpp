#pragma once

#include <Tpetra_CrsMatrix_fwd.hpp>
#include <Tpetra_Operator_fwd.hpp>
#include <utility>
#include <vector>

#include "perimorph/operators/bond_selection.hpp"
#include "perimorph/operators/force_term.hpp"
#include "perimorph/operators/point_basis.hpp"

namespace perimorph::operators {

/// The bonds up to a length, stiffened so that Sum k |xi|^4, and with it the stiffness against smooth strains, is that
/// of all bonds. Their matrix has far fewer entries and is nearly as good to build a preconditioner from (DECISIONS.md,
/// 10). Collective.
/// @param reach the length, > 0, [length]
template <int dim>
BondSelection short_range(const CoupledModel<dim>& model, const base::Comm& comm, double reach);

/// Which unknowns are coupled beside those of one element: all of two elements, or single nodes.
template <int dim>
struct Couplings {
  using Nodes = std::pair<const int*, const int*>;  ///< from the first up to the second

  std::vector<std::vector<int>> elements;  ///< per element: others
  std::vector<std::vector<int>> nodes;     ///< per owned node: others

  /// @param first,second local elements
  void add_elements(int first, int second);
  void add_nodes(const Nodes& first, const Nodes& second);
};

/// The tangent of terms, the coupled stiffness K of WHL19, eq. 22, as a CRS matrix with the rows of this rank's degrees
/// of freedom; every rank computes its rows whole.
template <int dim>
class StiffnessMatrix {
 public:
  using Matrix = Tpetra::CrsMatrix<double>;
  using Block = Eigen::Matrix<double, dim, dim>;

  /// Collective. Model, space and terms are read again later; the first two must outlive this.
  /// @param constraints stiffness on the diagonal of degrees of freedom that are constrained, and coupled to no other,
  ///        per owned one, [force / length]; 0 elsewhere
  /// @param basis of the unknowns where they are not nodal displacements; what is on the diagonal is not transformed
  StiffnessMatrix(const CoupledModel<dim>& model, const discretization::Space<dim>& space, ForceTerms<dim> terms,
                  const std::vector<double>& constraints, const BondSelection& selection = all_bonds,
                  Teuchos::RCP<const PointBasis<dim>> basis = Teuchos::null);

  const Teuchos::RCP<Matrix>& matrix() const { return matrix_; }
  Teuchos::RCP<Tpetra::Operator<double>> linear_operator() const;
  std::size_t bytes() const;  ///< of memory: the matrix's values, columns and row starts

  /// Takes newly broken bonds out of the values, in place. Returns the owned nodes whose rows have changed, some more
  /// than once. Local.
  std::vector<int> take(const bonds::BondChange& change);

  /// The tangent as it is prepared now, which it was before the terms' last prepare_tangent(). Returns nodes as take()
  /// does. Local.
  std::vector<int> update_tangent();

  // For terms; local.

  const BondSelection& selection() const { return selection_; }
  /// @param xi of a bond, [length]
  bool selects(const base::Point<dim>& xi) const { return xi.norm() <= selection_.reach; }
  bool is_by_points(int element) const { return !basis_.is_null() && basis_->holds(element); }
  /// The nodes whose unknowns move an element's q-th point.
  typename Couplings<dim>::Nodes nodes_at(int element, int q) const;
  void append_owned_nodes(int element, std::vector<int>& nodes) const;

  /// Adds an element's matrix, (n_corners * dim, n_corners * dim), [force / length].
  void add_element(int element, const Eigen::Ref<const Eigen::MatrixXd>& k);
  /// Adds the springs at an element's points, (n_points) blocks, [force / length]: K += N^T diag(at_points) N.
  void add_at_points(int element, const Block* at_points);
  /// Subtracts the springs between the points of two elements: K -= N_a^T between N_b, and its transpose.
  /// @param between (n_points of the first, n_points of the second) blocks, row by row, [force / length]
  void add_between(const bonds::ElementPair& pair, const std::vector<Block>& between);
  /// @param stiffness [force / length]
  void add_diagonal(int owned_dof, double stiffness);

 private:
  CoupledModel<dim> model_;
  const discretization::Space<dim>& space_;
  ForceTerms<dim> terms_;
  BondSelection selection_;
  Teuchos::RCP<const PointBasis<dim>> basis_;  ///< null: nodal displacements everywhere
  std::vector<double> free_;                   ///< per local degree of freedom: 0 if constrained, 1 otherwise
  std::vector<std::size_t> first_;     ///< node-block rows: position of the first block of each owned node's row
  std::vector<int> columns_;           ///< nodes, ascending in a row
  std::vector<std::size_t> diagonal_;  ///< position of each row's diagonal block
  Teuchos::RCP<Matrix> matrix_;
  double* values_ = nullptr;  ///< of the matrix

  /// Displacement of an element's q-th point where its k-th unknown is 1.
  double shape(int element, int q, int k) const {
    return is_by_points(element) ? static_cast<double>(q == k) : model_.points.shape(element, q)[k];
  }
  void find_pattern(const Couplings<dim>& couplings);
  void make_matrix();
  /// Calls visit(node, weight) for the nodes that a node's displacement follows: itself, or its parents if it hangs.
  template <class Visit>
  void visit_unknowns_of(int node, Visit visit) const;
  void add_between_nodes(int row, int column, const Block& block);
  void add_block(int row, int column, const Block& of_nodes);
};

}  // namespace perimorph::operators
