#pragma once

#include <Teuchos_RCP.hpp>
#include <Tpetra_Operator.hpp>
#include <vector>

#include "perimorph/solvers/multigrid.hpp"

namespace perimorph::solvers {

/// A level of multigrid: its matrix, and how the next coarser one is reached (null on the coarsest).
struct CycleLevel {
  Teuchos::RCP<const Matrix> matrix, restriction, prolongation;
};

/// One W-cycle as a linear operator, symmetric and positive definite if the matrices are. Everything inside is single
/// precision: the cycle is bound by memory, and a preconditioner need not be exact.
///
/// It smooths by a forward sweep of Gauss-Seidel over blocks (nodes, aggregates) before the coarse correction and by a
/// backward one after it. Between ranks the sweeps are Jacobi's, made convergent by half the sum of the neglected
/// entries on the diagonal [Baker, Falgout, Kolev, Yang: Multigrid smoothers for ultraparallel computing, 2011,
/// l1-Gauss-Seidel].
class SinglePrecisionCycle : public Operator {
 public:
  /// Takes new values of the finest matrix in some rows of blocks; the coarse ones stay, too stiff where it has become
  /// softer. Local.
  virtual void refresh_finest(const std::vector<int>& block_rows) = 0;
};

/// @param levels from fine to coarse; blocks have dim unknowns on the finest, dim (dim + 1) / 2 on all others.
/// Collective.
template <int dim>
Teuchos::RCP<SinglePrecisionCycle> make_single_precision_cycle(const std::vector<CycleLevel>& levels);

}  // namespace perimorph::solvers
