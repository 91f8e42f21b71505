// When bonds break (WHL19, eq. 6 and 7), which never do, and what damage they leave.

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "bonded_body.hpp"

namespace perimorph::tests {
namespace {

using morphing::ElementClass;

constexpr double critical_stretch = 0.02;

class Breaking : public testing::Test {
 protected:
  BondedBody body{grid({7, 6, 7., 6., Point2::Zero(), 0.1}), 2.3, 0.6, {}, critical_stretch};
  std::vector<ElementClass> classes = std::vector<ElementClass>(body.mesh.n_elements(), ElementClass::pd);

  void SetUp() override { body.grow({Zone<2>::everything()}); }

  /// Displacement of every point: (F - 1) x.
  std::vector<Point2> deformed(const Eigen::Matrix2d& gradient) const {
    std::vector<Point2> u;
    for (int i = 0; i < body.points.size(); ++i)
      u.emplace_back(gradient * body.points.position(i) - body.points.position(i));
    return u;
  }
  std::vector<Point2> widened(double stretch) const { return deformed((1. + stretch) * Eigen::Matrix2d::Identity()); }

  std::size_t n_between_elements() const {
    std::size_t n = 0;
    body.for_each_bond([&](int p, std::size_t) { n += body.bonds.pair(p).first != body.bonds.pair(p).second; });
    return n;
  }
};

TEST_F(Breaking, NoBondBreaksJustBelowTheCriticalStretch) {
  // 1e-9 of the stretch is far above the rounding of (1 + s)^2, 1e-16 / 0.02.
  EXPECT_TRUE(body.break_overstretched(widened(critical_stretch * (1. - 1e-9)), classes).empty());
}

TEST_F(Breaking, EveryBondBetweenElementsBreaksJustAboveTheCriticalStretch) {
  const auto broken = body.break_overstretched(widened(critical_stretch * (1. + 1e-9)), classes);

  EXPECT_EQ(broken.size(), n_between_elements());
  EXPECT_TRUE(std::is_sorted(broken.begin(), broken.end()));
}

TEST_F(Breaking, ThoseBreakWhoseDeformedLengthReachesTheCriticalOne) {
  Eigen::Matrix2d gradient;
  gradient << 1.03, 0.01, -0.02, 0.99;
  std::vector<std::size_t> expected;
  body.for_each_bond([&](int p, std::size_t b) {
    const auto [i, j] = body.ends(p, b);
    const Point2 xi = body.points.position(j) - body.points.position(i);
    const bool overstretched = (gradient * xi).norm() / xi.norm() - 1. >= critical_stretch;
    if (overstretched && body.bonds.pair(p).first != body.bonds.pair(p).second) expected.push_back(b);
  });
  ASSERT_GT(expected.size(), 100u);
  ASSERT_LT(expected.size(), n_between_elements() - 100u);

  EXPECT_EQ(body.break_overstretched(deformed(gradient), classes), expected);
}

TEST_F(Breaking, StretchesOverTheCriticalOneAreToldInOrderOfBondsAndBreakNothing) {
  Eigen::Matrix2d gradient;
  gradient << 1.03, 0.01, -0.02, 0.99;
  const auto stretches = body.bonds.overstretches(deformed(gradient), classes);

  const auto broken = body.break_overstretched(deformed(gradient), classes);

  ASSERT_EQ(stretches.size(), broken.size());
  std::size_t next = 0;
  body.for_each_bond([&](int p, std::size_t b) {
    if (next == broken.size() || b != broken[next]) return;
    const auto [i, j] = body.ends(p, b);
    const Point2 xi = body.points.position(j) - body.points.position(i);
    EXPECT_NEAR(stretches[next++], ((gradient * xi).norm() / xi.norm() - 1.) / critical_stretch, 1e-12);
  });
  EXPECT_EQ(next, broken.size());
}

TEST_F(Breaking, OfStretchesByCompressionOnlyAShareCounts) {
  const materials::BondLaw law = materials::BondLaw(critical_stretch).under({0.5, 0.3, 0.2});
  BondedBody other{grid({7, 6, 7., 6., Point2::Zero(), 0.1}), 2.3, 0.6, {}, law};
  other.grow({Zone<2>::everything()});
  Eigen::Matrix2d gradient;
  gradient << 1.03, 0.01, -0.02, 0.93;
  std::vector<double> dilatation;
  for (int i = 0; i < other.points.size(); ++i) dilatation.push_back(i % 3 == 0 ? 0.01 : -0.04);
  std::vector<std::size_t> expected;
  std::vector<double> ratios;
  other.for_each_bond([&](int p, std::size_t b) {
    const auto [i, j] = other.ends(p, b);
    const Point2 xi = other.points.position(j) - other.points.position(i);
    const double stretch = (gradient * xi).norm() / xi.norm() - 1.;
    const double by_compression = 0.3 * 0.5 * (dilatation[i] + dilatation[j]) - 0.2 * stretch;
    const double counted = stretch + 0.5 * std::min(0., by_compression);
    if (counted < critical_stretch || other.bonds.pair(p).first == other.bonds.pair(p).second) return;
    expected.push_back(b);
    ratios.push_back(counted / critical_stretch);
  });
  const auto by_stretch = body.bonds.overstretched(deformed(gradient), classes);
  ASSERT_GT(expected.size(), 50u);
  ASSERT_LT(expected.size(), by_stretch.size() - 50u);

  EXPECT_EQ(other.bonds.overstretched(deformed(gradient), classes, 1., {{}, dilatation}), expected);
  const auto found = other.bonds.overstretches(deformed(gradient), classes, 1., {{}, dilatation});
  ASSERT_EQ(found.size(), ratios.size());
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], ratios[k], 1e-12);
  EXPECT_THROW(other.bonds.overstretched(deformed(gradient), classes), base::Bug);  // without the dilatation
}

TEST_F(Breaking, WhatCountsIsTheStretchBeyondTheMeanEigenstrainOfBothEnds) {
  std::vector<double> eigenstrain;
  for (int i = 0; i < body.points.size(); ++i) eigenstrain.push_back(0.005 * body.points.position(i)[0] / 3.);
  const auto u = widened(critical_stretch + 0.004);
  std::vector<std::size_t> expected;
  std::vector<double> stretches;
  body.for_each_bond([&](int p, std::size_t b) {
    const auto [i, j] = body.ends(p, b);
    const double beyond = critical_stretch + 0.004 - 0.5 * (eigenstrain[i] + eigenstrain[j]);
    if (beyond < critical_stretch || body.bonds.pair(p).first == body.bonds.pair(p).second) return;
    expected.push_back(b);
    stretches.push_back(beyond / critical_stretch);
  });
  ASSERT_GT(expected.size(), 100u);
  ASSERT_LT(expected.size(), n_between_elements() - 100u);

  EXPECT_EQ(body.bonds.overstretched(u, classes, 1., {eigenstrain}), expected);
  const auto found = body.bonds.overstretches(u, classes, 1., {eigenstrain});
  ASSERT_EQ(found.size(), stretches.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], stretches[i], 1e-12);
  EXPECT_THROW(body.bonds.overstretched(u, classes, 1., {{0.}}), base::Bug);
}

TEST_F(Breaking, ARotationAndACompressionBreakNothing) {
  EXPECT_TRUE(body.break_overstretched(deformed(Eigen::Rotation2D<double>(0.7).toRotationMatrix()), classes).empty());
  EXPECT_TRUE(body.break_overstretched(widened(-0.5), classes).empty());
}

TEST_F(Breaking, ABrokenBondStaysBrokenAndIsReportedOnce) {
  const auto broken = body.break_overstretched(widened(0.03), classes);
  ASSERT_FALSE(broken.empty());

  EXPECT_TRUE(body.break_overstretched(widened(0.), classes).empty());
  EXPECT_TRUE(body.break_overstretched(widened(0.04), classes).empty());

  for (const auto b : broken) EXPECT_TRUE(body.bonds.broken(b));
}

TEST_F(Breaking, BondsInsideOneElementNeverBreak) {
  body.break_overstretched(widened(1.), classes);

  body.for_each_bond([&](int p, std::size_t b) {
    EXPECT_EQ(body.bonds.broken(b), body.bonds.pair(p).first != body.bonds.pair(p).second);
  });
}

TEST_F(Breaking, BondsThatTouchAnElementOutsideThePeridynamicClassNeverBreak) {
  for (std::size_t e = 0; e < classes.size(); e += 3) classes[e] = e % 2 == 0 ? ElementClass::morph : ElementClass::fe;

  const auto broken = body.break_overstretched(widened(1.), classes);

  ASSERT_FALSE(broken.empty());
  body.for_each_bond([&](int p, std::size_t b) {
    const auto [first, second] = body.bonds.pair(p);
    const bool may_break = first != second && classes[first] == ElementClass::pd && classes[second] == ElementClass::pd;
    EXPECT_EQ(body.bonds.broken(b), may_break);
  });
}

TEST_F(Breaking, DamageIsTheShareOfTheFamilysVolumeThatIsLost) {
  std::vector<double> family(body.points.size(), 0.), lost(body.points.size(), 0.);
  std::vector<char> is_damaged(body.mesh.n_elements(), 0);

  body.for_each_bond([&](int p, std::size_t b) {
    const auto [i, j] = body.ends(p, b);
    family[i] += body.points.weight(j);
    family[j] += body.points.weight(i);
    const auto [first, second] = body.bonds.pair(p);
    if (first == second || b % 5 != 0 || first > 20) return;
    body.bonds.take({{b}});
    lost[i] += body.points.weight(j);
    lost[j] += body.points.weight(i);
    is_damaged[first] = is_damaged[second] = 1;
  });

  for (int i = 0; i < body.points.size(); ++i) EXPECT_NEAR(body.bonds.damage(i), lost[i] / family[i], 1e-14);
  for (int e = 0; e < body.mesh.n_elements(); ++e) EXPECT_EQ(body.bonds.is_damaged(e), is_damaged[e] != 0);
}

TEST_F(Breaking, DamageIsZeroWhereNothingBrokeAndBelowOneWhereEverythingBetweenElementsDid) {
  EXPECT_EQ(body.bonds.damage(0), 0.);
  EXPECT_FALSE(body.bonds.is_damaged(0));

  body.break_overstretched(widened(1.), classes);

  for (int i = 0; i < body.points.size(); ++i) {
    EXPECT_GT(body.bonds.damage(i), 0.7);  // the element's own three other points hold it together
    EXPECT_LT(body.bonds.damage(i), 1.);
  }
}

TEST_F(Breaking, ABondBreaksOnceAndNeverWithinAnElement) {
  bonds::BondId within_an_element = 0, between_two = 0;
  body.bonds.for_each_bond([&](const bonds::Bond<2>& bond) {
    (bond.first_element == bond.second_element ? within_an_element : between_two) = bond.id;
  });

  body.bonds.take({{between_two}});

  EXPECT_THROW(body.bonds.take({{between_two}}), base::Bug);
  EXPECT_THROW(body.bonds.take({{within_an_element}}), base::Bug);
  EXPECT_THROW(body.bonds.take({{body.bonds.n_bonds()}}), base::Bug);
}

TEST_F(Breaking, RefusesFieldsThatAreNotOfThisMesh) {
  const auto u = widened(0.03);
  EXPECT_THROW(body.bonds.overstretched({u.begin(), u.end() - 1}, classes), base::Bug);
  EXPECT_THROW(body.bonds.overstretched(u, {ElementClass::pd}), base::Bug);
  EXPECT_THROW(body.bonds.overstretched(u, classes, -0.01), base::Bug);
  EXPECT_THROW(body.bonds.extend({body.mesh.n_elements()}), base::Bug);
  EXPECT_THROW(body.bonds.find(-1, 0, 0, 0), base::Bug);
}

TEST_F(Breaking, RefusesAModelWithoutAHorizonOrWithMarksOfAnotherMesh) {
  const auto make = [&](std::vector<char> active, const materials::Micromodulus& c0) {
    bonds::BondFamilies<2>(body.mesh, body.points, std::move(active), c0, {});
  };
  const std::vector<char> active(body.mesh.n_elements(), 1);
  EXPECT_NO_THROW(make(active, body.c0));
  EXPECT_THROW(make({1, 0}, body.c0), base::Bug);
  EXPECT_THROW(make(active, {100., 0.6, 0.}), base::Bug);
  EXPECT_THROW(make(active, {std::nan(""), 0.6, 2.}), base::Bug);
}

}  // namespace
}  // namespace perimorph::tests
