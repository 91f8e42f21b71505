// Cracks that close: parts that are pressed together, rubble, and the way back.

#include <gmock/gmock.h>

#include "watched_run.hpp"

namespace perimorph::tests {
namespace {

using discretization::CrackFaces;

/// A bar, 12 x 6, held at its left edge and moved along at its right edge by the load factor; its faces touch.
Specimen bar(const std::vector<mesh::CrackFacet<2>>& cracks, double friction) {
  auto whole = grid({12, 6, 12., 6.});
  mesh::open_along<2>(whole, cracks);
  Specimen specimen{std::move(whole), 2., 0.2};
  specimen.seeds = {Zone<2>::everything()};
  specimen.pre_cracks = cracks;
  specimen.critical_stretch = 0.02;
  specimen.tolerance = 1e-7;
  specimen.crack_faces = CrackFaces::contact;
  specimen.friction = friction;
  specimen.displacements = {
      {"hold x", "left", 0, {0., 0.}}, {"hold y", "left", 1, {0., 0.}}, {"move", "right", 0, {1., 0.}}};
  return specimen;
}

class Closing : public testing::TestWithParam<double> {
 protected:
  const std::vector<mesh::CrackFacet<2>> notches = {{Point2(6., 0.), Point2(6., 2.)}, {Point2(6., 4.), Point2(6., 6.)}};

  /// On the right edge of the bar without a crack.
  static double force_on_whole_bar(double load) {
    WatchedRun run(bar({}, 0.), "right", 0);
    return run.advance(load).force;
  }
};

TEST_P(Closing, ABarInTwoPartsCarriesPressureAndPartsAgain) {
  constexpr double pressed = -0.02;
  WatchedRun run(bar(notches, GetParam()), "right", 0);
  run.advance_to(0.3, 6);
  run.expect_severed();
  const auto broken = run.rows.back().broken;
  run.advance(0.);
  EXPECT_NEAR(run.advance(pressed).force, force_on_whole_bar(pressed), 0.05 * std::abs(force_on_whole_bar(pressed)));
  EXPECT_LT(run.body().overlap().depth, 0.1 * std::abs(pressed));
  run.advance(0.);
  run.advance(0.3);
  EXPECT_EQ(run.rows.back().broken, broken);
  run.expect_severed();
}

TEST_P(Closing, ACrackThatIsPressedAndPulledAgainIsWhereItWas) {
  WatchedRun run(bar({{Point2(6., 0.), Point2(6., 2.)}}, GetParam()), "right", 0);
  double load = 0.02;
  while (run.rows.empty() || run.rows.back().broken == 0) run.advance(load += 0.01);
  const Row cracked = run.rows.back();
  run.advance(0.);
  const Row pressed = run.advance(-load);
  EXPECT_EQ(pressed.broken, cracked.broken);
  EXPECT_GT(std::abs(pressed.force), 1.05 * cracked.force);  // it is stiffer closed
  run.advance(0.);
  const Row again = run.advance(load);
  EXPECT_EQ(again.broken, cracked.broken);
  EXPECT_NEAR(again.force, cracked.force, 1e-6 * run.largest_force());
}

/// Where no bond is left, loose elements may bump into each other without end.
TEST_P(Closing, RubbleCarriesPressureOrTheRunEndsInOrder) {
  Specimen specimen = bar({}, GetParam());
  specimen.critical_stretch = 1e-6;
  WatchedRun run(specimen, "right", 0);
  try {
    for (const double load : {0.1, 0., -0.02}) run.advance(load);
    EXPECT_LT(run.rows.back().force, 0.);
  } catch (const fracture::UnfinishedIncrement& unfinished) {
    EXPECT_THAT(unfinished.what(), testing::HasSubstr("the forces do not balance"));
  }
}

INSTANTIATE_TEST_SUITE_P(Friction, Closing, testing::Values(0., 0.5));

}  // namespace
}  // namespace perimorph::tests
