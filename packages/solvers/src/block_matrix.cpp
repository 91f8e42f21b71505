#include "block_matrix.hpp"

#include <Tpetra_CrsMatrix.hpp>
#include <algorithm>
#include <numeric>

#include "perimorph/base/errors.hpp"

namespace perimorph::solvers {

template <int rows, int cols>
BlockMatrix<rows, cols>::BlockMatrix(const Matrix& matrix) : ghosts_(matrix.getDomainMap(), *matrix.getColMap()) {
  const auto local = matrix.getLocalMatrixHost();
  const int n_rows = static_cast<int>(local.numRows()) / rows;
  PERIMORPH_ASSERT(n_rows * rows == local.numRows(), "{} rows are no blocks of {}", local.numRows(), rows);
  place_.resize(matrix.getColMap()->getNodeNumElements());
  for (std::size_t i = 0; i < place_.size(); ++i) {
    const base::GlobalId number = matrix.getColMap()->getGlobalElement(static_cast<int>(i));
    place_[i] = ghosts_.local_block(number) * cols + ghosts_.component(number);
  }
  std::vector<int> last_row(ghosts_.n_all(), -1);  // that the block column has been found in
  first_ = {0};
  for (int row = 0; row < n_rows; ++row) {
    const auto begin = static_cast<std::ptrdiff_t>(first_.back());
    for (auto k = local.graph.row_map(row * rows); k < local.graph.row_map((row + 1) * rows); ++k) {
      const int block = place_[local.graph.entries(k)] / cols;
      if (last_row[block] == row) continue;
      last_row[block] = row;
      columns_.push_back(block);
    }
    std::sort(columns_.begin() + begin, columns_.end());
    first_.push_back(columns_.size());
  }
  values_.assign(columns_.size() * n_groups * n_lanes, 0.f);
  block_at_.resize(ghosts_.n_all());
  std::vector<int> all(n_rows);
  std::iota(all.begin(), all.end(), 0);
  read_values(matrix, all);
}

template <int rows, int cols>
void BlockMatrix<rows, cols>::read_values(const Matrix& matrix, const std::vector<int>& block_rows) {
  const auto local = matrix.getLocalMatrixHost();
  PERIMORPH_ASSERT(matrix.getNodeNumRows() == static_cast<std::size_t>(n_rows()) * rows, "{} rows in place of {}",
                   matrix.getNodeNumRows(), n_rows() * rows);
  for (const int row : block_rows) {
    PERIMORPH_DEBUG_ASSERT(row >= 0 && row < n_rows(), "row {} of {}", row, n_rows());
    for (std::size_t b = first_[row]; b < first_[row + 1]; ++b) block_at_[columns_[b]] = b;
    for (int r = 0; r < rows; ++r) {
      for (auto k = local.graph.row_map(row * rows + r); k < local.graph.row_map(row * rows + r + 1); ++k) {
        const int place = place_[local.graph.entries(k)];
        values_[entry(block_at_[place / cols], r, place % cols)] = static_cast<float>(local.values(k));
      }
    }
  }
}

template <int rows, int cols>
Eigen::Matrix<float, rows, cols> BlockMatrix<rows, cols>::block(std::size_t block) const {
  PERIMORPH_DEBUG_ASSERT(block < columns_.size(), "block {} of {}", block, columns_.size());
  Eigen::Matrix<float, rows, cols> result;
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < cols; ++c) result(r, c) = values_[entry(block, r, c)];
  }
  return result;
}

template class BlockMatrix<2, 2>;
template class BlockMatrix<2, 3>;
template class BlockMatrix<3, 2>;
template class BlockMatrix<3, 3>;
template class BlockMatrix<3, 6>;
template class BlockMatrix<6, 3>;
template class BlockMatrix<6, 6>;

}  // namespace perimorph::solvers
