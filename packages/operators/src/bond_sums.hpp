#pragma once

#include <array>
#include <cstddef>

#include "lanes.hpp"

// What BondForces sums up as it passes over its blocks: bonds from two points of the first packet to the four of the
// second at once.

namespace perimorph::operators {

inline RowPair first_ends(const double* at_points) {
  RowPair both;
  both << Lanes::Constant(at_points[0]), Lanes::Constant(at_points[1]);
  return both;
}
inline auto first_row(const RowPair& rows) { return rows.head<n_lanes>(); }
inline auto second_row(const RowPair& rows) { return rows.tail<n_lanes>(); }
template <int dim>
RowPair squared(const std::array<RowPair, dim>& xi) {
  RowPair sum = RowPair::Zero();
  for (int c = 0; c < dim; ++c) sum += xi[c] * xi[c];
  return sum;
}

/// Adds to the first packet's points what two rows of bonds have summed up.
inline void add_rows(const RowPair& sum, double* at_points) {
  at_points[0] += first_row(sum).sum();
  at_points[1] += second_row(sum).sum();
}
/// The same to the second packet's.
inline void add_columns(const RowPair& sum, double* at_points) {
  Eigen::Map<Lanes>(at_points) += first_row(sum) + second_row(sum);
}

/// What both ends of the bonds add to their stretch, if anything.
template <int dim, bool is_added>
class AddedStretch {
 public:
  /// @param added per packet: (4)
  explicit AddedStretch(const double* added) : added_(added) {}
  void start(std::size_t a) {
    if constexpr (is_added) {
      for (int rows = 0; rows < n_lanes / 2; ++rows) of_a_[rows] = first_ends(added_ + a * n_lanes + 2 * rows);
    }
  }
  void start_block(std::size_t b) {
    if constexpr (is_added) of_b_ = twice(added_ + b * n_lanes);
  }
  void add_to(RowPair& elongation, int rows, const std::array<RowPair, dim>& xi) const {
    if constexpr (is_added) elongation += squared<dim>(xi) * (of_a_[rows] + of_b_);
  }

 private:
  const double* added_;
  std::array<RowPair, n_lanes / 2> of_a_;
  RowPair of_b_;
};

/// Forces of the bonds on both ends.
template <int dim, bool is_added>
class SumOfForces {
 public:
  /// @param forces per packet: (dim, 4); @param added to the stretch by the ends, per packet: (4), if it is
  SumOfForces(double* forces, const double* added) : forces_(forces), added_(added) {}

  void start(std::size_t a) {
    for (int rows = 0; rows < n_lanes / 2; ++rows) {
      for (int c = 0; c < dim; ++c) on_a_[rows][c].setZero();
    }
    added_.start(a);
  }
  void start_block(std::size_t b) {
    for (int c = 0; c < dim; ++c) on_b_[c].setZero();
    added_.start_block(b);
  }
  void add(int rows, const std::array<RowPair, dim>& xi, RowPair elongation, const RowPair& stiffness) {
    added_.add_to(elongation, rows, xi);
    const RowPair tension = elongation * stiffness;
    for (int c = 0; c < dim; ++c) {
      on_a_[rows][c] -= tension * xi[c];
      on_b_[c] += tension * xi[c];
    }
  }
  void end_block(std::size_t b) {
    for (int c = 0; c < dim; ++c) add_columns(on_b_[c], forces_ + (b * dim + c) * n_lanes);
  }
  void end(std::size_t a) {
    for (int rows = 0; rows < n_lanes / 2; ++rows) {
      for (int c = 0; c < dim; ++c) add_rows(on_a_[rows][c], forces_ + (a * dim + c) * n_lanes + 2 * rows);
    }
  }

 private:
  double* forces_;
  AddedStretch<dim, is_added> added_;
  std::array<std::array<RowPair, dim>, n_lanes / 2> on_a_;
  std::array<RowPair, dim> on_b_;
};

/// |xi|^2 times the tension of the bonds, at both ends: S, where no dilatation is added.
template <int dim, bool is_added>
class SumOfTensions {
 public:
  /// @param sums per packet: (4), [force length]; @param added as for SumOfForces
  SumOfTensions(double* sums, const double* added) : sums_(sums), added_(added) {}
  void start(std::size_t a) {
    at_a_.fill(RowPair::Zero());
    added_.start(a);
  }
  void start_block(std::size_t b) {
    at_b_.setZero();
    added_.start_block(b);
  }
  void add(int rows, const std::array<RowPair, dim>& xi, RowPair elongation, const RowPair& stiffness) {
    added_.add_to(elongation, rows, xi);
    const RowPair weighted = squared<dim>(xi) * stiffness * elongation;
    at_a_[rows] += weighted;
    at_b_ += weighted;
  }
  void end_block(std::size_t b) { add_columns(at_b_, sums_ + b * n_lanes); }
  void end(std::size_t a) {
    for (int rows = 0; rows < n_lanes / 2; ++rows) add_rows(at_a_[rows], sums_ + a * n_lanes + 2 * rows);
  }

 private:
  double* sums_;
  AddedStretch<dim, is_added> added_;
  std::array<RowPair, n_lanes / 2> at_a_;
  RowPair at_b_;
};

}  // namespace perimorph::operators
