// The stiffness without a matrix against the assembled one, on every number of ranks.

#include <gtest/gtest.h>

#include <cmath>

#include "support/coupled_body.hpp"

namespace perimorph::tests {
namespace {

using Vector = Tpetra::Vector<double>;

/// Irregular elements, a zone in the middle, a side held; 11 x 9 elements, so that fours of elements stay incomplete.
Setup held(bool discontinuous, bool triangles, bonds::StiffnessStorage kept, double stiffer = 1.) {
  Setup setup{{11, 9, 11., 9., Point2::Zero(), 0.15, triangles}, 2.5, 0.5, {}};
  setup.zones = {morphing::Zone<2>::ball({5., 4.}, 3., 4.5)};
  setup.whole_zone_discontinuous = discontinuous;
  setup.prescribed = {{"hold", "left", 0, {0., 0.}}, {"hold", "left", 1, {0., 0.}}};
  setup.kept = kept;
  setup.stiffer = stiffer;
  return setup;
}

class MatrixFreeTangent : public ::testing::TestWithParam<std::tuple<bool, bool, bonds::StiffnessStorage, double>> {
 protected:
  CoupledBody body{std::apply(held, GetParam())};
  operators::ForceTerms<2> terms = body.terms();
  operators::MatrixFreeTangent<2> matrix_free = body.tangent(terms);

  Vector wave() const {
    Vector x(body.dofs->owned_dofs());
    const auto values = x.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (std::size_t i = 0; i < x.getLocalLength(); ++i) {
      values(i, 0) = std::sin(1.7 * static_cast<double>(x.getMap()->getGlobalElement(static_cast<int>(i))));
    }
    return x;
  }

  void expect_the_same_product() const {
    const Vector x = wave();
    Vector expected(x.getMap()), actual(x.getMap());
    body.stiffness->matrix()->apply(x, expected);
    matrix_free.apply(x, actual);
    const double norm = expected.norm2();
    actual.update(-1., expected, 1.);
    EXPECT_LT(actual.norm2(), 1e-13 * norm);
  }

  /// Breaks some bonds between elements: the same on every rank.
  std::vector<std::size_t> break_some() {
    std::vector<std::size_t> broken;
    for (int p = 0; p < body.bonds.n_pairs(); ++p) {
      const auto [first, second] = body.bonds.pair(p);
      if (first == second || (body.mesh.element_ids[first] + body.mesh.element_ids[second]) % 3 != 0) continue;
      for (auto b = body.bonds.first_bond(p); b < body.bonds.first_bond(p + 1); ++b) {
        if ((body.bonds.first_end(b) + body.bonds.second_end(b)) % 2 == 0) continue;
        body.topology.take({{b}});
        broken.push_back(b);
      }
    }
    return broken;
  }
};

TEST_P(MatrixFreeTangent, AgreesWithTheMatrix) { expect_the_same_product(); }

TEST_P(MatrixFreeTangent, AgreesWithTheMatrixAfterBondsBreak) {
  const auto broken = break_some();
  body.stiffness->take({broken});
  for (const auto& term : terms) term->take({broken});
  expect_the_same_product();
}

TEST_P(MatrixFreeTangent, LeavesBrokenBondsOutWhenItIsMadeAnew) {
  const std::size_t bytes = matrix_free.bytes();
  body.stiffness->take({break_some()});
  const auto rebuilt = body.tangent(body.terms());
  if (body.bonds.computes_stiffness()) {
    EXPECT_LE(rebuilt.bytes(), bytes);  // a block is left out when all of its bonds are gone
  } else {
    EXPECT_LT(rebuilt.bytes(), bytes);
  }
  const Vector x = wave();
  Vector expected(x.getMap()), actual(x.getMap());
  body.stiffness->matrix()->apply(x, expected);
  rebuilt.apply(x, actual);
  const double norm = expected.norm2();
  actual.update(-1., expected, 1.);
  EXPECT_LT(actual.norm2(), 1e-13 * norm);
}

TEST_P(MatrixFreeTangent, AddsToAScaledVector) {
  const Vector x = wave();
  Vector product(x.getMap()), actual(x.getMap());
  matrix_free.apply(x, product);
  actual.putScalar(3.);
  matrix_free.apply(x, actual, Teuchos::NO_TRANS, -2., 0.5);
  const auto values = actual.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto products = product.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t i = 0; i < x.getLocalLength(); ++i) {
    EXPECT_NEAR(values(i, 0), 1.5 - 2. * products(i, 0), 1e-12 * (1. + std::abs(products(i, 0))));
  }
}

INSTANTIATE_TEST_SUITE_P(Meshes, MatrixFreeTangent,
                         ::testing::Combine(::testing::Bool(), ::testing::Bool(),
                                            ::testing::Values(bonds::StiffnessStorage::stored,
                                                              bonds::StiffnessStorage::on_the_fly),
                                            ::testing::Values(1., 5.)));

TEST(StiffnessOnTheFly, NeedsLessMemoryAndIsThatWhichIsStored) {
  const CoupledBody stored(held(false, false, bonds::StiffnessStorage::stored));
  const CoupledBody computed(held(false, false, bonds::StiffnessStorage::on_the_fly));
  const auto with_numbers = stored.tangent(stored.terms());
  const auto without = computed.tangent(computed.terms());
  ASSERT_EQ(stored.bonds.n_bonds(), computed.bonds.n_bonds());
  EXPECT_LE(computed.bonds.bytes() + 4 * stored.bonds.n_bonds(), stored.bonds.bytes());
  EXPECT_LT(without.bytes(), with_numbers.bytes() - 3 * stored.bonds.n_bonds());

  Vector x(stored.dofs->owned_dofs());
  x.randomize();
  Vector expected(x.getMap()), actual(x.getMap());
  with_numbers.apply(x, expected);
  without.apply(x, actual);
  const double norm = expected.norm2();
  actual.update(-1., expected, 1.);
  EXPECT_LT(actual.norm2(), 1e-6 * norm);  // single precision
  EXPECT_GT(norm, 0.);
}

}  // namespace
}  // namespace perimorph::tests
