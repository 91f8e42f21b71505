// The coupled stiffness against a plain reference assembled by brute force over all pairs of points, and its
// properties.

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "perimorph/elements/strain.hpp"
#include "support/coupled_body.hpp"

namespace perimorph::tests {
namespace {

using operators::PeridynamicStiffness;

/// A 9 x 8 grid of irregular quadrilaterals, spacing 1, with a zone in the middle: all three classes occur.
Setup hybrid(PeridynamicStiffness policy, bool discontinuous, bool triangles = false) {
  Setup setup{{9, 8, 9., 8., Point2::Zero(), 0.15, triangles}, 2., 0.4, {}, policy, discontinuous, {}, {}};
  setup.zones = {morphing::Zone<2>::ball({4.5, 4.}, 3., 4.)};
  return setup;
}

/// Shape function values of all nodes at a point of an element, as a (2, 2 n_nodes) matrix.
Eigen::MatrixXd interpolation(const CoupledBody& body, int e, int q) {
  Eigen::MatrixXd n = Eigen::MatrixXd::Zero(2, 2 * body.dofs->n_nodes());
  for (int k = 0; k < body.mesh.n_corners(e); ++k) {
    for (int c = 0; c < 2; ++c) n(c, 2 * body.dofs->nodes_of(e)[k] + c) += body.points.shape(e, q)(k);
  }
  return n;
}

struct PlainPoint {
  int element, q, index;
  Point2 x;
  double w, alpha;
};

std::vector<PlainPoint> all_points(const CoupledBody& body) {
  std::vector<PlainPoint> points;
  for (int e = 0; e < body.mesh.n_elements(); ++e) {
    for (int q = 0; q < body.points.count(e); ++q) {
      const int p = body.points.first(e) + q;
      points.push_back({e, q, p, body.points.position(p), body.points.weight(p), body.alpha(p)});
    }
  }
  return points;
}

/// c0 of WHL19, eq. 24, written out.
double plain_micromodulus(const CoupledBody& body, double r) {
  return r <= body.c0.horizon * (1. + 1e-9) ? body.c0.tau0 * std::exp(-r / body.c0.characteristic_length) : 0.;
}

/// WHL19, eq. 22: all ordered pairs of points of a convex body, factor 1/2, no shortcuts. E(x) is taken as computed.
Eigen::MatrixXd reference_stiffness(const CoupledBody& body) {
  const int n = 2 * body.dofs->n_nodes();
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(n, n);
  const auto points = all_points(body);
  for (const auto& x : points) {
    Eigen::MatrixXd b = Eigen::MatrixXd::Zero(3, n);
    const auto g = body.points.gradients(x.element, x.q);
    for (int c = 0; c < g.cols(); ++c) {
      const int node = body.dofs->nodes_of(x.element)[c];
      b(0, 2 * node) += g(0, c);
      b(1, 2 * node + 1) += g(1, c);
      b(2, 2 * node) += g(1, c);
      b(2, 2 * node + 1) += g(0, c);
    }
    k += x.w * b.transpose() * body.elasticity.at(x.element, x.q) * b;
    for (const auto& p : points) {
      if (p.index == x.index) continue;
      const Point2 xi = p.x - x.x;
      const double c = 0.5 * plain_micromodulus(body, xi.norm()) * 0.5 * (x.alpha + p.alpha) * x.w * p.w;
      if (c == 0.) continue;
      const Eigen::MatrixXd eta = interpolation(body, p.element, p.q) - interpolation(body, x.element, x.q);
      k += c * eta.transpose() * (xi * xi.transpose()) * eta;
    }
  }
  return k;
}

class StiffnessMatrix : public ::testing::TestWithParam<std::tuple<PeridynamicStiffness, bool, bool>> {
 protected:
  CoupledBody body{std::apply(hybrid, GetParam())};
};

TEST_P(StiffnessMatrix, EqualsTheBruteForceSumOverAllPairsOfPoints) {
  const Eigen::MatrixXd expected = reference_stiffness(body);
  // Bonds are stored in single precision; anchors are 1e-8 of the diagonals.
  EXPECT_LT((body.dense() - expected).cwiseAbs().maxCoeff(), 1e-7 * expected.cwiseAbs().maxCoeff());
}

TEST_P(StiffnessMatrix, IsSymmetricAndPositiveWithThreeRigidModesAtZeroEnergy) {
  const Eigen::MatrixXd k = body.dense();
  EXPECT_LT((k - k.transpose()).cwiseAbs().maxCoeff(), 1e-13 * k.cwiseAbs().maxCoeff());
  const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k).eigenvalues();
  const double largest = eigenvalues.maxCoeff();
  EXPECT_LT(eigenvalues.head(3).cwiseAbs().maxCoeff(), 1e-7 * largest);  // the anchors'
  EXPECT_GT(eigenvalues[3], 1e-5 * largest);
}

TEST_P(StiffnessMatrix, WithoutBrokenBondsEqualsTheOneAssembledAfterBreaking) {
  const std::vector<double> zero(2 * body.dofs->n_nodes(), 0.);
  const auto broken = body.break_each(3);
  ASSERT_GT(broken.size(), 100u);
  body.stiffness->take({broken});
  const Eigen::MatrixXd updated = body.dense();
  body.make_matrix();
  EXPECT_LT((updated - body.dense()).cwiseAbs().maxCoeff(), 1e-13 * updated.cwiseAbs().maxCoeff());
}

TEST_P(StiffnessMatrix, NamesAllNodesWhoseRowsBrokenBondsChange) {
  const CoupledBody::Matrix before(*body.stiffness->matrix(), Teuchos::Copy);
  const auto named = body.stiffness->take({body.break_each(71)});
  const auto changed = CoupledBody::nodes_that_differ(before, *body.stiffness->matrix());
  EXPECT_GT(changed.size(), 0u);
  EXPECT_LT(changed.size(), 0.7 * body.dofs->n_nodes());
  EXPECT_EQ(changed, std::set<int>(named.begin(), named.end()));
}

/// Some soften twice, and some of these break.
TEST(StiffnessOfSoftBonds, FollowsThemInTheMatrixAndWithoutOne) {
  tests::Setup setup = hybrid(PeridynamicStiffness::dropped, false);
  setup.law = soft_law();
  CoupledBody body(setup);
  const double intact = body.dense().trace();
  body.soften_each(3, 0.05);
  body.make_matrix();
  const double softened = body.dense().trace();
  EXPECT_LT(softened, 0.98 * intact);
  const auto terms = body.terms();
  const auto matrix_free = body.tangent(terms);
  const auto take = [&](const bonds::BondChange& change) {
    body.stiffness->take(change);
    for (const auto& term : terms) term->take(change);
  };
  take(body.soften_each(3, 0.2));
  take({body.break_each(6)});
  const Eigen::MatrixXd updated = body.dense();
  EXPECT_LT(updated.trace(), 0.99 * softened);

  Tpetra::Vector<double> x(body.dofs->owned_dofs()), product(x.getMap()), same(x.getMap());
  x.randomize();
  body.stiffness->matrix()->apply(x, product);
  matrix_free.apply(x, same);
  same.update(-1., product, 1.);
  EXPECT_LT(same.norm2(), 1e-6 * product.norm2());  // bonds in single precision

  body.make_matrix();
  EXPECT_LT((updated - body.dense()).cwiseAbs().maxCoeff(), 1e-13 * updated.cwiseAbs().maxCoeff());
}

INSTANTIATE_TEST_SUITE_P(Policies, StiffnessMatrix,
                         ::testing::Combine(::testing::Values(PeridynamicStiffness::dropped,
                                                              PeridynamicStiffness::kept),
                                            ::testing::Bool(), ::testing::Bool()));

TEST(MorphedStiffness, EqualsTheDiscreteSumOfEquation16) {
  const CoupledBody body(hybrid(PeridynamicStiffness::kept, false));
  const auto points = all_points(body);
  int n_reduced = 0;
  for (const auto& x : points) {
    base::Stiffness<2> e = body.e0;
    for (const auto& p : points) {
      if (p.index == x.index) continue;
      const Point2 xi = p.x - x.x;
      const double factor = 0.5 * plain_micromodulus(body, xi.norm()) * 0.5 * (x.alpha + p.alpha) * p.w;
      const Eigen::Vector3d v(xi[0] * xi[0], xi[1] * xi[1], xi[0] * xi[1]);
      e -= factor * v * v.transpose();
    }
    EXPECT_LT((body.elasticity.at(x.element, x.q) - e).norm(), 1e-7 * body.e0.norm());  // bonds in single precision
    n_reduced += (e - body.e0).norm() > 0.01 * body.e0.norm();
  }
  EXPECT_GT(n_reduced, 100);  // the zone is there
}

TEST(MorphedStiffness, IsPositiveInDiscontinuousElements) {
  const CoupledBody body(hybrid(PeridynamicStiffness::kept, true));
  int n_indefinite = 0;
  for (int e = 0; e < body.mesh.n_elements(); ++e) {
    for (int q = 0; q < body.points.count(e); ++q) {
      const Eigen::SelfAdjointEigenSolver<base::Stiffness<2>> eigen(body.elasticity.at(e, q));
      const bool is_positive = eigen.eigenvalues().minCoeff() > -1e-12 * body.e0.norm();
      EXPECT_TRUE(is_positive || !body.discontinuous[e]);
      n_indefinite += !is_positive;
    }
  }
  EXPECT_GT(n_indefinite, 0);  // elsewhere, so that the clipping is seen
}

TEST(MorphedStiffness, IsTheSameAfterTheZoneHasGrownAsIfItHadBeenThereFromTheStart) {
  CoupledBody body(hybrid(PeridynamicStiffness::kept, true));
  const auto before = body.elasticity;
  const Point2& corner = body.points.position(0);
  body.topology.grow({{0, 1, {corner[0], corner[1]}}});
  auto discontinuous = body.discontinuous;
  for (int e = 0; e < body.mesh.n_elements(); e += 3) discontinuous[e] = !discontinuous[e];
  operators::MorphedStiffness<2> afresh(body.e0, PeridynamicStiffness::kept);

  for (auto* elasticity : {&body.elasticity, &afresh}) {
    elasticity->update(body.mesh, body.points, body.bonds, body.alpha, body.classes, discontinuous);
  }

  int n_changed = 0;
  for (int e = 0; e < body.mesh.n_elements(); ++e) {
    for (int q = 0; q < body.points.count(e); ++q) {
      EXPECT_EQ(body.elasticity.at(e, q), afresh.at(e, q));
      n_changed += body.elasticity.at(e, q) != before.at(e, q);
    }
  }
  EXPECT_GT(n_changed, 0);
  EXPECT_LT(n_changed, body.points.size());
}

}  // namespace
}  // namespace perimorph::tests
