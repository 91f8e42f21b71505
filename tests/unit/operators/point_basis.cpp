// Displacements of points as unknowns: the same operator as with those of nodes, on every number of ranks.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/coupled_body.hpp"

namespace perimorph::tests {
namespace {

using Vector = Tpetra::Vector<double>;

/// Irregular elements, half of them discontinuous, a side held.
Setup held(bool triangles) {
  Setup setup{{19, 17, 19., 17., Point2::Zero(), 0.15, triangles}, 2.5, 0.5, {}};
  setup.zones = {morphing::Zone<2>::ball({5., 8.}, 8., 9.5)};
  setup.whole_zone_discontinuous = true;
  setup.prescribed = {{"hold", "left", 0, {0., 0.}}, {"hold", "left", 1, {0., 0.}}};
  return setup;
}

class PointBasis : public ::testing::TestWithParam<bool> {
 protected:
  CoupledBody body{held(GetParam())};
  Teuchos::RCP<const operators::PointBasis<2>> basis = body.point_basis();
  std::unique_ptr<operators::StiffnessMatrix<2>> by_points = body.matrix_of(operators::all_bonds, basis);

  Vector wave(double frequency) const {
    Vector x(body.dofs->owned_dofs());
    const auto values = x.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (std::size_t i = 0; i < x.getLocalLength(); ++i) {
      values(i, 0) = std::sin(frequency * static_cast<double>(x.getMap()->getGlobalElement(static_cast<int>(i))));
    }
    return x;
  }

  int n_held() const {
    int n = 0;
    for (int e = 0; e < body.mesh.n_owned_elements; ++e) n += basis->holds(e);
    return static_cast<int>(base::sum(*body.comm, static_cast<base::GlobalId>(n)));
  }

  /// T^T K T x = K_points x, but for the anchors' springs, which are 1e-8 of an element's stiffness.
  void expect_the_same_operator() const {
    const Vector x = wave(1.7);
    Vector on_nodes(x.getMap()), forces(x.getMap()), expected(x.getMap()), actual(x.getMap());
    basis->apply(x, on_nodes);
    body.stiffness->matrix()->apply(on_nodes, forces);
    basis->apply(forces, expected, Teuchos::TRANS);
    by_points->matrix()->apply(x, actual);
    actual.update(-1., expected, 1.);
    EXPECT_LT(actual.norm2(), 1e-7 * expected.norm2());
  }
};

TEST_P(PointBasis, GivesTheSameOperatorWithFewerEntries) {
  EXPECT_GT(n_held(), 40);
  expect_the_same_operator();
  EXPECT_LT(by_points->matrix()->getGlobalNumEntries(), 0.85 * body.stiffness->matrix()->getGlobalNumEntries());
}

TEST_P(PointBasis, GivesTheSameOperatorAfterBondsBreak) {
  const auto broken = body.break_each(3);
  body.stiffness->take({broken});
  by_points->take({broken});
  expect_the_same_operator();
}

TEST_P(PointBasis, NamesAllNodesWhoseRowsBrokenBondsChange) {
  const CoupledBody::Matrix before(*by_points->matrix(), Teuchos::Copy);
  const auto result = by_points->take({body.break_each(71)});
  const std::set<int> named(result.begin(), result.end());
  const auto changed = CoupledBody::nodes_that_differ(before, *by_points->matrix());
  EXPECT_LT(named.size(), 0.7 * body.dofs->n_owned_nodes());
  EXPECT_TRUE(std::includes(named.begin(), named.end(), changed.begin(), changed.end()));
  EXPECT_GT(base::sum(*body.comm, static_cast<base::GlobalId>(changed.size())), 0);
}

TEST_P(PointBasis, TakesAnAffineFieldAtItsCoordinatesToTheNodes) {
  const auto affine = [](const Point2& x, int c) { return c == 0 ? 2. - x[0] + 3. * x[1] : 0.5 * x[0] - x[1]; };
  Vector at_unknowns(body.dofs->owned_dofs()), actual(at_unknowns.getMap());
  const auto nodes = body.node_coordinates();
  auto coordinates = nodes;
  basis->move_to_points(coordinates);
  const auto values = at_unknowns.getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (std::size_t i = 0; i < values.extent(0); ++i) values(i, 0) = affine(coordinates[i / 2], static_cast<int>(i % 2));
  basis->apply(at_unknowns, actual);
  const auto results = actual.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t i = 0; i < results.extent(0); ++i) {
    EXPECT_NEAR(results(i, 0), affine(nodes[i / 2], static_cast<int>(i % 2)), 1e-12 * 100.);
  }
}

TEST_P(PointBasis, TakesAnAffineFieldOverFromTheTopologyBefore) {
  auto setup = held(GetParam());
  setup.whole_zone_discontinuous = false;
  const CoupledBody before(setup);
  const auto old_coordinates = before.node_coordinates();
  auto coordinates = body.node_coordinates();
  basis->move_to_points(coordinates);

  const auto weights = operators::weights_of_old_unknowns<2>(body.model(), basis.get(), *before.dofs, nullptr);

  ASSERT_EQ(weights.size(), coordinates.size());
  for (std::size_t n = 0; n < weights.size(); ++n) {
    Point2 x = Point2::Zero();
    for (const auto& [old, weight] : weights[n]) x += weight * old_coordinates[old];
    EXPECT_LT((x - coordinates[n]).norm(), 1e-12 * 20.);
  }
}

TEST_P(PointBasis, IsTheTransposeOfItsTranspose) {
  const Vector x = wave(1.7), y = wave(0.9);
  Vector t_x(x.getMap()), t_y(x.getMap());
  t_x.putScalar(3.);
  basis->apply(x, t_x, Teuchos::NO_TRANS, -2., 0.5);  // 1.5 - 2 T x
  basis->apply(y, t_y, Teuchos::TRANS);
  EXPECT_NEAR(1.5 * y.meanValue() * static_cast<double>(y.getGlobalLength()) - t_x.dot(y), 2. * x.dot(t_y),
              1e-12 * x.norm2() * t_y.norm2());
}

INSTANTIATE_TEST_SUITE_P(Meshes, PointBasis, ::testing::Bool());

}  // namespace
}  // namespace perimorph::tests
