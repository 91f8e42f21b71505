// A bond that leaves the body or crosses a pre-crack does not exist; those around it do.

#include <gtest/gtest.h>

#include "bonded_body.hpp"

namespace perimorph::tests {
namespace {

constexpr double horizon = 3.05, characteristic_length = 0.6;  // spacing 1

struct Census {
  int across = 0;        ///< pairs within a horizon whose segment crosses the gap
  int bonds_across = 0;  ///< bonds among them
  int around = 0;        ///< other pairs with an end on either side of the gap's line
  int bonds_around = 0;
};

/// Counts pairs and bonds between points below and above the line y = height; those that cross it up to x = tip cross
/// the gap.
Census census(const BondedBody& body, double height, double tip) {
  const auto points = plain_points(body.whole);
  const BondList bonds = body.list();
  Census counts;
  for (const auto& below : points) {
    if (below.x[1] > height) continue;
    for (const auto& above : points) {
      if (above.x[1] < height || (above.x - below.x).norm() > horizon) continue;
      const double t = (height - below.x[1]) / (above.x[1] - below.x[1]);
      const bool crosses_gap = below.x[0] + t * (above.x[0] - below.x[0]) < tip + 1e-9;  // the tip itself counts
      const int exists = bonds.count({std::min(below.id, above.id), std::max(below.id, above.id)}) == 1;
      (crosses_gap ? counts.across : counts.around) += 1;
      (crosses_gap ? counts.bonds_across : counts.bonds_around) += exists;
    }
  }
  return counts;
}

BondedBody everywhere_bonded(const mesh::Mesh<2>& whole, const std::vector<Segment>& pre_cracks = {}) {
  return BondedBody(whole, horizon, characteristic_length, pre_cracks);
}

TEST(Visibility, NoBondCrossesASlitAlongElementSidesAndAllOthersExist) {
  mesh::Mesh<2> whole = grid({10, 8, 10., 8.});
  const std::vector<Segment> slit = {{Point2(0., 4.), Point2(5., 4.)}};
  ASSERT_EQ(mesh::open_along<2>(whole, slit), 5);
  BondedBody body = everywhere_bonded(whole, slit);

  body.grow({Zone<2>::everything()});

  const Census counts = census(body, 4., 5.);
  ASSERT_GT(counts.across, 100);
  ASSERT_GT(counts.around, 100);
  EXPECT_EQ(counts.bonds_across, 0);
  EXPECT_EQ(counts.bonds_around, counts.around);
}

TEST(Visibility, TheSidesOfAnOpenedSlitCutBondsWithoutThePreCrackToo) {
  mesh::Mesh<2> whole = grid({10, 8, 10., 8.});
  ASSERT_EQ(mesh::open_along<2>(whole, {{Point2(0., 4.), Point2(5., 4.)}}), 5);
  BondedBody body = everywhere_bonded(whole);

  body.grow({Zone<2>::everything()});

  EXPECT_EQ(census(body, 4., 5.).bonds_across, 0);
}

TEST(Visibility, APreCrackThroughElementsCutsTheBondsAcrossAndNoOthers) {
  // y = 4.1 runs between the Gauss points of a row of elements (at 0.211 and 0.789 of it), none of which lies on it.
  BondedBody body = everywhere_bonded(grid({10, 8, 10., 8.}), {{Point2(-1., 4.1), Point2(5.3, 4.1)}});

  body.grow({Zone<2>::everything()});

  const Census counts = census(body, 4.1, 5.3);
  ASSERT_GT(counts.across, 100);
  EXPECT_EQ(counts.bonds_across, 0);
  EXPECT_EQ(counts.bonds_around, counts.around);
}

TEST(Visibility, BondsInsideOneElementStayWhereAPreCrackCutsIt) {
  BondedBody body = everywhere_bonded(grid({10, 8, 10., 8.}), {{Point2(-1., 4.5), Point2(11., 4.5)}});

  body.grow({Zone<2>::everything()});

  for (int e = 0; e < body.mesh.n_elements(); ++e) {
    int inside = 0;
    for (const int p : body.bonds.pairs_of(e)) {
      const auto [first, second] = body.bonds.pair(p);
      if (first == second) inside = static_cast<int>(body.bonds.first_bond(p + 1) - body.bonds.first_bond(p));
    }
    EXPECT_EQ(inside, 6);  // all pairs of four points
  }
}

TEST(Visibility, NoBondCrossesANotchOneElementWideAndThoseAroundItsTipExist) {
  const auto in_notch = [](const Point2& x) { return x[0] < 5. && std::abs(x[1] - 4.5) < 0.5; };
  BondedBody body = everywhere_bonded(without(grid({10, 9, 10., 9.}), in_notch));

  body.grow({Zone<2>::everything()});

  // Bonds that pass the tip may be cut by its corners: here only the middle line of the notch counts as the gap.
  const Census counts = census(body, 4.5, 5.);
  ASSERT_GT(counts.across, 100);
  EXPECT_EQ(counts.bonds_across, 0);
  EXPECT_GT(counts.bonds_around, counts.around / 2);
  int straight_ahead = 0;  // just beyond the tip
  body.for_each_bond([&](int p, std::size_t b) {
    const auto [i, j] = body.ends(p, b);
    const auto &x = body.points.position(i), &y = body.points.position(j);
    straight_ahead += std::max(x[0], y[0]) < 6. && std::min(x[0], y[0]) > 5. && std::abs(y[1] - x[1]) > 1.;
  });
  EXPECT_GT(straight_ahead, 10);
}

TEST(Visibility, NoBondCrossesAHole) {
  // A square hole with an edge of 2, smaller than a horizon.
  const auto in_hole = [](const Point2& x) { return (x - Point2(5., 5.)).cwiseAbs().maxCoeff() < 1.; };
  BondedBody body = everywhere_bonded(without(grid({10, 10, 10., 10.}), in_hole));

  body.grow({Zone<2>::everything()});

  int longest_samples_inside = 0, over_the_corner = 0;
  body.for_each_bond([&](int p, std::size_t b) {
    const auto [i, j] = body.ends(p, b);
    const auto &x = body.points.position(i), &y = body.points.position(j);
    for (int s = 1; s < 50; ++s) longest_samples_inside += in_hole(x + s / 50. * (y - x));
    // Passes beside a corner of the hole, from the left of it to above it.
    over_the_corner += x[0] < 4. && x[1] < 6. && y[0] > 4. && y[1] > 6. && x[1] > 5.;
  });
  EXPECT_EQ(longest_samples_inside, 0);
  EXPECT_GT(over_the_corner, 10);
}

TEST(Visibility, ABondThroughTheTipOfACrackIsCut) {
  const std::vector<Segment> crack = {{Point2(0., 0.), Point2(1., 0.)}};

  EXPECT_TRUE(bonds::Visibility<2>::blocks(crack, {1., -1.}, {1., 1.}));
  EXPECT_TRUE(bonds::Visibility<2>::blocks(crack, {0.5, -1.}, {1.5, 1.}));
  EXPECT_FALSE(bonds::Visibility<2>::blocks(crack, {1. + 1e-6, -1.}, {1. + 1e-6, 1.}));
  EXPECT_FALSE(bonds::Visibility<2>::blocks(crack, {0.5, 1e-6}, {0.5, 1.}));
}

TEST(Visibility, ATriangleBlocksThatABondPiercesInSpace) {
  const std::vector<mesh::CrackFacet<3>> crack = {
      {base::Point<3>(0, 0, 0), base::Point<3>(1, 0, 0), base::Point<3>(0, 1, 0)}};
  const auto blocks = [&](double x, double y, double bottom, double top) {
    return bonds::Visibility<3>::blocks(crack, {x, y, bottom}, {x, y, top});
  };

  EXPECT_TRUE(blocks(0.3, 0.3, -1., 1.));
  EXPECT_FALSE(blocks(0.6, 0.6, -1., 1.));
  EXPECT_FALSE(blocks(0.3, 0.3, 0.1, 1.));
}

TEST(Visibility, RefusesACrackThatIsNowhere) {
  const mesh::Mesh<2> whole = grid({2, 2});
  const Segment nowhere{Point2(0., 0.), Point2(std::nan(""), 1.)};
  EXPECT_THROW(bonds::Visibility<2>(whole, {nowhere}), base::Bug);
  EXPECT_THROW(bonds::Visibility<2>(whole, {}).near({0., 0.}, -1.), base::Bug);
  EXPECT_THROW(bonds::Visibility<2>::among({}, {}), base::Bug);
}

}  // namespace
}  // namespace perimorph::tests
