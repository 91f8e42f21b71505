#pragma once

#include <Teuchos_ParameterList.hpp>
#include <Tpetra_CrsMatrix_fwd.hpp>
#include <Tpetra_MultiVector_fwd.hpp>
#include <Tpetra_Operator_fwd.hpp>
#include <memory>
#include <vector>

#include "perimorph/base/algebra.hpp"

namespace perimorph::solvers {

using Matrix = Tpetra::CrsMatrix<double>;
using MultiVector = Tpetra::MultiVector<double>;
using Operator = Tpetra::Operator<double>;
class SinglePrecisionCycle;
struct CycleLevel;

/// Rigid-body modes of the owned degrees of freedom: dim translations and the rotations (3 modes in 2D, 6 in 3D), and
/// the nodes' coordinates, as MueLu wants them.
struct NearNullSpace {
  Teuchos::RCP<MultiVector> modes, coordinates;
};
/// Those of a matrix whose unknowns are displacements of nodes, or of what stands for nodes. Local.
/// @param coordinates of the owned nodes, (n_owned_nodes), [length]
template <int dim>
NearNullSpace rigid_body_modes(const Matrix& matrix, const std::vector<base::Point<dim>>& coordinates);

/// Smoothed-aggregation multigrid for elasticity: MueLu's hierarchy and our W-cycle (KLU2, on MueLu's coarsest level,
/// is wrong on more than one rank). Made for one matrix pattern.
class Multigrid {
 public:
  /// Our cycle in single precision (fast); MueLu's with symmetric Gauss-Seidel in double precision (robust); the same
  /// without coarse levels, which are rounding errors in a body that is all floating pieces.
  enum class Cycle { fast, robust, one_level };

  /// Coarse levels of our cycle are held by as few ranks as get so many rows each.
  static constexpr int default_rows_per_rank = 500;

  /// Sets it up. Collective.
  /// @param overrides parameters of MueLu that replace or add to ours
  Multigrid(const Teuchos::RCP<Matrix>& matrix, const NearNullSpace& near_null_space,
            const Teuchos::ParameterList& overrides, Cycle cycle, int rows_per_rank = default_rows_per_rank);
  ~Multigrid();

  /// New values in the same matrix: keeps aggregates and prolongators ("RP" reuse), renews the rest. Not after
  /// move_to(). Collective.
  void refresh();

  /// Another matrix, some of whose nodes have parted: our own cycle's finest level becomes it, the coarse ones stay.
  /// Collective.
  /// @param from_old its nodes from those of the matrix before, which have the same owners
  void move_to(const Teuchos::RCP<Matrix>& matrix, const base::NodeWeights& from_old);

  /// New values in the rows of these owned nodes, for our own cycle's finest level only. Local.
  void refresh_finest(const std::vector<int>& nodes);

  const Teuchos::RCP<Operator>& apply_inverse() const { return operator_; }

 private:
  struct Hierarchy;
  std::unique_ptr<Hierarchy> hierarchy_;
  int dim_;
  bool has_own_cycle_;
  int rows_per_rank_;
  std::vector<CycleLevel> levels_;  ///< of our own cycle
  Teuchos::RCP<SinglePrecisionCycle> own_cycle_;
  Teuchos::RCP<Operator> operator_;

  void make_operator();
  void make_own_cycle();
};

}  // namespace perimorph::solvers
