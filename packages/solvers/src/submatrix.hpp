#pragma once

#include <Tpetra_CrsMatrix_fwd.hpp>
#include <Tpetra_Map_fwd.hpp>
#include <vector>

#include "perimorph/solvers/multigrid.hpp"

namespace perimorph::solvers {

/// Some rows of a matrix and the same columns, as a matrix of its own that follows the values of the whole one.
class Submatrix {
 public:
  /// Collective. @param rows of this rank, ascending
  /// @param unknowns theirs, in their order
  Submatrix(const Teuchos::RCP<const Matrix>& whole, const std::vector<int>& rows,
            const Teuchos::RCP<const Tpetra::Map<>>& unknowns);

  const Teuchos::RCP<Matrix>& matrix() const { return matrix_; }

  /// Which of its rows is this one of the whole matrix; -1: none. Local.
  int place_of(int whole_row) const { return place_of_[whole_row]; }

  /// Takes the values that one of its rows has in the whole matrix now. Local.
  void refresh(int row);

 private:
  Teuchos::RCP<const Matrix> whole_;
  Teuchos::RCP<Matrix> matrix_;
  std::vector<int> place_of_;
  std::vector<std::size_t> first_, source_;  ///< by row, and by entry: where the whole matrix has it

  std::vector<int> number_columns(const std::vector<int>& rows, const Teuchos::RCP<const Tpetra::Map<>>& unknowns,
                                  std::vector<base::GlobalId>& columns) const;
};

}  // namespace perimorph::solvers
