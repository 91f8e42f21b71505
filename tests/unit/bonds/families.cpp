// Bond families against brute force over all pairs of points, on 1, 2 and 4 ranks, and their growth.

#include <gtest/gtest.h>

#include <set>

#include "bonded_body.hpp"

namespace perimorph::tests {
namespace {

constexpr double horizon = 2.3, characteristic_length = 0.6;  // spacing 1: no pair of points is just a horizon apart

struct Example {
  const char* name;
  mesh::Mesh<2> whole;
  std::vector<Segment> pre_cracks;
};

mesh::Mesh<2> plate(double distortion = 0., bool triangles = false) {
  return grid({9, 8, 9., 8., Point2::Zero(), distortion, triangles});
}

bool in_hole(const Point2& x) { return (x - Point2(4.5, 4.5)).norm() < 1.2; }
bool in_notch(const Point2& x) { return x[0] < 4. && std::abs(x[1] - 4.5) < 0.5; }

std::vector<Example> examples() {
  const Segment oblique{Point2(-1., 2.1), Point2(5.3, 6.2)};
  return {{"Squares", plate(), {}},
          {"Distorted", plate(0.2), {}},
          {"Triangles", plate(0.15, true), {}},
          {"SquaresWithAHole", without(plate(), in_hole), {}},
          {"TrianglesWithAHole", without(plate(0.15, true), in_hole), {}},
          {"SquaresWithANotchOneElementWide", without(plate(), in_notch), {}},
          {"DistortedWithANotchOneElementWide", without(plate(0.15), in_notch), {}},
          {"SquaresWithAnObliquePreCrack", plate(), {oblique}}};
}

class BondFamilies : public testing::TestWithParam<Example> {
 protected:
  BondedBody body{GetParam().whole, horizon, characteristic_length, GetParam().pre_cracks};

  /// Elements of the whole that a rank's families must touch.
  std::vector<char> active() const {
    std::vector<char> is_active(body.whole.n_elements(), 0);
    for (int e = 0; e < body.mesh.n_elements(); ++e) is_active[body.mesh.element_ids[e]] = body.bonds.is_active(e);
    return is_active;
  }

  /// Elements of the whole where alpha > 0 at a point.
  std::vector<char> carrying(const Zone<2>& zone) const {
    std::vector<char> carries(body.whole.n_elements(), 0);
    for (const auto& p : plain_points(body.whole)) {
      if (zone.alpha(p.x, morphing::BlendingFunction::linear) > 0.) carries[p.element] = 1;
    }
    return carries;
  }

  void expect_plain_bonds(const std::vector<char>& carries) const {
    const auto is_active = active();
    const BondList expected =
        plain_bonds(body, [&](int e, int f) { return (is_active[e] || is_active[f]) && (carries[e] || carries[f]); });
    const BondList actual = body.list();
    EXPECT_EQ(actual.size(), body.bonds.n_bonds()) << "a bond is there twice";
    ASSERT_EQ(actual.size(), expected.size());
    for (auto a = actual.begin(), e = expected.begin(); a != actual.end(); ++a, ++e) {
      ASSERT_EQ(a->first, e->first);
      EXPECT_NEAR(a->second, e->second, 1e-7 * e->second);  // bonds are stored in single precision
    }
  }
};

TEST_P(BondFamilies, EverywhereAreAllVisiblePairsOfPoints) {
  body.grow({Zone<2>::everything()});

  expect_plain_bonds(std::vector<char>(body.whole.n_elements(), 1));
}

TEST_P(BondFamilies, InAZoneAreThoseOfWhichOneElementHasAlphaAboveZero) {
  const auto zone = Zone<2>::ball({5., 3.}, 1.5, 2.5);

  body.grow({zone});

  expect_plain_bonds(carrying(zone));
  EXPECT_GT(base::max(*body.comm, static_cast<GlobalId>(body.bonds.n_bonds())), 100);
}

TEST_P(BondFamilies, GrownInTwoStepsEqualThoseGrownAtOnce) {
  const std::vector<Zone<2>> zones = {Zone<2>::ball({3., 3.}, 1., 2.), Zone<2>::ball({5., 4.}, 1., 2.5)};
  BondedBody at_once(GetParam().whole, horizon, characteristic_length, GetParam().pre_cracks);
  at_once.grow(zones);

  body.grow({zones[0]});
  const BondList first = body.list();
  body.grow(zones);

  EXPECT_EQ(body.list(), at_once.list());
  EXPECT_EQ(body.bonds.n_bonds(), at_once.bonds.n_bonds());
  EXPECT_LT(base::sum(*body.comm, static_cast<GlobalId>(first.size())),
            base::sum(*body.comm, static_cast<GlobalId>(body.bonds.n_bonds())));
}

TEST_P(BondFamilies, KeepTheirBrokenBondsWhenTheyGrow) {
  body.grow({Zone<2>::ball({3., 3.}, 1., 2.)});
  std::set<std::pair<GlobalId, GlobalId>> broken;
  body.for_each_bond([&](int p, std::size_t b) {
    if (b % 7 != 0 || body.bonds.pair(p).first == body.bonds.pair(p).second) return;
    body.bonds.take({{b}});
    broken.insert(body.global_ends(p, b));
  });

  body.grow({Zone<2>::ball({5., 4.}, 1., 2.5)});

  body.for_each_bond(
      [&](int p, std::size_t b) { EXPECT_EQ(body.bonds.broken(b), broken.count(body.global_ends(p, b)) == 1); });
}

TEST_P(BondFamilies, HandOutEachBondOnceWithItsEndsItsVectorAndItsState) {
  body.grow({Zone<2>::everything()});
  const auto may_break = [](const bonds::Bond<2>& bond) {
    return bond.id % 3 == 0 && bond.first_element != bond.second_element;
  };
  body.bonds.for_each_bond([&](const bonds::Bond<2>& bond) {
    if (may_break(bond)) body.bonds.take({{bond.id}});
  });

  const BondList springs = body.list();
  std::size_t next = 0;
  body.bonds.for_each_bond([&](const bonds::Bond<2>& bond) {
    ASSERT_EQ(bond.id, next++);
    const int p = body.bonds.pair_of(bond.id);
    EXPECT_EQ(bond.first_element, body.bonds.pair(p).first);
    EXPECT_EQ(bond.second_element, body.bonds.pair(p).second);
    EXPECT_EQ(std::pair(bond.first_point, bond.second_point), body.ends(p, bond.id));
    EXPECT_EQ(body.points.global_id(bond.first_element, bond.first_end), body.global_ends(p, bond.id).first);
    EXPECT_EQ(body.points.global_id(bond.second_element, bond.second_end), body.global_ends(p, bond.id).second);
    EXPECT_EQ(bond.xi, body.points.position(bond.second_point) - body.points.position(bond.first_point));
    EXPECT_EQ(body.bonds.stiffness(bond), springs.at(body.global_ends(p, bond.id)));
    EXPECT_EQ(bond.is_broken, may_break(bond));
    EXPECT_EQ(body.bonds.bond(bond.id).second_point, bond.second_point);
  });
  EXPECT_EQ(next, body.bonds.n_bonds());
}

TEST_P(BondFamilies, ListTheElementWithTheLowerGlobalIdFirst) {
  body.grow({Zone<2>::everything()});

  for (int p = 0; p < body.bonds.n_pairs(); ++p) {
    EXPECT_LE(body.mesh.element_ids[body.bonds.pair(p).first], body.mesh.element_ids[body.bonds.pair(p).second]);
  }
}

TEST_P(BondFamilies, FindThePairsOfAnElementAndThePairOfABond) {
  body.grow({Zone<2>::everything()});

  std::vector<std::set<int>> pairs_of(body.mesh.n_elements());
  for (int p = 0; p < body.bonds.n_pairs(); ++p) {
    pairs_of[body.bonds.pair(p).first].insert(p);
    pairs_of[body.bonds.pair(p).second].insert(p);
  }
  for (int e = 0; e < body.mesh.n_elements(); ++e) {
    const auto& actual = body.bonds.pairs_of(e);
    EXPECT_EQ(std::set<int>(actual.begin(), actual.end()), pairs_of[e]);
    EXPECT_EQ(actual.size(), pairs_of[e].size());
  }
  body.for_each_bond([&](int p, std::size_t b) { EXPECT_EQ(body.bonds.pair_of(b), p); });
}

TEST_P(BondFamilies, KnowSmallestAndLargestAlphaOfEachNeighbourhood) {
  body.grow({Zone<2>::ball({4.5, 3.}, 1.5, 3.)});
  std::vector<double> smallest(body.points.size()), largest(body.points.size());
  for (int i = 0; i < body.points.size(); ++i) smallest[i] = largest[i] = body.alpha(i);
  body.for_each_bond([&](int p, std::size_t b) {
    const auto [i, j] = body.ends(p, b);
    smallest[i] = std::min(smallest[i], body.alpha(j));
    smallest[j] = std::min(smallest[j], body.alpha(i));
    largest[i] = std::max(largest[i], body.alpha(j));
    largest[j] = std::max(largest[j], body.alpha(i));
  });

  const auto extremes = body.bonds.neighbourhood_extremes(body.alpha);

  EXPECT_EQ(extremes.smallest, smallest);
  EXPECT_EQ(extremes.largest, largest);
}

INSTANTIATE_TEST_SUITE_P(Bodies, BondFamilies, testing::ValuesIn(examples()),
                         [](const auto& example) { return std::string(example.param.name); });

}  // namespace
}  // namespace perimorph::tests
