#pragma once

#include <Tpetra_CrsMatrix_fwd.hpp>
#include <vector>

#include "perimorph/operators/coupled_model.hpp"

namespace perimorph::operators {

/// The coupled stiffness K of WHL19, eq. 22, as a CRS matrix with the rows of this rank's degrees of freedom; every rank
/// computes its rows whole. Prescribed degrees of freedom are eliminated symmetrically (row and column zero, a stiffness
/// on the diagonal). The nodes of discontinuous elements are anchored by a vanishing spring, anchor * diagonal, so that
/// the matrix stays definite when pieces come to float; since it acts on corrections only, it carries no force.
template <int dim>
class CoupledStiffness {
 public:
  using Matrix = Tpetra::CrsMatrix<double>;
  static constexpr double anchor = 1e-8;

  /// Collective. The model is read again by subtract() and must outlive this.
  CoupledStiffness(const CoupledModel<dim>& model, const discretization::Dirichlet<dim>& dirichlet,
                   const std::vector<char>& discontinuous);

  const Teuchos::RCP<Matrix>& matrix() const { return matrix_; }

  /// Takes the springs of newly broken bonds out of the values, in place. Local.
  void subtract(const std::vector<std::size_t>& broken);

 private:
  CoupledModel<dim> model_;
  std::vector<char> fixed_;           ///< per local degree of freedom: prescribed
  std::vector<std::size_t> first_;    ///< node-block rows: position of the first block of each owned node's row
  std::vector<int> columns_;          ///< nodes, ascending in a row
  std::vector<std::size_t> diagonal_;  ///< position of each row's diagonal block
  Teuchos::RCP<Matrix> matrix_;
  double* values_ = nullptr;          ///< of the matrix

  using Block = Eigen::Matrix<double, dim, dim>;
  void find_pattern();
  void make_matrix();
  void add_block(int row, int column, const Block& block);
  void add_element(int element);
  void add_springs();
  void add_at_points(int element, const Block* at_points);
  void add_between(const bonds::ElementPair& pair, const std::vector<Block>& between);
  Block spring_block(std::size_t bond, int first_point, int second_point) const;
  void add_anchors(const std::vector<char>& discontinuous);
};

}  // namespace perimorph::operators
