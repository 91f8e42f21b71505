// Bonds that soften: by how much, what they may take back, and what damage it is.

#include <gtest/gtest.h>

#include "bonded_body.hpp"

namespace perimorph::tests {
namespace {

using morphing::ElementClass;

const auto law = materials::BondLaw::softening(materials::Softening::bilinear, 0.01, 0.001);  // critical at 0.36

class Softening : public testing::Test {
 protected:
  BondedBody body{grid({7, 6, 7., 6., Point2::Zero(), 0.1}), 2.3, 0.6, {}, law};
  std::vector<ElementClass> classes = std::vector<ElementClass>(body.mesh.n_elements(), ElementClass::pd);

  void SetUp() override { body.grow({Zone<2>::everything()}); }

  /// All points displaced as by a uniform stretch.
  std::vector<Point2> widened(double stretch) const {
    std::vector<Point2> u;
    for (int i = 0; i < body.points.size(); ++i) u.emplace_back(stretch * body.points.position(i));
    return u;
  }
  std::vector<bonds::SoftenedBond> soften(double stretch, bool may_recover = false) {
    auto softened = body.bonds.softened(widened(stretch), classes, may_recover);
    body.bonds.take({{}, 0, 0., softened});
    return softened;
  }
  std::size_t a_bond_between_elements() const {
    std::size_t found = body.bonds.n_bonds();
    body.for_each_bond([&](int p, std::size_t b) {
      if (body.bonds.pair(p).first != body.bonds.pair(p).second) found = b;
    });
    return found;
  }
  double share_left(std::size_t b) const { return body.bonds.share_left(body.bonds.bond(b)); }
};

TEST_F(Softening, StartsAtTheLimitBetweenElements) {
  EXPECT_TRUE(soften(0.0099).empty());
  const auto softened = soften(0.05);
  std::size_t n_between = 0;
  body.for_each_bond([&](int p, std::size_t) { n_between += body.bonds.pair(p).first != body.bonds.pair(p).second; });
  EXPECT_EQ(softened.size(), n_between);
  const std::size_t b = a_bond_between_elements();
  EXPECT_NEAR(share_left(b), law.share_left(0.05), 1e-6);
  for (const auto& bond : softened) {
    EXPECT_NEAR(bond.largest_stretch, 0.05, 1e-6);
    EXPECT_NEAR(bond.loss, 1. - law.share_left(0.05), 1e-6);
  }
}

TEST_F(Softening, GrowsOnlyOnceAccepted) {
  soften(0.05);
  body.bonds.accept_softening();
  EXPECT_TRUE(soften(0.03).empty());
  EXPECT_TRUE(soften(0.03, true).empty());
  EXPECT_FALSE(soften(0.06).empty());
}

TEST_F(Softening, TakesBackWhatIsNotAcceptedByHalvesAndNoFurther) {
  const std::size_t b = a_bond_between_elements();
  soften(0.03);
  body.bonds.accept_softening();
  soften(0.05);
  const auto recovered = soften(0.02, true);
  ASSERT_FALSE(recovered.empty());
  EXPECT_LT(recovered[0].loss, 0.);
  EXPECT_NEAR(body.bonds.softening(b).largest, 0.04, 1e-6);
  for (int i = 0; i < 100; ++i) soften(0.02, true);
  EXPECT_NEAR(body.bonds.softening(b).largest, body.bonds.softening(b).accepted, 1e-8);
  EXPECT_TRUE(soften(0.02).empty());
}

TEST_F(Softening, GoesFurtherThanTheStretchWhereItMayRecover) {
  soften(0.05, true);
  const auto [accepted, largest] = body.bonds.softening(a_bond_between_elements());
  EXPECT_GT(largest, 0.05F);
  EXPECT_LT(largest, 0.08F);
  EXPECT_EQ(accepted, 0.F);
  soften(0.3599, true);
  EXPECT_LT(body.bonds.softening(a_bond_between_elements()).largest, law.critical_stretch());
}

TEST_F(Softening, LeavesBondsThatBreakToBreaking) {
  soften(0.05);
  EXPECT_TRUE(body.bonds.softened(widened(0.37), classes, false).empty());
  EXPECT_FALSE(body.break_overstretched(widened(0.37), classes).empty());
  const std::size_t b = a_bond_between_elements();
  EXPECT_NEAR(share_left(b), law.share_left(0.05), 1e-6);  // when it broke
  body.bonds.accept_softening();
  EXPECT_EQ(body.bonds.softening(b).accepted, static_cast<float>(law.critical_stretch()));
}

TEST_F(Softening, IsDamageByWhatItHasTaken) {
  soften(0.05);
  body.bonds.note_softening();
  const int element = body.bonds.bond(a_bond_between_elements()).first_element;
  EXPECT_TRUE(body.bonds.is_damaged(element));
  const int point = body.points.first(element);
  const double damage = body.bonds.damage(point);
  EXPECT_GT(damage, 0.5 * (1. - law.share_left(0.05)));  // bonds within the element do not soften
  EXPECT_LT(damage, 1. - law.share_left(0.05));
  body.bonds.recount_damage();
  EXPECT_NEAR(body.bonds.damage(point), damage, 1e-12);
  body.break_overstretched(widened(0.37), classes);
  const double broken = body.bonds.damage(point);
  body.bonds.recount_damage();
  EXPECT_NEAR(body.bonds.damage(point), broken, 1e-12);
}

TEST_F(Softening, IsRestoredFromItsHistories) {
  const std::size_t b = a_bond_between_elements();
  body.bonds.restore_softening({{b, {0.02F, 0.03F}}});
  EXPECT_NEAR(share_left(b), law.share_left(0.03), 1e-6);
  EXPECT_EQ(body.bonds.softening(b).accepted, 0.02F);
}

}  // namespace
}  // namespace perimorph::tests
