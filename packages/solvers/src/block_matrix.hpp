#pragma once

#if defined(__SSE__) || defined(__F16C__)
#include <immintrin.h>
#endif

#include <Eigen/Core>
#include <cstring>
#include <type_traits>
#include <vector>

#include "ghost_exchange.hpp"
#include "perimorph/solvers/multigrid.hpp"

namespace perimorph::solvers {

/// The rows of this rank of a sparse matrix of dense blocks (rows, cols), in single or half precision. The vectors that
/// it is applied to hold the owned blocks first, then copies of others', which `ghosts()` brings up to date, and
/// `padding` more numbers; they are in single precision.
///
/// In half precision, for square matrices, each row has a power of two as its unit, and its diagonal block is in single
/// precision: it takes up what the others have been rounded by, so that what moves as one still feels no force.
template <int rows, int cols, class Number = float>
class BlockMatrix {
 public:
  using Vector = Eigen::Matrix<float, rows, 1>;
  using Block = Eigen::Matrix<float, rows, cols>;

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
  /// What a product reads of this rank's blocks, [bytes].
  double bytes() const { return static_cast<double>(values_.size() * sizeof(Number) + columns_.size() * sizeof(int)); }

  /// @param block from first(row) to end(row)
  Block block(int row, std::size_t block) const;

  /// Sum of the blocks from `begin` to `end` of a row times x; the diagonal one is not among them, or the row is whole.
  Vector product(int row, std::size_t begin, std::size_t end, const float* x) const {
    if constexpr (is_half) {
      return units_[row] * product(begin, end, x);
    } else {
      return product(begin, end, x);
    }
  }
  Vector product(int row, const float* x) const {
    Vector sum = product(row, first_[row], first_[row + 1], x);
    if constexpr (is_half) {
      sum += diagonal_[row] * Eigen::Map<const Vector>(x + static_cast<std::ptrdiff_t>(row) * cols);
    }
    return sum;
  }

  static constexpr int padding = 1;

 private:
  static constexpr bool is_half = std::is_same_v<Number, Eigen::half>;
  static_assert(!is_half || (rows == cols && rows <= 4), "square matrices with blocks of up to four rows");

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

  // A block is stored column by column in groups of lanes: two columns of two rows, or one column padded to 4 or 8.
  static constexpr int side_by_side = rows == 2 ? 2 : 1;
  static constexpr int n_lanes = rows <= 4 ? 4 : 8;
  static constexpr int n_groups = (cols + side_by_side - 1) / side_by_side;
  using Lanes = Eigen::Array<float, n_lanes, 1>;

  GhostExchange<cols> ghosts_;
  std::vector<std::size_t> first_;  ///< by row of blocks, and the end
  std::vector<int> columns_;
  std::vector<int> place_;  ///< of the matrix's local columns in a vector
  std::vector<Number, Eigen::aligned_allocator<Number>> values_;
  std::vector<float> units_;           ///< by row; in half precision only
  std::vector<Block> diagonal_;        ///< the same
  std::vector<std::size_t> block_at_;  ///< by block column, in the row that is being read

  void take_diagonal(int row, std::vector<Block>& blocks);
  void store(std::size_t block, const Block& values);
  std::size_t entry(std::size_t block, int r, int c) const {
    const int group = c / side_by_side, lane = c % side_by_side * rows + r;
    return (block * n_groups + group) * n_lanes + lane;
  }

  void add_product(std::size_t block, const float* x, Lanes& sum) const {
    const Number* values = values_.data() + block * n_groups * n_lanes;
    const float* right = x + static_cast<std::ptrdiff_t>(columns_[block]) * cols;
    for (int group = 0; group < n_groups; ++group) {
      sum += lanes_at(values + group * n_lanes) * spread(right + group * side_by_side);
    }
  }

  static Eigen::Map<const Lanes, Eigen::Aligned16> lanes_at(const float* values) {
    return Eigen::Map<const Lanes, Eigen::Aligned16>(values);
  }
  static Lanes lanes_at(const Eigen::half* values) {
    Lanes lanes;
#ifdef __F16C__
    _mm_store_ps(lanes.data(), _mm_cvtph_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(values))));
#else
    for (int i = 0; i < n_lanes; ++i) lanes[i] = static_cast<float>(values[i]);
#endif
    return lanes;
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
