// Bodies that part: the force goes to zero and the run goes on.

#include "watched_run.hpp"

namespace perimorph::tests {
namespace {

/// A bar of squares of 1, held at its left edge and pulled at its right edge by the load factor.
Specimen bar(mesh::Mesh<2> whole, const std::vector<mesh::CrackFacet<2>>& cracks, DiscontinuousElements policy) {
  mesh::open_along<2>(whole, cracks);
  Specimen specimen{std::move(whole), 2., 0.2};
  specimen.seeds = {Zone<2>::everything()};
  specimen.pre_cracks = cracks;
  specimen.discontinuous = policy;
  specimen.critical_stretch = 0.02;
  specimen.tolerance = 1e-7;
  specimen.displacements = {
      {"hold x", "left", 0, {0., 0.}}, {"hold y", "left", 1, {0., 0.}}, {"pull", "right", 0, {1., 0.}}};
  return specimen;
}

/// Notches from both sides to a ligament of 2 at the middle of the height.
std::vector<mesh::CrackFacet<2>> notches_at(double x) {
  return {{Point2(x, 0.), Point2(x, 2.)}, {Point2(x, 4.), Point2(x, 6.)}};
}

class Severing : public testing::TestWithParam<DiscontinuousElements> {};

TEST_P(Severing, ABarBreaksInTwoAndTheRunGoesOn) {
  WatchedRun run(bar(grid({12, 6, 12., 6.}), notches_at(6.), GetParam()), "right", 0);
  run.advance_to(0.3, 6);
  run.expect_severed();
  const auto broken = run.rows.back().broken;
  run.advance_to(3., 3);
  run.expect_severed();
  EXPECT_EQ(run.rows.back().broken, broken);
}

TEST_P(Severing, OneLargeIncrementBreaksItToo) {
  WatchedRun run(bar(grid({12, 6, 12., 6.}), notches_at(6.), GetParam()), "right", 0);
  run.advance(0.05);
  run.advance(0.5);
  run.expect_severed();
  EXPECT_GT(run.rows.back().broken, 100);  // snap-back
}

TEST_P(Severing, TrianglesDoAsWell) {
  WatchedRun run(bar(grid({12, 6, 12., 6., Point2::Zero(), 0., true}), notches_at(6.), GetParam()), "right", 0);
  run.advance_to(0.4, 4);
  run.expect_severed();
}

TEST_P(Severing, ACrackRunsIntoAHoleAndOutOfIt) {
  const auto in_hole = [](const Point2& c) { return std::abs(c[0] - 6.) < 1. && std::abs(c[1] - 4.) < 1.; };
  Specimen specimen = bar(without(grid({12, 8, 12., 8.}), in_hole), {{Point2(6., 0.), Point2(6., 1.)}}, GetParam());
  WatchedRun run(specimen, "right", 0);
  run.advance_to(0.6, 6);
  run.expect_severed();
}

TEST_P(Severing, AClusterBetweenTwoBreaksFloats) {
  auto cracks = notches_at(5.);
  for (const auto& facet : notches_at(9.)) cracks.push_back(facet);
  Specimen specimen = bar(grid({14, 6, 14., 6.}), cracks, GetParam());
  WatchedRun run(specimen, "right", 0);
  run.advance(0.05);
  run.advance(2.);
  run.expect_severed();
  run.advance(4.);
  run.expect_severed();
}

TEST_P(Severing, APinnedPieceMayRotate) {
  Specimen specimen = bar(grid({12, 6, 12., 6.}), notches_at(6.), GetParam());
  specimen.whole.node_sets["pin"] = {};
  for (int n = 0; n < specimen.whole.n_nodes(); ++n) {
    if ((specimen.whole.coordinates[n] - Point2(12., 1.)).norm() < 1e-9) specimen.whole.node_sets["pin"] = {n};
  }
  specimen.displacements[2].node_set = "pin";  // the other edge is free
  WatchedRun run(specimen, "pin", 0);
  run.advance_to(2., 8);
  run.expect_severed();
  run.advance(2.5);
  run.expect_severed();
}

INSTANTIATE_TEST_SUITE_P(Policies, Severing,
                         testing::Values(DiscontinuousElements::on_damage, DiscontinuousElements::whole_zone),
                         [](const auto& policy) {
                           return policy.param == DiscontinuousElements::on_damage ? "OnDamage" : "WholeZone";
                         });

TEST(LastBonds, HoldThePieceUntilTheyBreak) {
  // A slit with a gap of 0.02 through which two bonds pass, crossing each other: they hold and the piece can rotate.
  Specimen specimen = bar(grid({12, 8, 12., 8.}), {}, DiscontinuousElements::whole_zone);
  specimen.pre_cracks = {{Point2(6., -1.), Point2(6., 4.112)}, {Point2(6., 4.132), Point2(6., 9.)}};
  specimen.horizon = 1.2;
  WatchedRun run(specimen, "right", 0);
  EXPECT_GT(run.advance(0.002).force, 0.);
  EXPECT_EQ(run.rows.back().broken, 0);
  run.advance(0.1);
  run.expect_severed();
  EXPECT_EQ(run.rows.back().broken, 2);
}

TEST(SingleElement, BetweenTwoOthersFloatsFree) {
  Specimen specimen = bar(grid({3, 1, 3., 1.}), {}, DiscontinuousElements::on_damage);
  WatchedRun run(specimen, "right", 0);
  run.advance(0.02);
  EXPECT_EQ(run.rows.back().broken, 0);
  run.advance(1.);
  run.expect_severed();
  run.advance(2.);
  run.expect_severed();
  EXPECT_EQ(run.body().counts().dgfe_elements, 3);
}

TEST(Reversal, BrokenStaysBrokenAndNothingIsGained) {
  Specimen specimen = bar(grid({12, 6, 12., 6.}), {{Point2(6., 0.), Point2(6., 2.)}}, DiscontinuousElements::on_damage);
  WatchedRun run(specimen, "right", 0);
  double load = 0.02;
  while (run.rows.empty() || run.rows.back().broken == 0) run.advance(load += 0.01);
  const Row cracked = run.rows.back();
  ASSERT_GT(cracked.force, 0.1 * run.largest_force());  // it has not parted
  const Row unloaded = run.advance(0.);
  EXPECT_EQ(unloaded.broken, cracked.broken);
  EXPECT_LE(std::abs(unloaded.force), 1e-6 * run.largest_force());
  EXPECT_LE(unloaded.energies.elastic, 1e-6 * run.rows.front().energies.elastic);
  EXPECT_NEAR(unloaded.jump_loss(), cracked.jump_loss(), 1e-6 * cracked.energies.external_work);

  const Row compressed = run.advance(-load);
  EXPECT_EQ(compressed.broken, cracked.broken);
  EXPECT_NEAR(compressed.force, -cracked.force, 1e-6 * run.largest_force());  // no contact: the faces overlap
  EXPECT_NEAR(compressed.energies.elastic, cracked.energies.elastic, 1e-6 * run.rows.front().energies.elastic);

  const Row again = run.advance(load);
  EXPECT_EQ(again.broken, cracked.broken);
  EXPECT_NEAR(again.force, cracked.force, 1e-6 * run.largest_force());
  EXPECT_NEAR(again.energies.external_work, cracked.energies.external_work, 1e-5 * cracked.energies.external_work);
}

}  // namespace
}  // namespace perimorph::tests
