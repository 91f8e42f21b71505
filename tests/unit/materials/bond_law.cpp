// The laws of bonds: what is left of their stiffness, and what they dissipate.

#include "perimorph/materials/bond_law.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "perimorph/base/errors.hpp"

namespace perimorph::materials {
namespace {

constexpr double limit = 2e-4, area = 1e-6;

class SofteningLaw : public testing::TestWithParam<Softening> {
 protected:
  BondLaw law = BondLaw::softening(GetParam(), limit, area);

  double force(double stretch) const { return law.share_left(stretch) * stretch; }
};

TEST_P(SofteningLaw, IsElasticUpToItsLimitAndHoldsNothingAtTheCriticalStretch) {
  EXPECT_TRUE(law.softens());
  EXPECT_EQ(law.limit(), limit);
  EXPECT_EQ(law.share_left(0.), 1.);
  EXPECT_EQ(law.share_left(limit), 1.);
  EXPECT_NEAR(force(limit * (1. + 1e-9)), limit, 1e-8 * limit);
  EXPECT_EQ(law.share_left(law.critical_stretch()), 0.);
  EXPECT_LE(force(law.critical_stretch() * (1. - 1e-9)), 1.001e-3 * limit);
  for (double s = limit; s < law.critical_stretch(); s *= 1.1) EXPECT_LT(law.share_left(1.1 * s), law.share_left(s));
}

TEST_P(SofteningLaw, HasTheAreaThatIsAskedFor) {
  constexpr int n = 400000;
  double sum = 0.;
  for (int i = 0; i < n; ++i) sum += force((i + 0.5) / n * law.critical_stretch()) / n * law.critical_stretch();
  EXPECT_NEAR(law.area(), area, 1e-12 * area);
  EXPECT_NEAR(sum, area, 1e-6 * area);
}

TEST_P(SofteningLaw, DissipatesWhatTheLossOfStiffnessTakes) {
  EXPECT_EQ(law.dissipation(0.), 0.);
  EXPECT_NEAR(law.dissipation(limit), 0., 1e-15 * area);
  EXPECT_NEAR(law.dissipation(law.critical_stretch()), area, 1e-12 * area);
  EXPECT_NEAR(law.dissipation(10. * law.critical_stretch()), area, 1e-12 * area);
  double sum = 0., before = limit;
  for (int i = 1; i <= 4000; ++i) {
    const double now = limit * std::pow(30., i / 4000.), mean = 0.5 * (before + now);
    sum += 0.5 * mean * mean * (law.share_left(before) - law.share_left(now));
    before = now;
  }
  EXPECT_NEAR(law.dissipation(before), sum, 1e-5 * sum);
}

TEST_P(SofteningLaw, ScalesItsStretchesAndItsAreaWithTheirSquare) {
  const BondLaw twice = law.scaled(2.);
  EXPECT_EQ(twice.softening(), GetParam());
  EXPECT_DOUBLE_EQ(twice.area(), 4. * area);
  EXPECT_DOUBLE_EQ(twice.share_left(6. * limit), law.share_left(3. * limit));
}

INSTANTIATE_TEST_SUITE_P(Curves, SofteningLaw, testing::Values(Softening::bilinear, Softening::exponential));

TEST(SofteningLaw, OfTwoLinesHasItsKinkAtAThird) {
  const BondLaw law = BondLaw::softening(Softening::bilinear, limit, area);
  const double kink = limit + 0.8 / 3.6 * (law.critical_stretch() - limit);
  EXPECT_NEAR(law.share_left(kink) * kink, limit / 3., 1e-12 * limit);
}

TEST(BrittleLaw, HoldsAllUpToTheCriticalStretchAndDissipatesItAtOnce) {
  const BondLaw law = 0.01;
  EXPECT_FALSE(law.softens());
  EXPECT_EQ(law.share_left(0.0099), 1.);
  EXPECT_EQ(law.share_left(0.01), 0.);
  EXPECT_NEAR(law.dissipation(0.0099), 0., 1e-18);
  EXPECT_DOUBLE_EQ(law.dissipation(0.02), 0.5e-4);
  EXPECT_DOUBLE_EQ(law.area(), 0.5e-4);
  EXPECT_TRUE(std::isinf(BondLaw().critical_stretch()));
}

TEST(BrittleLaw, CountsOfTheStretchByCompressionAShare) {
  const double nu = 0.2;
  const LateralCompression plane_stress{0.75, nu / (1. - nu * nu), nu / (1. + nu)};
  const BondLaw law = BondLaw(0.01).under(plane_stress);
  const auto counted = [&](double along, double across) {  // stresses over E
    const double stretch = along - nu * across, other = across - nu * along;
    return law.counted_stretch(stretch, stretch + other);
  };
  EXPECT_TRUE(law.sees_compression());
  EXPECT_DOUBLE_EQ(counted(0.01, 0.), 0.01);
  EXPECT_DOUBLE_EQ(counted(0.01, 0.02), 0.006);   // tension across counts in full
  EXPECT_DOUBLE_EQ(counted(0.01, -0.02), 0.011);  // compression by a quarter
  EXPECT_NEAR(counted(0., -0.2), 0.01, 1e-16);    // of a difference
  EXPECT_EQ(BondLaw(0.01).counted_stretch(0.01, -5.), 0.01);
  EXPECT_EQ(law.scaled(2.).counted_stretch(0.01, -5.), law.counted_stretch(0.01, -5.));
}

TEST(BondLaw, RefusesWhatNoBondCanBe) {
  EXPECT_THROW(BondLaw(-0.01), base::Bug);
  EXPECT_THROW(BondLaw::softening(Softening::bilinear, limit, 0.5 * limit * limit),
               base::Bug);  // that of a brittle one
  EXPECT_THROW(BondLaw::softening(Softening::none, limit, area), base::Bug);
  EXPECT_THROW(BondLaw(0.01).scaled(0.), base::Bug);
  EXPECT_THROW(BondLaw(0.01).under({1.01, 1., 1.}), base::Bug);
  EXPECT_THROW(BondLaw::softening(Softening::bilinear, limit, area).under({0.5, 1., 1.}), base::Bug);
}

}  // namespace
}  // namespace perimorph::materials
