#include "block_matrix.hpp"

#include <Tpetra_CrsMatrix.hpp>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "perimorph/base/errors.hpp"

namespace perimorph::solvers {

template <int rows, int cols, class Number>
BlockMatrix<rows, cols, Number>::BlockMatrix(const Matrix& matrix)
    : ghosts_(matrix.getDomainMap(), *matrix.getColMap()) {
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
  values_.assign(columns_.size() * n_groups * n_lanes, Number(0.f));
  if constexpr (is_half) {
    units_.resize(n_rows);
    diagonal_.resize(n_rows);
  }
  block_at_.resize(ghosts_.n_all());
  std::vector<int> all(n_rows);
  std::iota(all.begin(), all.end(), 0);
  read_values(matrix, all);
}

template <int rows, int cols, class Number>
void BlockMatrix<rows, cols, Number>::read_values(const Matrix& matrix, const std::vector<int>& block_rows) {
  const auto local = matrix.getLocalMatrixHost();
  PERIMORPH_ASSERT(matrix.getNodeNumRows() == static_cast<std::size_t>(n_rows()) * rows, "{} rows in place of {}",
                   matrix.getNodeNumRows(), n_rows() * rows);
  std::vector<Block> blocks;
  for (const int row : block_rows) {
    PERIMORPH_DEBUG_ASSERT(row >= 0 && row < n_rows(), "row {} of {}", row, n_rows());
    blocks.assign(end(row) - first(row), Block::Zero());
    for (std::size_t b = first_[row]; b < first_[row + 1]; ++b) block_at_[columns_[b]] = b - first_[row];
    for (int r = 0; r < rows; ++r) {
      for (auto k = local.graph.row_map(row * rows + r); k < local.graph.row_map(row * rows + r + 1); ++k) {
        const int place = place_[local.graph.entries(k)];
        blocks[block_at_[place / cols]](r, place % cols) = static_cast<float>(local.values(k));
      }
    }
    if constexpr (is_half) take_diagonal(row, blocks);
    for (std::size_t b = 0; b < blocks.size(); ++b) store(first_[row] + b, blocks[b]);
  }
}

/// Leaves the others in the row's unit, and rounded.
template <int rows, int cols, class Number>
void BlockMatrix<rows, cols, Number>::take_diagonal(int row, std::vector<Block>& blocks) {
  Block& diagonal = diagonal_[row];
  diagonal.setZero();
  float largest = 0.f;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (columns_[first_[row] + b] == row) {
      std::swap(diagonal, blocks[b]);
    } else {
      largest = std::max(largest, blocks[b].cwiseAbs().maxCoeff());
    }
  }
  units_[row] = largest > 0.f ? std::exp2(std::ceil(std::log2(largest))) : 1.f;
  Block lost = Block::Zero();
  for (Block& block : blocks) {
    const Block rounded = (block / units_[row]).template cast<Eigen::half>().template cast<float>();
    lost += block - units_[row] * rounded;
    block = rounded;
  }
  if constexpr (is_half) diagonal += 0.5f * (lost + lost.transpose());  // to remain symmetric
}

template <int rows, int cols, class Number>
void BlockMatrix<rows, cols, Number>::store(std::size_t block, const Block& values) {
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < cols; ++c) values_[entry(block, r, c)] = static_cast<Number>(values(r, c));
  }
}

template <int rows, int cols, class Number>
typename BlockMatrix<rows, cols, Number>::Block BlockMatrix<rows, cols, Number>::block(int row,
                                                                                       std::size_t block) const {
  PERIMORPH_DEBUG_ASSERT(block >= first_[row] && block < first_[row + 1], "block {} of row {}", block, row);
  if constexpr (is_half) {
    if (columns_[block] == row) return diagonal_[row];
  }
  Block result;
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < cols; ++c) result(r, c) = static_cast<float>(values_[entry(block, r, c)]);
  }
  if constexpr (is_half) result *= units_[row];
  return result;
}

template class BlockMatrix<2, 2>;
template class BlockMatrix<2, 3>;
template class BlockMatrix<3, 2>;
template class BlockMatrix<3, 3>;
template class BlockMatrix<3, 6>;
template class BlockMatrix<6, 3>;
template class BlockMatrix<6, 6>;
template class BlockMatrix<2, 2, Eigen::half>;
template class BlockMatrix<3, 3, Eigen::half>;

}  // namespace perimorph::solvers
