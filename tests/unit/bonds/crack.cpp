#include "perimorph/bonds/crack.hpp"

#include <gtest/gtest.h>

#include "bonded_body.hpp"

namespace perimorph::tests {
namespace {

using Side = bonds::OpenSide<2>;

/// A staircase from the origin: a step to the right for each step up or less, in sides of length 1.
std::vector<Side> staircase(int n_steps, int right, int up) {
  std::vector<Side> sides;
  Point2 x = Point2::Zero();
  const auto add = [&](const Point2& step) {
    const auto n = static_cast<GlobalId>(sides.size());
    sides.push_back({n, n + 1, 2, {{{x[0], x[1]}, {x[0] + step[0], x[1] + step[1]}}}});
    x += step;
  };
  for (int i = 0; i < n_steps; ++i) {
    for (int k = 0; k < right; ++k) add({1., 0.});
    for (int k = 0; k < up; ++k) add({0., 1.});
  }
  return sides;
}

TEST(CrackSize, OfAStraightCrackIsTheSumOfItsSides) {
  EXPECT_NEAR(bonds::crack_size(staircase(20, 1, 0), 3.), 20., 1e-12);
  EXPECT_NEAR(bonds::crack_size(staircase(1, 1, 0), 3.), 1., 1e-12);
  EXPECT_EQ(bonds::crack_size(std::vector<Side>(), 3.), 0.);
}

TEST(CrackSize, OfASlantingCrackIsThatOfTheLineAndNotOfItsStairs) {
  // Within a radius of three sides the mean line is slanted as the whole to some degrees; at the ends less so.
  EXPECT_NEAR(bonds::crack_size(staircase(20, 1, 1), 3.), std::hypot(20., 20.), 0.02 * std::hypot(20., 20.));
  EXPECT_NEAR(bonds::crack_size(staircase(20, 2, 1), 3.), std::hypot(40., 20.), 0.03 * std::hypot(40., 20.));
}

/// Along a circle around the origin, from its right to its top: up as long as the step stays within it, or else to the
/// left.
std::vector<Side> stairs_of_a_quarter(double radius) {
  std::vector<Side> sides;
  for (Point2 x(radius, 0.); x[0] > 0.;) {
    const auto n = static_cast<GlobalId>(sides.size());
    const Point2 up = x + Point2(0., 1.), left = x - Point2(1., 0.);
    const Point2 next = std::abs(up.norm() - radius) < std::abs(left.norm() - radius) ? up : left;
    sides.push_back({n, n + 1, 2, {{{x[0], x[1]}, {next[0], next[1]}}}});
    x = next;
  }
  return sides;
}

TEST(CrackSize, OfACurvedCrackIsThatOfTheCurve) {
  for (const double radius : {15., 20., 40.}) {
    const auto sides = stairs_of_a_quarter(radius);
    EXPECT_NEAR(static_cast<double>(sides.size()), 2. * radius, 1.);
    EXPECT_NEAR(bonds::crack_size(sides, 3.), 0.5 * M_PI * radius, 0.04 * 0.5 * M_PI * radius);
  }
}

TEST(CrackSize, OfTwoCracksFarApartIsTheirSum) {
  auto sides = staircase(10, 1, 0);
  for (auto side : staircase(10, 0, 1)) {
    for (auto& x : side.points) x[0] += 100.;
    sides.push_back(side);
  }
  EXPECT_NEAR(bonds::crack_size(sides, 3.), 20., 1e-12);
}

TEST(CrackSize, InThreeDimensionsIsAnArea) {
  using Side3 = bonds::OpenSide<3>;
  const Side3 square{0, 1, 4, {{{0., 0., 0.}, {2., 0., 0.}, {2., 3., 0.}, {0., 3., 0.}}}};
  const Side3 triangle{2, 3, 3, {{{2., 0., 0.}, {4., 0., 0.}, {2., 3., 0.}}}};
  EXPECT_NEAR(bonds::size(square), 6., 1e-13);
  EXPECT_NEAR(bonds::size(triangle), 3., 1e-13);
  EXPECT_NEAR(bonds::crack_size<3>({square, triangle}, 10.), 9., 1e-12);
}

/// Plate of 8 x 6 elements of size 1 with all its bonds.
class OpenSides : public testing::Test {
 protected:
  OpenSides() { body.grow({Zone<2>::everything()}); }

  /// Breaks bonds between different elements whose ends lie on two sides of the line y = 3.
  void break_across(double up_to_x) {
    body.for_each_bond([&](int p, std::size_t b) {
      const auto [i, j] = body.ends(p, b);
      const Point2 &x = body.points.position(i), &y = body.points.position(j);
      if ((x[1] < 3.) == (y[1] < 3.) || std::max(x[0], y[0]) > up_to_x || body.bonds.broken(b)) return;
      body.bonds.take({{b}});
    });
  }

  std::vector<Side> open() const { return base::gather_on_all(*body.comm, bonds::open_sides(body.mesh, body.bonds)); }

  BondedBody body{grid({8, 6, 8., 6.}), 2.5, 0.5};
};

TEST_F(OpenSides, AreNoneInAnIntactBody) { EXPECT_TRUE(open().empty()); }

TEST_F(OpenSides, AreThoseThatTheCrackRunsAlongAndEachIsThereOnce) {
  break_across(5.);
  auto sides = open();
  std::sort(sides.begin(), sides.end());
  ASSERT_EQ(sides.size(), 5u);
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(sides[i].first, 16 + i);  // third row of elements from below
    EXPECT_EQ(sides[i].second, 24 + i);
    EXPECT_EQ(sides[i].points[0][1], 3.);
    EXPECT_EQ(sides[i].points[1][1], 3.);
    EXPECT_NEAR(bonds::size(sides[i]), 1., 1e-13);
  }
  EXPECT_NEAR(bonds::crack_size(sides, 2.5), 5., 1e-12);
}

TEST_F(OpenSides, AreOpenOnlyWhenMoreThanHalfOfTheirBondsAreBroken) {
  break_across(4.5);  // of the fifth element's side only bonds between its points at x = 4.2
  EXPECT_EQ(open().size(), 4u);
}

}  // namespace
}  // namespace perimorph::tests
