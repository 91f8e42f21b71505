// Loads that turn: back to zero, reversed, repeated, let go, on bodies that are whole, cracked or in pieces.

#include <gmock/gmock.h>

#include "watched_run.hpp"

namespace perimorph::tests {
namespace {

const std::vector<mesh::CrackFacet<2>> one_notch = {{Point2(6., 0.), Point2(6., 2.)}},
                                       two_notches = {one_notch[0], {Point2(6., 4.), Point2(6., 6.)}};

/// A bar of squares of 1 with notches, held at its left edge and pulled at its right edge by the load factor.
Specimen notched_bar(double critical_stretch, const std::vector<mesh::CrackFacet<2>>& notches = one_notch) {
  Specimen specimen{grid({12, 6, 12., 6.}), 2., 0.2};
  specimen.pre_cracks = notches;
  mesh::open_along<2>(specimen.whole, specimen.pre_cracks);
  specimen.seeds = {Zone<2>::everything()};
  specimen.critical_stretch = critical_stretch;
  specimen.tolerance = 1e-7;
  specimen.displacements = {
      {"hold x", "left", 0, {0., 0.}}, {"hold y", "left", 1, {0., 0.}}, {"pull", "right", 0, {1., 0.}}};
  return specimen;
}

TEST(LoadProgramme, ACrackedBarGoesThroughZeroAndIsAsStiffInReverseAsBefore) {
  Specimen specimen = notched_bar(0.02);
  specimen.displacements.push_back({"guide", "right", 1, {0., 0.}});
  WatchedRun run(specimen, "right", 0);
  for (double load = 0.02; run.advance(load).broken == 0;) load += 0.002;
  const Row pulled = run.rows.back();
  ASSERT_GT(std::abs(pulled.force), 0.05 * run.largest_force());

  const double load = pulled.load_factor;
  for (const double share : {0.5, 0., -0.5, 0., 1.}) {
    const Row& now = run.advance(share * load);
    EXPECT_EQ(now.broken, pulled.broken);
    EXPECT_NEAR(now.force, share * pulled.force, 1e-5 * std::abs(pulled.force));
    EXPECT_NEAR(now.energies.elastic, share * share * pulled.energies.elastic, 1e-5 * pulled.energies.elastic);
  }
}

TEST(LoadProgramme, TheHalvesOfABarMoveThroughEachOtherAndApartWithoutForce) {
  WatchedRun run(notched_bar(0.02, two_notches), "right", 0);
  run.advance_to(0.5, 5);
  run.expect_severed();
  const auto broken = run.rows.back().broken;
  for (const double load : {0., -0.5, 0., 1.}) {
    run.advance_to(load, 2);
    run.expect_severed();
  }
  EXPECT_EQ(run.rows.back().broken, broken);
}

TEST(LoadProgramme, ABodyInWhichAllBondsBreakIsShakenToAndFro) {
  Specimen specimen = notched_bar(1e-6);
  for (const char* group : {"bottom", "top"}) {
    specimen.displacements.push_back({std::string("spread ") + group, group, 1, {group[0] == 't' ? 1. : -1., 0.}});
  }
  specimen.displacements.erase(specimen.displacements.begin() + 1);  // of y, which is spread at the corners
  WatchedRun run(specimen, "right", 0);
  for (const double load : {1., 0., -1., 1., 0.}) run.advance(load);
  EXPECT_GT(run.rows.back().broken, 1000);
  EXPECT_LE(std::abs(run.rows.back().force), 1e-6 * run.largest_force());
}

// ---- what is let go ----

TEST(LoadProgramme, APieceThatIsLetGoStaysWhereItIs) {
  Specimen specimen = notched_bar(0.02, two_notches);
  specimen.displacements.back().value = {0.1, 0., nullptr, 5.};
  specimen.is_proportional = false;
  WatchedRun run(specimen, "right", 0);
  for (int k = 1; k <= 5; ++k) run.advance(k);
  run.expect_severed();
  for (int k = 6; k <= 7; ++k) {
    run.advance(k);
    run.expect_severed();
  }
}

TEST(LoadProgramme, ABodyThatNothingHoldsAnyMoreComesToRest) {
  Specimen specimen = notched_bar(0.02);
  specimen.is_proportional = false;
  specimen.displacements.back().value.rate = 0.01;
  for (auto& one : specimen.displacements) one.value.end = 2.;
  WatchedRun run(specimen, "right", 0);
  run.advance_to(2., 2);
  const Row held = run.rows.back();
  ASSERT_GT(held.energies.elastic, 0.);

  run.advance_to(4., 2);
  EXPECT_LE(run.rows.back().energies.elastic, 1e-6 * held.energies.elastic);
  EXPECT_LE(run.rows.back().energies.external_work, 1e-4 * held.energies.elastic);
  EXPECT_EQ(run.rows.back().broken, 0);
}

// ---- a measure that turns ----

/// The notch's mouth is opened.
Specimen controlled_bar(double critical_stretch) {
  Specimen specimen = notched_bar(critical_stretch);
  specimen.displacements.push_back({"guide", "right", 1, {0., 0.}});
  specimen.control = model::MeasureControl<2>{{{"", Point2(7., 0.)}, {{"", Point2(5., 0.)}}, {1., 0.}}, {1., 0.}};
  return specimen;
}

TEST(MeasureControl, ACrackIsOpenedClosedReversedAndOpenedFurther) {
  SpecimenBody test(controlled_bar(0.02));
  double opening = 0.02;
  for (; test.body.counts().broken_bonds == 0; opening += 0.004) test.advance(opening);
  const double pulled = test.body.measured(), load = test.body.load_factor();
  const auto broken = test.body.counts().broken_bonds;
  const double elastic = test.body.energies().elastic;

  for (const double share : {0.5, 0., -0.5, 0., 1.}) {
    test.advance(share * pulled);
    EXPECT_NEAR(test.body.measured(), share * pulled, 1e-8 * pulled);
    EXPECT_NEAR(test.body.load_factor(), share * load, 1e-5 * load);
    EXPECT_NEAR(test.body.energies().elastic, share * share * elastic, 1e-5 * elastic);
  }
  EXPECT_EQ(test.body.counts().broken_bonds, broken);
  for (int k = 1; k <= 4; ++k) test.advance((1. + 0.3 * k) * pulled);
  EXPECT_GT(test.body.counts().broken_bonds, broken);
}

TEST(MeasureControl, OneLargeIncrementThatBreaksAllEndsInOrder) {
  SpecimenBody test(controlled_bar(1e-6));
  try {
    test.advance(1.);
  } catch (const fracture::UnfinishedIncrement& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("no load gives the measure"));
  }
  EXPECT_GT(test.body.counts().broken_bonds, 100);
  EXPECT_TRUE(std::isfinite(test.body.load_factor()));
  for (const double u : test.body.displacement()) ASSERT_TRUE(std::isfinite(u));
}

}  // namespace
}  // namespace perimorph::tests
