// Automatic seeds go where cracks start: to the tips of notches, the same on any number of ranks.

#include "perimorph/application/automatic_seeds.hpp"

#include <gtest/gtest.h>

#include <Teuchos_DefaultMpiComm.hpp>

#include "support/fracture_body.hpp"

namespace perimorph::tests {
namespace {

using Place = application::StretchedPlace<2>;

/// A plate of 30 x 40, pulled along y, with notches of width 2 at half height from either side.
Specimen notched_plate(double left_depth, double right_depth) {
  const auto is_notch = [=](const Point2& c) {
    return std::abs(c[1] - 20.) < 1. && (c[0] < left_depth || c[0] > 30. - right_depth);
  };
  Specimen specimen{without(grid({30, 40, 30., 40.}), is_notch), 3., 0.2};
  specimen.whole.node_sets["corner"] = {0};
  specimen.displacements = {
      {"hold y", "bottom", 1, {0., 0.}}, {"hold x", "corner", 0, {0., 0.}}, {"pull", "top", 1, {0.01, 0.}}};
  return specimen;
}

std::vector<Place> places(const Specimen& specimen, const Teuchos::RCP<const base::Comm>& comm, double share) {
  SpecimenBody test(specimen, comm);
  test.body.apply_load(1.);
  test.body.update_topology();
  test.body.solve(fracture::Accuracy::accepted);
  return application::most_stretched<2>(*comm, test.body, test.problem, {"seed", 6., 12., share});
}

/// All ranks' answer, which must be that of each rank alone.
std::vector<Place> places(const Specimen& specimen, double share = 0.8) {
  auto found = places(specimen, Tpetra::getDefaultComm(), share);
  const auto alone = places(specimen, Teuchos::rcp(new Teuchos::MpiComm<int>(MPI_COMM_SELF)), share);
  EXPECT_EQ(found.size(), alone.size());
  for (std::size_t i = 0; i < std::min(found.size(), alone.size()); ++i) {
    EXPECT_EQ(found[i].element, alone[i].element);
    EXPECT_NEAR(found[i].strain, alone[i].strain, 1e-6 * alone[i].strain);
  }
  return found;
}

double distance(const Place& place, const Point2& x) {
  return (Eigen::Map<const Point2>(place.centroid.data()) - x).norm();
}

constexpr double near = 1.6;  // elements of size 1 that touch the end of a notch of width 2

TEST(AutomaticSeed, IsAtTheTipOfANotch) {
  const auto found = places(notched_plate(10., 0.));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_LT(distance(found[0], {10., 20.}), near);
  EXPECT_GT(found[0].strain, 2. * 0.01 / 40.);  // more than twice the mean strain
}

TEST(AutomaticSeed, IsAtBothTipsOfEqualNotches) {
  const auto found = places(notched_plate(8., 8.));
  ASSERT_EQ(found.size(), 2u);
  EXPECT_LT(std::min(distance(found[0], {8., 20.}), distance(found[1], {8., 20.})), near);
  EXPECT_LT(std::min(distance(found[0], {22., 20.}), distance(found[1], {22., 20.})), near);
}

TEST(AutomaticSeed, IsAtASmallerNotchTooIfTheShareIsSmall) {
  const auto specimen = notched_plate(10., 2.);
  EXPECT_EQ(places(specimen, 0.9).size(), 1u);
  const auto found = places(specimen, 0.2);
  ASSERT_GE(found.size(), 2u);
  EXPECT_LT(distance(found[0], {10., 20.}), near);
  EXPECT_LT(distance(found[1], {28., 20.}), near);
}

TEST(AutomaticSeed, LeavesOutWhatIsPeridynamicAlready) {
  auto specimen = notched_plate(8., 8.);
  specimen.seeds = {Zone<2>::ball({8., 20.}, 6., 12.)};
  const auto found = places(specimen, 0.7);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_LT(distance(found[0], {22., 20.}), near);
}

TEST(AutomaticSeed, IsNowhereInABodyWithoutLoad) {
  auto specimen = notched_plate(10., 0.);
  specimen.displacements[2].value = {0., 0.};
  EXPECT_TRUE(places(specimen).empty());
}

TEST(AutomaticSeed, IsPlacedUnderTheLargestLoadOfStepsThatEndWithNone) {
  const auto comm = Tpetra::getDefaultComm();
  const auto amplitude = std::make_shared<const discretization::Amplitude>(
      std::vector<discretization::Amplitude::Knot>{{0., 0.}, {2., 3.}, {4., 0.}});
  Specimen specimen = notched_plate(10., 0.);
  specimen.displacements[2].value.amplitude = amplitude.get();
  const auto mesh = mesh::distribute(*comm, specimen.whole, specimen.horizon);
  auto problem = make_problem(specimen);
  problem.amplitudes = {amplitude};
  problem.common_amplitude = amplitude.get();
  problem.automatic_seeds = {{"seed", 6., 12., 0.8}};
  base::Profile profile;

  application::place_automatic_seeds<2>(comm, mesh, make_options(specimen), 4, problem, profile,
                                        base::make_log(*comm, true));

  ASSERT_EQ(problem.seeds.size(), 1u);
  EXPECT_EQ(problem.seeds[0].alpha({10., 20.}, morphing::BlendingFunction::linear), 1.);
}

}  // namespace
}  // namespace perimorph::tests
