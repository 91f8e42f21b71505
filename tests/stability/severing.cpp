// Bodies that part: the force goes to zero and the run goes on.

#include <gmock/gmock.h>

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

TEST_P(Severing, UnderATractionNoEquilibriumIsLeftAndTheFreePartIsTold) {
  Specimen specimen = bar(grid({12, 6, 12., 6.}), notches_at(6.), GetParam());
  specimen.displacements.pop_back();
  specimen.tractions = {{"right", {Point2(1., 0.), Point2::Zero()}}};
  SpecimenBody run(specimen);
  run.advance(0.1);
  const auto before = run.body.counts().broken_bonds;
  std::string message;
  try {
    run.advance(100.);
  } catch (const base::ComputationError& error) {
    message = error.what();
  }
  EXPECT_THAT(message, testing::StartsWith("no equilibrium exists: the part of "));
  EXPECT_THAT(message, testing::HasSubstr("is free, and a load of (600, "));  // 100 on an edge of 6
  EXPECT_EQ(before, 0);
  EXPECT_GT(run.body.counts().broken_bonds, 0);
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

TEST_P(Severing, ACrackRunsIntoAnotherAndOnFromItsEnds) {
  const std::vector<mesh::CrackFacet<2>> slits = {{Point2(6., 0.), Point2(6., 2.)}, {Point2(3., 4.), Point2(9., 4.)}};
  WatchedRun run(bar(grid({12, 8, 12., 8.}), slits, GetParam()), "right", 0);
  run.advance_to(0.8, 8);
  run.expect_severed();
}

TEST_P(Severing, ACrackRunsAcrossRanks) {
  // Along the bar, so that it meets every border between parts that lie beside each other.
  Specimen specimen = bar(grid({12, 6, 12., 6.}), {{Point2(0., 3.), Point2(3., 3.)}}, GetParam());
  specimen.displacements = {{"hold x", "bottom", 0, {0., 0.}},
                            {"hold y", "bottom", 1, {0., 0.}},
                            {"pull x", "top", 0, {0., 0.}},
                            {"pull y", "top", 1, {1., 0.}}};
  WatchedRun run(specimen, "top", 1);
  run.advance(0.01);
  run.advance_to(2., 4);
  run.expect_severed();
  const auto model = run.body().model();
  base::GlobalId between_ranks = 0;
  for (int p = 0; p < model.bonds.n_pairs(); ++p) {
    const auto [first, second] = model.bonds.pair(p);
    if (model.mesh.element_owners[first] == model.mesh.element_owners[second]) continue;
    for (auto b = model.bonds.first_bond(p); b < model.bonds.first_bond(p + 1); ++b) {
      between_ranks += model.bonds.broken(b);
    }
  }
  const base::GlobalId all = base::sum(run.comm(), between_ranks);
  if (run.comm().getSize() > 1) {
    EXPECT_GT(all, 20);
  } else {
    EXPECT_EQ(all, 0);
  }
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

TEST(LastBonds, OneAloneHoldsThePieceAndPullsAlongItself) {
  // The gap lets one bond through, from (5.2113, 4.2113) to (6.2113, 4.7887): points of 2 x 2 quadrature.
  Specimen specimen = bar(grid({12, 8, 12., 8.}), {}, DiscontinuousElements::whole_zone);
  specimen.pre_cracks = {{Point2(5.9, -1.), Point2(5.9, 4.606)}, {Point2(5.9, 4.612), Point2(5.9, 9.)}};
  specimen.horizon = 1.2;
  specimen.displacements.push_back({"hold the right end's y", "right", 1, {0., 0.}});
  WatchedRun run(specimen, "right", 0);
  const double force = run.advance(0.002).force;
  EXPECT_GT(force, 0.);
  EXPECT_NEAR(run.reaction("right", 1), force / std::sqrt(3.), 1e-4 * force);
  EXPECT_NEAR(run.advance(0.004).force, 2. * force, 1e-4 * force);
  EXPECT_EQ(run.rows.back().broken, 0);
  run.advance(0.1);
  run.expect_severed();
  EXPECT_EQ(run.rows.back().broken, 1);
  EXPECT_LE(std::abs(run.reaction("right", 1)), 1e-6 * run.largest_force());
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

TEST(WorstFirst, SparesBondsThatOthersRelieve) {
  const auto severed = [](double fraction) {
    Specimen specimen = bar(grid({12, 6, 12., 6.}), notches_at(6.), DiscontinuousElements::on_damage);
    specimen.breaking_fraction = fraction;
    WatchedRun run(specimen, "right", 0);
    run.advance(0.05);
    run.advance(0.5);
    run.expect_severed();
    return run.rows.back();
  };
  const Row all = severed(1.), half = severed(0.5), tenth = severed(0.1);
  EXPECT_LT(half.broken, all.broken);
  EXPECT_LE(tenth.broken, half.broken);
  EXPECT_GT(half.solves, all.solves);
  EXPECT_GT(tenth.solves, half.solves);
}

TEST(Reversal, BrokenStaysBrokenAndNothingIsGained) {
  Specimen specimen = bar(grid({12, 6, 12., 6.}), {{Point2(6., 0.), Point2(6., 2.)}}, DiscontinuousElements::on_damage);
  WatchedRun run(specimen, "right", 0);
  double load = 0.02;
  while (run.rows.empty() || run.rows.back().broken == 0) run.advance(load += 0.01);
  const Row cracked = run.rows.back();
  ASSERT_GT(cracked.force, 0.1 * run.largest_force());  // it has not parted
  EXPECT_EQ(run.body().overlap().depth, 0.);
  const Row unloaded = run.advance(0.);
  EXPECT_EQ(unloaded.broken, cracked.broken);
  EXPECT_LE(std::abs(unloaded.force), 1e-6 * run.largest_force());
  EXPECT_LE(unloaded.energies.elastic, 1e-6 * run.rows.front().energies.elastic);
  EXPECT_NEAR(unloaded.jump_loss(), cracked.jump_loss(), 1e-6 * cracked.energies.external_work);

  const Row compressed = run.advance(-load);
  EXPECT_EQ(compressed.broken, cracked.broken);
  EXPECT_NEAR(compressed.force, -cracked.force, 1e-6 * run.largest_force());  // no contact: the faces overlap
  const auto overlap = run.body().overlap();
  EXPECT_GT(overlap.depth, 0.1 * load);
  EXPECT_NEAR((overlap.place - Point2(6., 0.)).norm(), 0., 1e-12);  // most at the mouth
  EXPECT_NEAR(compressed.energies.elastic, cracked.energies.elastic, 1e-6 * run.rows.front().energies.elastic);

  const Row again = run.advance(load);
  EXPECT_EQ(again.broken, cracked.broken);
  EXPECT_NEAR(again.force, cracked.force, 1e-6 * run.largest_force());
  EXPECT_NEAR(again.energies.external_work, cracked.energies.external_work, 1e-5 * cracked.energies.external_work);
}

}  // namespace
}  // namespace perimorph::tests
