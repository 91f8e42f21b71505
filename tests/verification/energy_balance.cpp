// What the loads do is stored, dissipated in broken bonds, or lost in jumps.

#include <gtest/gtest.h>

#include "support/fracture_body.hpp"

namespace perimorph::tests {
namespace {

using fracture::Energies;

/// A plate, 12 x 12, held at the bottom and pulled at the top.
Specimen plate(const mesh::Mesh<2>& whole) {
  Specimen specimen{whole, 3., 0.2};  // spacing 1
  specimen.displacements = {{"hold x", "bottom", 0, {0., 0.}}, {"hold y", "bottom", 1, {0., 0.}}};
  return specimen;
}

Specimen unbroken() {
  Specimen specimen = plate(grid({12, 12, 12., 12., Point2::Zero(), 0.1}));
  specimen.seeds = {Zone<2>::ball({6., 6.}, 3., 6.)};
  return specimen;
}

/// The solver leaves 1e-10 of the reactions as residual, the balance of some solutions a few times that, over the
/// condition number, some hundreds.
constexpr double rounding = 1e-7;

TEST(Energy, WorkOfPrescribedDisplacementsIsStoredInAnUnbrokenBody) {
  Specimen specimen = unbroken();
  specimen.displacements.push_back({"pull", "top", 1, {0.01, 0.}});
  SpecimenBody test(specimen);

  for (const double load : {1., 2., 5.}) {
    test.advance(load);
    const Energies energies = test.body.energies();
    EXPECT_GT(energies.elastic, 0.);
    EXPECT_NEAR(energies.external_work, energies.elastic, rounding * energies.elastic);
    EXPECT_EQ(energies.dissipated, 0.);
  }
}

TEST(Energy, WorkOfTractionsAndBodyForcesIsStoredInAnUnbrokenBody) {
  Specimen specimen = unbroken();
  specimen.tractions = {{"top", {Point2(0.5, 2.), Point2::Zero()}}, {"right", {Point2(-1., 0.2), Point2::Zero()}}};
  specimen.body_force_rate = Point2(0.1, -0.2);
  SpecimenBody test(specimen);

  for (const double load : {1., 2., 5.}) {
    test.advance(load);
    const Energies energies = test.body.energies();
    EXPECT_GT(energies.elastic, 0.);
    EXPECT_NEAR(energies.external_work, energies.elastic, rounding * energies.elastic);
  }
}

TEST(Energy, GrowsWithTheSquareOfAProportionalLoad) {
  Specimen specimen = unbroken();
  specimen.displacements.push_back({"pull", "top", 1, {0.01, 0.}});
  SpecimenBody test(specimen);
  test.advance(1.);
  const double once = test.body.energies().elastic;

  test.advance(3.);

  EXPECT_NEAR(test.body.energies().elastic, 9. * once, rounding * 9. * once);
}

TEST(Energy, AConstantPartOfTheLoadIsPartOfTheWork) {
  Specimen specimen = unbroken();
  specimen.is_proportional = false;
  specimen.displacements.push_back({"pull", "top", 1, {0.01, 0.05}});
  SpecimenBody test(specimen);

  for (const double load : {1., 2., -8.}) {
    test.advance(load);
    const Energies energies = test.body.energies();
    EXPECT_NEAR(energies.external_work, energies.elastic, rounding * energies.elastic);
  }
}

/// Everything is peridynamic, so that breaking bonds and splitting elements are the only changes: each of them can only
/// lower the energy at a given load.
Specimen breaking(DiscontinuousElements policy) {
  mesh::Mesh<2> whole = grid({12, 12, 12., 12.});
  const std::vector<mesh::CrackFacet<2>> slit = {{Point2(0., 6.), Point2(5., 6.)}};
  mesh::open_along<2>(whole, slit);
  whole.node_sets["lower corner"] = {0, 1, 2};
  whole.node_sets["upper corner"] = {156, 157, 158};
  Specimen specimen{whole, 3., 0.2};
  specimen.displacements = {{"hold x", "right", 0, {0., 0.}},
                            {"hold y", "right", 1, {0., 0.}},
                            {"pull down", "lower corner", 1, {-1., 0.}},
                            {"pull up", "upper corner", 1, {1., 0.}}};
  specimen.pre_cracks = slit;
  specimen.seeds = {Zone<2>::everything()};
  specimen.discontinuous = policy;
  specimen.critical_stretch = 0.08;
  return specimen;
}

class BrokenEnergy : public testing::TestWithParam<DiscontinuousElements> {};

TEST_P(BrokenEnergy, WorkIsStoredOrDissipatedOrLostAndNoneIsGained) {
  SpecimenBody test(breaking(GetParam()));
  double lost = 0., dissipated = 0.;

  for (const double load : {0.2, 0.6, 0.8, 1.}) {
    test.advance(load);
    const Energies energies = test.body.energies();
    const double jump_loss = energies.external_work - energies.elastic - energies.dissipated;
    EXPECT_GE(jump_loss, lost - rounding * energies.external_work);
    EXPECT_GE(energies.dissipated, dissipated);
    lost = jump_loss;
    dissipated = energies.dissipated;
  }

  EXPECT_GT(test.body.counts().broken_bonds, 100);
  EXPECT_GT(dissipated, 0.);
  EXPECT_GT(lost, 0.);  // bonds break in groups, and the body springs into its new equilibrium
}

TEST_P(BrokenEnergy, IsGivenBackToTheLastWhenUnloaded) {
  SpecimenBody test(breaking(GetParam()));
  test.advance(0.9);
  const Energies loaded = test.body.energies();
  ASSERT_GT(test.body.counts().broken_bonds, 10);

  test.advance(0.);
  const Energies unloaded = test.body.energies();

  EXPECT_LT(unloaded.elastic, rounding * loaded.elastic);
  EXPECT_EQ(unloaded.dissipated, loaded.dissipated);
  EXPECT_NEAR(unloaded.external_work, loaded.external_work - loaded.elastic, rounding * loaded.external_work);
}

TEST_P(BrokenEnergy, IsStoredAgainOnTheSamePathWhenReloaded) {
  SpecimenBody test(breaking(GetParam()));
  test.advance(0.9);
  const Energies loaded = test.body.energies();
  const auto broken = test.body.counts().broken_bonds;

  test.advance(0.4);
  test.advance(0.9);

  EXPECT_EQ(test.body.counts().broken_bonds, broken);
  EXPECT_NEAR(test.body.energies().elastic, loaded.elastic, rounding * loaded.elastic);
  EXPECT_NEAR(test.body.energies().external_work, loaded.external_work, rounding * loaded.external_work);
}

INSTANTIATE_TEST_SUITE_P(Policies, BrokenEnergy,
                         testing::Values(DiscontinuousElements::whole_zone, DiscontinuousElements::on_damage),
                         [](const auto& p) {
                           return p.param == DiscontinuousElements::whole_zone ? "WholeZone" : "OnDamage";
                         });

}  // namespace
}  // namespace perimorph::tests
