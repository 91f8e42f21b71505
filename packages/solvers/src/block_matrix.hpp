#pragma once

#ifdef __SSE__
#include <immintrin.h>
#endif

#include <Eigen/Core>
#include <cstring>
#include <vector>

#include "ghost_exchange.hpp"
#include "perimorph/solvers/multigrid.hpp"

namespace perimorph::solvers {

/// The rows of this rank of a sparse matrix of dense blocks (rows, cols), in single precision. The vectors that it is
/// applied to hold the owned blocks first, then copies of others', which `ghosts()` brings up to date, and `padding`
/// more numbers.
template <int rows, int cols>
class BlockMatrix {
 public:
  using Vector = Eigen::Matrix<float, rows, 1>;

  /// @param matrix whose rows and columns come in blocks: the unknowns of a node or aggregate are numbered one after
  /// the other. Collective.
  explicit BlockMatrix(const Matrix& matrix);

  /// Takes new values of the same matrix in some rows of blocks. Local.
  void read_values(const Matrix& matrix, const std::vector<int>& block_rows);

  int n_rows() const { return static_cast<int>(first_.size()) - 1; }
  std::size_t first(int row) const { return first_[row]; }
  std::size_t end(int row) const { return first_[row + 1]; }
  /// Ascending within a row: owned blocks, then copies.
  int column(std::size_t block) const { return columns_[block]; }
  const GhostExchange<cols>& ghosts() const { return ghosts_; }

  /// @param block from first(row) to end(row)
  Eigen::Matrix<float, rows, cols> block(std::size_t block) const;

  /// Sum of the blocks from `begin` to `end` of a row times x.
  Vector product(std::size_t begin, std::size_t end, const float* x) const {
    Lanes even = Lanes::Zero(), odd = Lanes::Zero();  // two sums, as one would wait for itself
    std::size_t b = begin;
    for (; b + 1 < end; b += 2) {
      add_product(b, x, even);
      add_product(b + 1, x, odd);
    }
    if (b < end) add_product(b, x, even);
    even += odd;
    if constexpr (side_by_side == 2) return even.template head<rows>() + even.template tail<rows>();
    return even.template head<rows>();
  }
  Vector product(int row, const float* x) const { return product(first_[row], first_[row + 1], x); }

  static constexpr int padding = 1;

 private:
  // A block is stored column by column in groups of lanes: two columns of two rows, or one column padded to 4 or 8.
  static constexpr int side_by_side = rows == 2 ? 2 : 1;
  static constexpr int n_lanes = rows <= 4 ? 4 : 8;
  static constexpr int n_groups = (cols + side_by_side - 1) / side_by_side;
  using Lanes = Eigen::Array<float, n_lanes, 1>;

  GhostExchange<cols> ghosts_;
  std::vector<std::size_t> first_;  ///< by row of blocks, and the end
  std::vector<int> columns_;
  std::vector<int> place_;  ///< of the matrix's local columns in a vector
  std::vector<float, Eigen::aligned_allocator<float>> values_;
  std::vector<std::size_t> block_at_;  ///< by block column, in the row that is being read

  std::size_t entry(std::size_t block, int r, int c) const {
    const int group = c / side_by_side, lane = c % side_by_side * rows + r;
    return (block * n_groups + group) * n_lanes + lane;
  }

  void add_product(std::size_t block, const float* x, Lanes& sum) const {
    const float* values = values_.data() + block * n_groups * n_lanes;
    const float* right = x + static_cast<std::ptrdiff_t>(columns_[block]) * cols;
    for (int group = 0; group < n_groups; ++group) {
      sum += Eigen::Map<const Lanes, Eigen::Aligned16>(values + group * n_lanes) * spread(right + group * side_by_side);
    }
  }

  /// The factors of a group's lanes.
  static Lanes spread(const float* x) {
    if constexpr (side_by_side == 1) return Lanes::Constant(*x);
    Lanes factors;
#ifdef __SSE__  // written as four numbers it would be put together one by one
    double both;
    std::memcpy(&both, x, sizeof both);
    const __m128 pair = _mm_castpd_ps(_mm_set_sd(both));
    _mm_store_ps(factors.data(), _mm_unpacklo_ps(pair, pair));
#else
    factors << x[0], x[0], x[1], x[1];
#endif
    return factors;
  }
};

}  // namespace perimorph::solvers
