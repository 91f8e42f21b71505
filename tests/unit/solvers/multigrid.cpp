// The W-cycle as an operator.

#include "perimorph/solvers/multigrid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "perimorph/operators/point_basis.hpp"
#include "support/coupled_body.hpp"

namespace perimorph::tests {
namespace {

using solvers::MultiVector;

/// 40 x 30 squares with a zone of discontinuous elements, held at the left: three levels.
Setup hybrid() {
  Setup setup{{40, 30, 40., 30.}, 3., 0.2, {}};
  setup.zones = {morphing::Zone<2>::ball({20., 15.}, 6., 10.)};
  setup.whole_zone_discontinuous = true;
  setup.prescribed = {{"x", "left", 0, {0., 0.}}, {"y", "left", 1, {0., 0.}}};
  return setup;
}

class Multigrid : public testing::Test {
 protected:
  CoupledBody body{hybrid()};
  Teuchos::RCP<solvers::Matrix> matrix = body.stiffness->matrix();

  solvers::Multigrid make(int rows_per_rank = solvers::Multigrid::default_rows_per_rank) const {
    std::vector<Point2> coordinates;
    for (int n = 0; n < body.dofs->n_owned_nodes(); ++n)
      coordinates.push_back(body.mesh.coordinates[body.dofs->reference_node(n)]);
    return {
        matrix, solvers::rigid_body_modes<2>(*matrix, coordinates), {}, solvers::Multigrid::Cycle::fast, rows_per_rank};
  }

  /// The same on any number of ranks.
  MultiVector wave(double frequency) const {
    MultiVector v(matrix->getRowMap(), 1);
    const auto values = v.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (std::size_t i = 0; i < values.extent(0); ++i) {
      const auto& x = body.mesh.coordinates[body.dofs->reference_node(static_cast<int>(i / 2))];
      values(i, 0) = std::sin(frequency * x[0] + 0.3 * static_cast<double>(i % 2)) * std::cos(0.7 * frequency * x[1]);
    }
    return v;
  }

  static MultiVector times(const solvers::Operator& linear_operator, const MultiVector& v) {
    MultiVector product(v.getMap(), 1);
    linear_operator.apply(v, product);
    return product;
  }
  static double dot(const MultiVector& one, const MultiVector& other) {
    Teuchos::Array<double> result(1);
    one.dot(other, result());
    return result[0];
  }
};

/// How few ranks hold the coarse levels: all of them, some, one.
class GatheredMultigrid : public Multigrid, public testing::WithParamInterface<int> {};
INSTANTIATE_TEST_SUITE_P(RowsPerRank, GatheredMultigrid, testing::Values(1, 60, 100000));

TEST_P(GatheredMultigrid, IsSymmetricAndPositiveUpToSinglePrecision) {
  const auto multigrid = make(GetParam());
  const auto& cycle = *multigrid.apply_inverse();
  for (const double one : {0.05, 0.4, 2.9}) {
    const auto x = wave(one), cycle_x = times(cycle, x);
    EXPECT_GT(dot(x, cycle_x), 0.);
    for (const double other : {0.1, 1.3}) {
      const auto y = wave(other), cycle_y = times(cycle, y);
      const double scale = std::sqrt(dot(x, cycle_x) * dot(y, cycle_y));
      EXPECT_NEAR(dot(x, cycle_y), dot(cycle_x, y), 1e-5 * scale) << one << " " << other;
    }
  }
}

TEST_P(GatheredMultigrid, ReducesSmoothAndRoughErrorsAlike) {
  const auto multigrid = make(GetParam());
  for (const double frequency : {0.05, 0.4, 2.9}) {
    auto error = wave(frequency);
    const double before = dot(error, times(*matrix, error));
    const auto correction = times(*multigrid.apply_inverse(), times(*matrix, error));
    error.update(-1., correction, 1.);
    EXPECT_LT(dot(error, times(*matrix, error)), 0.5 * before) << "energy of the error, frequency " << frequency;
  }
}

TEST_F(Multigrid, FollowsNewValuesWhenRefreshed) {
  auto multigrid = make();
  const auto x = wave(0.4);
  const auto before = times(*multigrid.apply_inverse(), x);

  matrix->resumeFill();
  matrix->scale(4.);
  matrix->fillComplete();
  multigrid.refresh();

  auto after = times(*multigrid.apply_inverse(), x);
  after.update(-1., before, 4.);
  EXPECT_LT(std::sqrt(dot(after, after)), 1e-4 * std::sqrt(dot(before, before)));
}

TEST_F(Multigrid, FollowsNewValuesOfTheFinestLevelWhereTheyAre) {
  auto one = make(), other = make();
  const auto x = wave(0.4);
  const auto before = times(*one.apply_inverse(), x);
  const auto local = matrix->getLocalMatrixHost();
  std::vector<int> all(body.dofs->n_owned_nodes()), changed;
  std::iota(all.begin(), all.end(), 0);
  for (int node = 0; node < body.dofs->n_owned_nodes(); node += 7) {
    changed.push_back(node);
    for (int row : {2 * node, 2 * node + 1}) {
      for (auto k = local.graph.row_map(row); k < local.graph.row_map(row + 1); ++k) local.values(k) *= 1.1;
    }
  }

  one.refresh_finest(changed);
  other.refresh_finest(all);

  auto difference = times(*one.apply_inverse(), x);
  difference.update(-1., times(*other.apply_inverse(), x), 1.);
  EXPECT_EQ(dot(difference, difference), 0.);
  difference = times(*one.apply_inverse(), x);
  difference.update(-1., before, 1.);
  EXPECT_GT(dot(difference, difference), 1e-6 * dot(before, before));
}

/// Before the elements of the zone parted.
class MovedMultigrid : public Multigrid, public testing::WithParamInterface<bool> {
 protected:
  CoupledBody before{[] {
    auto setup = hybrid();
    setup.whole_zone_discontinuous = false;
    return setup;
  }()};
};

TEST_P(MovedMultigrid, IsSymmetricAndReducesErrorsOfTheMatrixThatItHasMovedTo) {
  const bool is_by_points = GetParam();
  Teuchos::RCP<const operators::PointBasis<2>> basis;
  std::vector<Point2> coordinates = before.node_coordinates();
  const auto old_matrix = before.stiffness->matrix();
  solvers::Multigrid multigrid(old_matrix, solvers::rigid_body_modes<2>(*old_matrix, coordinates), {},
                               solvers::Multigrid::Cycle::fast);
  std::unique_ptr<operators::StiffnessMatrix<2>> by_points;
  if (is_by_points) {
    basis = body.point_basis();
    by_points = body.matrix_of(operators::all_bonds, basis);
    matrix = by_points->matrix();
  }

  multigrid.move_to(matrix, operators::weights_of_old_unknowns<2>(body.model(), basis.get(), *before.dofs, nullptr));

  ASSERT_GT(matrix->getGlobalNumRows(), old_matrix->getGlobalNumRows());
  const auto& cycle = *multigrid.apply_inverse();
  const auto x = wave(0.4), y = wave(1.3);
  const auto cycle_x = times(cycle, x), cycle_y = times(cycle, y);
  EXPECT_NEAR(dot(x, cycle_y), dot(cycle_x, y), 1e-5 * std::sqrt(dot(x, cycle_x) * dot(y, cycle_y)));
  for (const double frequency : {0.05, 0.4, 2.9}) {
    auto error = wave(frequency);
    const double energy = dot(error, times(*matrix, error));
    error.update(-1., times(cycle, times(*matrix, error)), 1.);
    EXPECT_LT(dot(error, times(*matrix, error)), 0.5 * energy) << "frequency " << frequency;
  }
}

INSTANTIATE_TEST_SUITE_P(Bases, MovedMultigrid, testing::Bool());

/// Values that were zero, as those between x and y are in many a regular mesh, and no longer are.
TEST_F(Multigrid, IsRefreshedWhereZerosHaveGotValues) {
  const auto values = matrix->getLocalMatrixHost().values;
  const std::vector<double> all(values.data(), values.data() + values.extent(0));
  const auto local = matrix->getLocalMatrixHost();
  for (int row = 0; row < local.numRows(); ++row) {
    for (auto k = local.graph.row_map(row); k < local.graph.row_map(row + 1); ++k) {
      if ((local.graph.entries(k) + row) % 2 == 1) values(k) = 0.;
    }
  }
  auto multigrid = make();
  std::copy(all.begin(), all.end(), values.data());

  multigrid.refresh();

  auto error = wave(0.4);
  const double before = dot(error, times(*matrix, error));
  error.update(-1., times(*multigrid.apply_inverse(), times(*matrix, error)), 1.);
  EXPECT_LT(dot(error, times(*matrix, error)), 0.5 * before);
}

}  // namespace
}  // namespace perimorph::tests
