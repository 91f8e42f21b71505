#pragma once

#include <Tpetra_CrsMatrix_fwd.hpp>
#include <Tpetra_Operator_fwd.hpp>
#include <vector>

#include "perimorph/operators/bond_selection.hpp"
#include "perimorph/operators/point_basis.hpp"

namespace perimorph::operators {

/// The bonds up to a length, stiffened so that Sum k |xi|^4, and with it the stiffness against smooth strains, is that
/// of all bonds. Their matrix has far fewer entries and is nearly as good to build a preconditioner from. Collective.
template <int dim>
BondSelection short_range(const CoupledModel<dim>& model, const base::Comm& comm, double reach);

/// The coupled stiffness K of WHL19, eq. 22, as a CRS matrix with the rows of this rank's degrees of freedom; every
/// rank computes its rows whole.
template <int dim>
class CoupledStiffness {
 public:
  using Matrix = Tpetra::CrsMatrix<double>;

  /// Collective. The model is read again by subtract() and must outlive this.
  /// @param basis of the unknowns where they are not nodal displacements; the supports' springs are not transformed
  CoupledStiffness(const CoupledModel<dim>& model, const Supports<dim>& supports,
                   const BondSelection& selection = all_bonds,
                   Teuchos::RCP<const PointBasis<dim>> basis = Teuchos::null);

  const Teuchos::RCP<Matrix>& matrix() const { return matrix_; }
  Teuchos::RCP<Tpetra::Operator<double>> linear_operator() const;
  std::size_t bytes() const;  ///< of memory: the matrix's values, columns and row starts

  /// Takes the springs of newly broken bonds out of the values, in place. Returns the owned nodes whose rows may have
  /// changed, some more than once. Local.
  std::vector<int> subtract(const std::vector<std::size_t>& broken);

 private:
  CoupledModel<dim> model_;
  BondSelection selection_;
  Teuchos::RCP<const PointBasis<dim>> basis_;  ///< null: nodal displacements everywhere
  std::vector<char> has_selected_bonds_;       ///< per pair of elements
  std::vector<double> free_;                   ///< per local degree of freedom: 0 if prescribed, 1 otherwise
  std::vector<std::size_t> first_;     ///< node-block rows: position of the first block of each owned node's row
  std::vector<int> columns_;           ///< nodes, ascending in a row
  std::vector<std::size_t> diagonal_;  ///< position of each row's diagonal block
  Teuchos::RCP<Matrix> matrix_;
  double* values_ = nullptr;  ///< of the matrix

  using Block = Eigen::Matrix<double, dim, dim>;
  bool is_by_points(int element) const { return !basis_.is_null() && basis_->holds(element); }
  /// Displacement of an element's q-th point where its k-th unknown is 1.
  double shape(int element, int q, int k) const {
    return is_by_points(element) ? static_cast<double>(q == k) : model_.points.shape(element, q)[k];
  }
  std::vector<std::vector<int>> nodes_bonded_by_points() const;
  void find_pattern();
  void make_matrix();
  void add_block(int row, int column, const Block& block);
  void add_element(int element);
  void add_springs();
  void add_at_points(int element, const Block* at_points);
  void add_between(const bonds::ElementPair& pair, const std::vector<Block>& between);
  base::Point<dim> bond_vector(const bonds::ElementPair& pair, std::size_t bond) const;
  bool is_selected(const bonds::ElementPair& pair, std::size_t bond) const {
    return bond_vector(pair, bond).norm() <= selection_.reach;
  }
  Block spring_block(std::size_t bond, int first_point, int second_point) const;
  void add_diagonal(const std::vector<double>& diagonal);
};

}  // namespace perimorph::operators
