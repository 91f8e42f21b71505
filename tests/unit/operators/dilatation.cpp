// What the dilatation adds to bonds: the product against sums over bonds, on every number of ranks, and its
// definiteness.

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Teuchos_DefaultMpiComm.hpp>
#include <cmath>
#include <map>
#include <random>

#include "support/coupled_body.hpp"

namespace perimorph::tests {
namespace {

using bonds::StiffnessStorage;

/// Irregular elements and a zone; 11 x 9 elements, so that fours of elements stay incomplete.
Setup zone_in_the_middle(double poissons_ratio, StiffnessStorage kept = StiffnessStorage::stored,
                         bool triangles = false) {
  Setup setup{{11, 9, 11., 9., Point2::Zero(), 0.15, triangles}, 2.5, 0.5, {}};
  setup.zones = {morphing::Zone<2>::ball({5., 4.}, 3., 4.5)};
  setup.kept = kept;
  setup.poissons_ratio = poissons_ratio;
  return setup;
}

/// A wave in the body, at all local nodes.
std::vector<double> wave(const CoupledBody& body) {
  std::vector<double> u;
  for (int n = 0; n < body.dofs->n_nodes(); ++n) {
    const Point2& x = body.mesh.coordinates[body.dofs->reference_node(n)];
    u.push_back(0.01 * std::sin(1.3 * x[0] + 0.7 * x[1]));
    u.push_back(0.01 * std::cos(0.4 * x[0] - 1.1 * x[1]));
  }
  return u;
}

/// Of local elements and bonds, on owned nodes, by the node's id; all elements are continuous.
std::map<base::GlobalId, Point2> forces(const CoupledBody& body, const operators::ForceTerms<2>& terms) {
  const auto u = wave(body);
  std::vector<double> force(u.size(), 0.);
  for (const auto& term : terms) term->add_force(base::field(u), base::field(force));
  std::map<base::GlobalId, Point2> by_node;
  for (int n = 0; n < body.dofs->n_owned_nodes(); ++n) {
    by_node[body.mesh.node_ids[body.dofs->reference_node(n)]] = Eigen::Map<const Point2>(&force[2 * n]);
  }
  return by_node;
}

/// The same by sums over the bonds, term by term of the formulas; on one rank.
std::map<base::GlobalId, Point2> forces_by_formulas(const CoupledBody& body, double factor) {
  const auto u = wave(body);
  const auto at_points = operators::displacements_at_points(body.model(), base::field(u));
  std::vector<double> s(body.points.size(), 0.), m(body.points.size(), 0.);
  const auto mean_alpha = [&](const bonds::Bond<2>& bond) {
    return 0.5 * (body.alpha(bond.first_point) + body.alpha(bond.second_point));
  };
  const auto elongation = [&](const bonds::Bond<2>& bond) {
    return bond.xi.dot(at_points[bond.second_point] - at_points[bond.first_point]);
  };
  body.bonds.for_each_bond([&](const bonds::Bond<2>& bond) {
    if (bond.is_broken) return;
    const double c = body.bonds.stiffness(bond) * body.bonds.share_left(bond), squared = bond.xi.squaredNorm();
    for (const int point : {bond.first_point, bond.second_point}) {
      s[point] += c * mean_alpha(bond) * squared * elongation(bond);
      m[point] += c * squared * squared;
    }
  });
  std::vector<double> force(u.size(), 0.);
  operators::LocalForces<2>(body.model()).add_force(base::field(u), base::field(force));
  const auto add = [&](int element, int end, const Point2& at_point) {
    for (int k = 0; k < body.mesh.n_corners(element); ++k) {
      Eigen::Map<Point2>(&force[2 * body.dofs->nodes_of(element)[k]]) += body.points.shape(element, end)[k] * at_point;
    }
  };
  body.bonds.for_each_bond([&](const bonds::Bond<2>& bond) {
    if (bond.is_broken) return;
    const int i = bond.first_point, j = bond.second_point;
    const double g_s = factor * (s[i] / m[i] + s[j] / m[j]);
    const Point2 pull = body.model().spring(bond) * (elongation(bond) + bond.xi.squaredNorm() * g_s) * bond.xi;
    add(bond.first_element, bond.first_end, -pull);
    add(bond.second_element, bond.second_end, pull);
  });
  std::map<base::GlobalId, Point2> by_node;
  for (int n = 0; n < body.dofs->n_nodes(); ++n) {
    by_node[body.mesh.node_ids[body.dofs->reference_node(n)]] = Eigen::Map<const Point2>(&force[2 * n]);
  }
  return by_node;
}

operators::ForceTerms<2> terms_of(const CoupledBody& body) {
  return {Teuchos::rcp(new operators::LocalForces<2>(body.model())),
          Teuchos::rcp(new operators::BondForces<2>(body.model()))};
}

void expect_the_same(const std::map<base::GlobalId, Point2>& actual, const std::map<base::GlobalId, Point2>& expected) {
  double size = 0.;
  for (const auto& [node, force] : expected) size = std::max(size, force.norm());
  ASSERT_GT(size, 0.);
  for (const auto& [node, force] : actual) EXPECT_LT((force - expected.at(node)).norm(), 1e-6 * size) << node;
}

class Dilatation : public ::testing::TestWithParam<std::tuple<double, StiffnessStorage, bool>> {};

/// On its share of the body each rank has the forces that a single one has on the whole.
TEST_P(Dilatation, AddsWhatTheFormulasSay) {
  const tests::Setup setup = std::apply(zone_in_the_middle, GetParam());
  const double factor = materials::dilatational_ratio(CoupledBody::elastic_model, setup.poissons_ratio) / 4.;
  CoupledBody shared(setup), alone(setup, Teuchos::rcp(new Teuchos::MpiComm<int>(MPI_COMM_SELF)));
  const auto terms = terms_of(shared);
  expect_the_same(forces(shared, terms), forces_by_formulas(alone, factor));

  const auto change = shared.break_each(3);
  for (const auto& term : terms) term->take({change});
  alone.break_each(3);
  expect_the_same(forces(shared, terms), forces_by_formulas(alone, factor));
}

INSTANTIATE_TEST_SUITE_P(Ratios, Dilatation,
                         ::testing::Combine(::testing::Values(-0.2, 0.2, 0.45),
                                            ::testing::Values(StiffnessStorage::stored, StiffnessStorage::on_the_fly),
                                            ::testing::Bool()));

TEST(DilatationOfBonds, FollowsTheirSoftening) {
  tests::Setup setup = zone_in_the_middle(0.2);
  setup.law = soft_law();
  const double factor = materials::dilatational_ratio(CoupledBody::elastic_model, 0.2) / 4.;
  CoupledBody shared(setup), alone(setup, Teuchos::rcp(new Teuchos::MpiComm<int>(MPI_COMM_SELF)));
  const auto terms = terms_of(shared);
  for (const double share : {0.05, 0.2}) {
    const auto change = shared.soften_each(3, share);
    for (const auto& term : terms) term->take(change);
    alone.soften_each(3, share);
    expect_the_same(forces(shared, terms), forces_by_formulas(alone, factor));
  }
  expect_the_same(forces(shared, terms_of(shared)), forces_by_formulas(alone, factor));
}

TEST(DilatationOfBonds, IsNotThereWhereBondsAloneCarry) {
  const CoupledBody body(zone_in_the_middle(1. / 3.)), other(zone_in_the_middle(0.3));
  const operators::BondForces<2> bonds_alone(body.model()), with_volume(other.model());
  const auto u = wave(body);
  EXPECT_FALSE(body.model().has_dilatation());
  std::vector<double> force(u.size(), 0.);
  for (const auto* bonds : {&bonds_alone, &with_volume}) bonds->add_force(base::field(u), base::field(force));
  EXPECT_TRUE(bonds_alone.dilatational_stretch().empty());
  EXPECT_EQ(static_cast<int>(with_volume.dilatational_stretch().size()), other.points.size());
  EXPECT_LT(bonds_alone.bytes(), with_volume.bytes());
}

/// A patch without elements' stiffness, each element with nodes of its own, a share of the bonds between them broken.
Eigen::VectorXd eigenvalues(double poissons_ratio, double share_broken) {
  Setup setup{{6, 6, 6., 6.}, 3., 1. / 3., {morphing::Zone<2>::box({-9., -9.}, {15., 15.}, 1.)}};
  setup.whole_zone_discontinuous = true;
  setup.poissons_ratio = poissons_ratio;
  CoupledBody body(setup, Teuchos::rcp(new Teuchos::MpiComm<int>(MPI_COMM_SELF)));
  std::mt19937 random(1);
  std::vector<std::size_t> broken;
  body.bonds.for_each_bond([&](const bonds::Bond<2>& bond) {
    if (bond.first_element != bond.second_element && random() < share_broken * 4294967296.) broken.push_back(bond.id);
  });
  body.break_bonds(broken);

  const operators::BondForces<2> bonds(body.model());
  const int n = body.dofs->n_nodes() * 2;
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(n, n);
  for (int column = 0; column < n; ++column) {
    std::vector<double> unit(n, 0.), force(n, 0.);
    unit[column] = 1.;
    bonds.add_force(base::field(unit), base::field(force));
    k.col(column) = Eigen::Map<const Eigen::VectorXd>(force.data(), n);
  }
  EXPECT_LT((k - k.transpose()).cwiseAbs().maxCoeff(), 1e-12 * k.cwiseAbs().maxCoeff());
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k).eigenvalues();
}

/// Cracked or not, nothing but a rigid motion of the patch is free, and nothing gains energy.
TEST(DilatationOfBonds, LeavesTheStiffnessPositiveDefinite) {
  for (const double ratio : {-0.3, 0., 0.2, 1. / 3., 0.45}) {
    for (const double broken : {0., 0.5, 0.9}) {
      const Eigen::VectorXd values = eigenvalues(ratio, broken);
      EXPECT_LT(values.head(3).cwiseAbs().maxCoeff(), 1e-12 * values.maxCoeff()) << ratio << ", " << broken;
      EXPECT_GT(values[3], 1e-7 * CoupledBody::youngs_modulus) << ratio << ", " << broken;
    }
  }
}

/// Of a uniform strain the trace, at each point of each rank, also where bonds are missing or broken.
TEST(DilatationAtPoints, IsTheTraceOfAUniformIsotropicStrain) {
  CoupledBody body(zone_in_the_middle(1. / 3.));
  body.break_bonds(body.bonds_between([&](int first, int second) {
    return (mesh::centroid(body.mesh, first)[0] < 5.) != (mesh::centroid(body.mesh, second)[0] < 5.);
  }));
  std::vector<Point2> u;
  for (int i = 0; i < body.points.size(); ++i) u.push_back(0.01 * body.points.position(i));

  const auto dilatation = operators::dilatation_at_points(body.model(), {u}, body.topology.element_exchange());

  int n_bonded = 0;
  for (int e = 0; e < body.mesh.n_elements(); ++e) {
    if (body.bonds.pairs_of(e).empty()) continue;
    for (int i = body.points.first(e); i < body.points.first(e + 1); ++i, ++n_bonded)
      EXPECT_NEAR(dilatation[i], 0.02, 1e-12);
  }
  EXPECT_GT(n_bonded, 20);
}

}  // namespace
}  // namespace perimorph::tests
