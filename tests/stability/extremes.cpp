// Zones, horizons, meshes and material values at the ends of what is possible.

#include <gmock/gmock.h>

#include "perimorph/base/errors.hpp"
#include "watched_run.hpp"

namespace perimorph::tests {
namespace {

/// A plate of width 12 and height 8 with a slit from its left edge to the middle; its lower and upper edge are pulled
/// apart by the load factor.
Specimen plate(mesh::Mesh<2> whole) {
  const std::vector<mesh::CrackFacet<2>> slit = {{Point2(0., 4.), Point2(6., 4.)}};
  mesh::open_along<2>(whole, slit);
  Specimen specimen{std::move(whole), 2., 0.2};
  specimen.pre_cracks = slit;
  specimen.seeds = {Zone<2>::ball({6., 4.}, 5., 7.)};
  specimen.critical_stretch = 0.02;
  specimen.tolerance = 1e-7;
  specimen.displacements = {{"hold x", "bottom", 0, {0., 0.}},
                            {"hold y", "bottom", 1, {0., 0.}},
                            {"pull x", "top", 0, {0., 0.}},
                            {"pull y", "top", 1, {1., 0.}}};
  return specimen;
}

const Grid squares{12, 8, 12., 8.};

TEST(Extremes, ATinyCriticalStretchBreaksAllThatIsStretchedAtOnce) {
  Specimen specimen = plate(grid(squares));
  specimen.critical_stretch = 1e-9;
  specimen.seeds = {Zone<2>::everything()};
  WatchedRun run(specimen, "top", 1);
  run.advance(0.01);
  run.advance(0.02);
  EXPECT_LE(std::abs(run.rows.back().force), 1e-6 * 1000. * 0.01);  // E times the strain times the width is 15
  EXPECT_GT(run.rows.back().broken, 1000);
}

TEST(Extremes, AHugeCriticalStretchBreaksNothing) {
  Specimen unbreakable = plate(grid(squares)), huge = unbreakable;
  unbreakable.critical_stretch = std::numeric_limits<double>::infinity();
  for (const double stretch : {1e3, 1e200}) {
    huge.critical_stretch = stretch;
    WatchedRun run(huge, "top", 1), other(unbreakable, "top", 1);
    run.advance(1.);
    other.advance(1.);
    EXPECT_EQ(run.rows.back().broken, 0);
    EXPECT_EQ(run.rows.back().force, other.rows.back().force);
  }
}

TEST(Extremes, ALoadFarBeyondFailureBreaksEverythingThatCanBreak) {
  for (const auto policy : {DiscontinuousElements::on_damage, DiscontinuousElements::whole_zone}) {
    Specimen specimen = plate(grid(squares));
    specimen.seeds = {Zone<2>::everything()};
    specimen.discontinuous = policy;
    WatchedRun run(specimen, "top", 1);
    run.advance(1e4);
    EXPECT_LE(std::abs(run.rows.back().force), 1e-6 * 1000. * 1e4);
    EXPECT_GT(run.rows.back().broken, 1000);
    run.advance(1e5);
  }
}

base::GlobalId n_not_peridynamic(const WatchedRun& run) {
  base::GlobalId n = 0;
  for (int e = 0; e < run.body().mesh().n_owned_elements; ++e) {
    n += run.body().topology().classes()[e] != morphing::ElementClass::pd;
  }
  return base::sum(run.comm(), n);
}

TEST(Extremes, AZoneGrowsOverTheWholeBody) {
  Specimen specimen = plate(grid({7, 8, 7., 8., Point2(3., 0.)}));
  specimen.horizon = 3.;
  specimen.seeds = {Zone<2>::ball({6., 4.}, 4.5, 5.)};
  WatchedRun run(specimen, "top", 1);
  run.advance(0.01);
  EXPECT_GT(n_not_peridynamic(run), 30);
  run.advance_to(2., 4);
  run.expect_severed();
  EXPECT_EQ(n_not_peridynamic(run), 0);
}

TEST(Extremes, TwoZonesMerge) {
  // Cracks from both sides, each with its zone, meet in the middle.
  mesh::Mesh<2> whole = grid({16, 8, 16., 8.});
  const std::vector<mesh::CrackFacet<2>> slits = {{Point2(0., 4.), Point2(4., 4.)}, {Point2(12., 4.), Point2(16., 4.)}};
  Specimen specimen = plate(grid(squares));
  mesh::open_along<2>(whole, slits);
  specimen.whole = whole;
  specimen.pre_cracks = slits;
  specimen.seeds = {Zone<2>::ball({4., 4.}, 4., 5.), Zone<2>::ball({12., 4.}, 4., 5.)};
  WatchedRun run(specimen, "top", 1);
  run.advance(0.01);
  run.advance_to(1., 5);
  run.expect_severed();
}

TEST(Extremes, ASeedOutsideTheBodyLeavesItClassical) {
  Specimen specimen = plate(grid(squares)), classical = specimen;
  specimen.seeds = {Zone<2>::ball({100., 100.}, 5., 7.)};
  classical.seeds = {};
  WatchedRun run(specimen, "top", 1), other(classical, "top", 1);
  run.advance(1.);
  other.advance(1.);
  EXPECT_EQ(run.rows.back().broken, 0);
  EXPECT_EQ(run.rows.back().force, other.rows.back().force);
}

TEST(Extremes, AHorizonSmallerThanTheElementsEndsInOrder) {
  const auto with = [](double horizon) {
    Specimen specimen = plate(grid(squares));
    specimen.horizon = horizon;
    return specimen;
  };
  WatchedRun without_bonds(with(0.4), "top", 1);
  without_bonds.advance(0.05);
  EXPECT_GT(without_bonds.advance(2.).force, 0.);  // around the zone, which carries nothing
  EXPECT_EQ(without_bonds.rows.back().broken, 0);

  WatchedRun to_nearest_neighbours(with(0.7), "top", 1);
  to_nearest_neighbours.advance(0.05);
  to_nearest_neighbours.advance(2.);
  EXPECT_GT(to_nearest_neighbours.rows.back().broken, 0);

  // Bonds across edges only leave mechanisms: a solution, or exit status 3.
  WatchedRun across_edges(with(0.5), "top", 1);
  try {
    across_edges.advance(0.05);
    across_edges.advance(2.);
  } catch (const base::ComputationError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("conjugate gradients"));
  }
}

TEST(Extremes, ARimNarrowerThanTheHorizonPartsAsAWideOneDoes) {
  for (const double rim : {0.2, 1., 4.}) {
    Specimen specimen = plate(grid(squares));
    specimen.seeds = {Zone<2>::ball({6., 4.}, 3., 3. + rim)};
    WatchedRun run(specimen, "top", 1);
    run.advance(0.01);
    EXPECT_EQ(run.rows.back().broken, 0);
    run.advance_to(2., 4);
    run.expect_severed();
  }
}

TEST(Extremes, AToleranceBeyondRoundingEndsInOrder) {
  Specimen specimen = plate(grid(squares));
  specimen.tolerance = 1e-20;
  WatchedRun run(specimen, "top", 1);
  try {
    run.advance(0.01);
    FAIL() << "no error";
  } catch (const base::ComputationError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("the forces do not balance"));
  }
}

TEST(Extremes, AHorizonLargerThanTheBodyTerminates) {
  Specimen specimen = plate(grid(squares));
  specimen.horizon = 50.;
  specimen.seeds = {Zone<2>::everything()};
  WatchedRun run(specimen, "top", 1);
  EXPECT_GT(run.advance(0.01).force, 0.);
  EXPECT_EQ(run.rows.back().broken, 0);
  run.advance(5.);
  run.expect_severed();
}

TEST(Extremes, SliversOfAspectFifty) {
  Specimen specimen = plate(grid({4, 20, 8., 0.8, Point2(2., 3.6)}));  // 2 by 0.04
  specimen.horizon = 5.;
  specimen.characteristic_length = 0.5;
  specimen.seeds = {Zone<2>::everything()};
  WatchedRun run(specimen, "top", 1);
  EXPECT_GT(run.advance(1e-4).force, 0.);
  EXPECT_EQ(run.rows.back().broken, 0);
  // All 20 rows part by as much, and bonds along them, up to 5 long, stretch by 0.02 only when a row is 1 away.
  run.advance_to(40., 4);
  EXPECT_GT(run.rows.back().broken, 1000);
  // Not expect_severed(): what the solver leaves relates to a first guess that strains one row by all of an increment.
  EXPECT_LE(std::abs(run.rows.back().force), 1e-3 * run.largest_force());
}

/// Spacings that grow from one end to the other by a factor of 20 in all.
mesh::Mesh<2> graded() {
  mesh::Mesh<2> whole = grid({24, 8, 1., 8.});
  const double ratio = std::pow(20., 1. / 23.);
  for (auto& x : whole.coordinates) x[0] = 12. * (std::pow(ratio, 24. * x[0]) - 1.) / (std::pow(ratio, 24.) - 1.);
  return whole;
}

TEST(Extremes, AMeshGradedByTwenty) {
  Specimen specimen = plate(graded());
  WatchedRun run(specimen, "top", 1);
  EXPECT_GT(run.advance(0.01).force, 0.);
  run.advance_to(2., 4);
  run.expect_severed();
}

TEST(Extremes, TrianglesBreakInTwo) {
  WatchedRun run(plate(grid({12, 8, 12., 8., Point2::Zero(), 0.15, true})), "top", 1);
  run.advance(0.01);
  run.advance_to(2., 4);
  run.expect_severed();
}

TEST(Extremes, NoLoadBreaksNothing) {
  WatchedRun run(plate(grid(squares)), "top", 1);
  run.advance(0.);
  EXPECT_EQ(run.rows.back().broken, 0);
  EXPECT_EQ(run.rows.back().energies.elastic, 0.);
}

}  // namespace
}  // namespace perimorph::tests
