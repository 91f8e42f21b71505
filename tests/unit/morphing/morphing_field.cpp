#include "perimorph/morphing/morphing_field.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/meshes.hpp"

namespace perimorph::tests {
namespace {

using morphing::BlendingFunction;
using morphing::Zone;

constexpr double rounding = 1e-15;

TEST(Zone, LinearFunctionFallsEvenlyFromInnerToOuterRadius) {
  const auto zone = Zone<2>::ball({1., 2.}, 3., 5.);
  const auto at = [&](double r) { return zone.alpha({1. + 0.6 * r, 2. - 0.8 * r}, BlendingFunction::linear); };
  EXPECT_EQ(at(0.), 1.);
  EXPECT_EQ(at(2.999), 1.);
  EXPECT_NEAR(at(3.5), 0.75, rounding);
  EXPECT_NEAR(at(4.), 0.5, rounding);
  EXPECT_NEAR(at(4.9), 0.05, rounding);
  EXPECT_EQ(at(5.001), 0.);
}

TEST(Zone, CubicFunctionStartsAndEndsFlat) {
  const auto zone = Zone<2>::ball({0., 0.}, 1., 2.);
  const auto at = [&](double r) { return zone.alpha({r, 0.}, BlendingFunction::cubic); };
  EXPECT_NEAR(at(1.5), 0.5, rounding);
  EXPECT_NEAR(at(1.25), 1. - 3. / 16. + 2. / 64., rounding);
  EXPECT_NEAR(at(1.001), 1., 4e-6);  // 3 t^2
  EXPECT_NEAR(at(1.999), 0., 4e-6);
}

TEST(Zone, BoxFallsOverItsRimOnAllSides) {
  const auto zone = Zone<2>::box({0., 0.}, {4., 2.}, 2.);
  const auto at = [&](double x, double y) { return zone.alpha({x, y}, BlendingFunction::linear); };
  EXPECT_EQ(at(0.1, 1.9), 1.);
  EXPECT_NEAR(at(-1., 1.), 0.5, rounding);
  EXPECT_NEAR(at(5., 1.), 0.5, rounding);
  EXPECT_NEAR(at(2., 3.5), 0.25, rounding);
  EXPECT_NEAR(at(4.6, 2.8), 0.5, rounding);  // round corners: distance 1
  EXPECT_EQ(at(2., -2.), 0.);
}

TEST(Zone, EverythingIsOneEverywhere) {
  for (const auto function : {BlendingFunction::linear, BlendingFunction::cubic}) {
    EXPECT_EQ(Zone<2>::everything().alpha({1e6, -1e6}, function), 1.);
    EXPECT_EQ(Zone<3>::everything().alpha({0., 0., 1e9}, function), 1.);
  }
}

TEST(Zone, BallInSpaceIsRound) {
  const auto zone = Zone<3>::ball({0., 0., 0.}, 1., 3.);
  EXPECT_NEAR(zone.alpha({4. / 3., 4. / 3., 2. / 3.}, BlendingFunction::linear), 0.5, rounding);  // distance 2
}

TEST(Zone, CylinderFallsAroundItsAxisAndItsRoundEnds) {
  const auto zone = Zone<3>::cylinder({1., 0., 0.}, {1., 0., 10.}, 1., 3.);
  const auto at = [&](double x, double y, double z) { return zone.alpha({x, y, z}, BlendingFunction::linear); };
  EXPECT_EQ(at(1.6, 0.7, 5.), 1.);
  EXPECT_NEAR(at(1., 2., 0.), 0.5, rounding);
  EXPECT_NEAR(at(1., -2.5, 9.), 0.25, rounding);
  EXPECT_NEAR(at(1., 0., 12.), 0.5, rounding);
  EXPECT_NEAR(at(1., 1.2, -1.6), 0.5, rounding);
  EXPECT_EQ(at(4., 0.1, 5.), 0.);
}

class MorphingField : public testing::Test {
 protected:
  mesh::Mesh<2> mesh = grid({10, 8, 10., 8.});
  elements::MaterialPoints<2> points{mesh};
  morphing::MorphingField<2> alpha{mesh, points, BlendingFunction::linear};
  Zone<2> left = Zone<2>::ball({3., 4.}, 1., 4.), right = Zone<2>::ball({6., 4.}, 2., 3.);
};

TEST_F(MorphingField, IsZeroWithoutZones) {
  EXPECT_TRUE(alpha.add({}).empty());
  for (int p = 0; p < points.size(); ++p) EXPECT_EQ(alpha(p), 0.);
  for (int e = 0; e < mesh.n_elements(); ++e) EXPECT_FALSE(alpha.carries_bonds(e));
}

TEST_F(MorphingField, IsTheMaximumOverAllZonesAddedTogetherOrInTurn) {
  morphing::MorphingField<2> in_turn{mesh, points, BlendingFunction::linear};
  alpha.add({left, right});
  in_turn.add({right});
  in_turn.add({left});

  for (int p = 0; p < points.size(); ++p) {
    const auto& x = points.position(p);
    EXPECT_EQ(alpha(p), std::max(left.alpha(x, BlendingFunction::linear), right.alpha(x, BlendingFunction::linear)));
    EXPECT_EQ(in_turn(p), alpha(p));
  }
}

TEST_F(MorphingField, NeverFalls) {
  alpha.add({left, right});
  std::vector<double> before;
  for (int p = 0; p < points.size(); ++p) before.push_back(alpha(p));

  alpha.add({Zone<2>::ball({3., 4.}, 0.5, 1.), Zone<2>::ball({9., 7.}, 0.5, 3.)});

  for (int p = 0; p < points.size(); ++p) EXPECT_GE(alpha(p), before[p]);
}

TEST_F(MorphingField, NamesTheElementsWhereItRose) {
  alpha.add({left});

  const auto risen = alpha.add({left, right});

  std::vector<int> expected;
  for (int e = 0; e < mesh.n_elements(); ++e) {
    bool rises = false;
    for (int p = points.first(e); p < points.first(e + 1); ++p) {
      const auto& x = points.position(p);
      rises = rises || right.alpha(x, BlendingFunction::linear) > left.alpha(x, BlendingFunction::linear);
    }
    if (rises) expected.push_back(e);
  }
  EXPECT_EQ(risen, expected);
  EXPECT_THAT(risen, testing::SizeIs(testing::Gt(10u)));
  EXPECT_TRUE(alpha.add({left, right}).empty());
}

TEST_F(MorphingField, ElementsCarryBondsWhereItIsAboveZeroAtAPoint) {
  alpha.add({right});
  int n_carrying = 0;
  for (int e = 0; e < mesh.n_elements(); ++e) {
    bool above_zero = false;
    for (int p = points.first(e); p < points.first(e + 1); ++p) above_zero = above_zero || alpha(p) > 0.;
    EXPECT_EQ(alpha.carries_bonds(e), above_zero);
    n_carrying += above_zero;
  }
  EXPECT_GT(n_carrying, 20);
  EXPECT_LT(n_carrying, mesh.n_elements() - 20);
}

TEST(Zone, RefusesWhatIsNoZone) {
  EXPECT_THROW(Zone<2>::ball({0., 0.}, 2., 1.), base::Bug);
  EXPECT_THROW(Zone<2>::ball({0., 0.}, -1., 1.), base::Bug);
  EXPECT_THROW(Zone<2>::ball({std::nan(""), 0.}, 1., 2.), base::Bug);
  EXPECT_THROW(Zone<2>::box({1., 0.}, {0., 1.}, 1.), base::Bug);
  EXPECT_THROW(Zone<3>::cylinder({1., 2., 3.}, {1., 2., 3.}, 1., 2.), base::Bug);
}

TEST_F(MorphingField, RefusesPointsOfAnotherMesh) {
  const mesh::Mesh<2> smaller = grid({2, 2});
  EXPECT_THROW(morphing::MorphingField<2>(smaller, points, BlendingFunction::linear), base::Bug);
}

}  // namespace
}  // namespace perimorph::tests
