#include "perimorph/fracture/calibration.hpp"

#include <gtest/gtest.h>

#include "support/fracture_body.hpp"

namespace perimorph::fracture {
namespace {

constexpr auto on_damage = DiscontinuousElements::on_damage;
constexpr auto dropped = PeridynamicStiffness::dropped;

TEST(LatticeResistance, FallsToOneWithTheCharacteristicLength) {
  double before = lattice_resistance(on_damage, dropped, 0.2);
  for (double length = 0.22; length <= 0.5; length += 0.02) {
    const double resistance = lattice_resistance(on_damage, dropped, length);
    EXPECT_LT(resistance, before);
    before = resistance;
  }
  EXPECT_NEAR(before, 1., 0.02);  // bonds that are long against elements do not feel the mesh
}

TEST(LatticeResistance, StaysAtTheNearestMeasuredValueOutsideTheirRange) {
  EXPECT_EQ(lattice_resistance(on_damage, dropped, 0.1), lattice_resistance(on_damage, dropped, 0.2));
  EXPECT_EQ(lattice_resistance(on_damage, dropped, 2.), lattice_resistance(on_damage, dropped, 0.5));
}

/// A case on elements of 1 with l = 0.2, of which only what the calibration reads is filled in.
Case some_case(Calibration calibration) {
  Case input{};
  input.dimension = 2;
  input.points_per_direction = 2;
  input.calibration = calibration;
  input.discontinuous = on_damage;
  input.peridynamic_stiffness = dropped;
  input.characteristic_length = 0.2;
  input.horizon = 3.;
  return input;
}

Problem<2> some_problem() {
  tests::Specimen specimen{{}, 3., 0.2};
  specimen.critical_stretch = 0.01;
  return tests::make_problem(specimen);
}

TEST(CalibrationToTheMesh, LowersTheCriticalStretchByTheResistance) {
  Case input = some_case(Calibration::mesh_consistent);
  Problem<2> problem = some_problem();
  input.fracture_energy = problem.fracture_energy;

  calibrate_to_mesh(problem, input, 1.);

  EXPECT_DOUBLE_EQ(problem.critical_stretch, 0.01 / lattice_resistance(on_damage, dropped, 0.2));
  EXPECT_EQ(problem.fracture_energy, *input.fracture_energy);
}

TEST(CalibrationToTheMesh, LeavesAGivenCriticalStretchAndRaisesTheFractureEnergy) {
  Case input = some_case(Calibration::mesh_consistent);
  Problem<2> problem = some_problem();
  input.critical_stretch = problem.critical_stretch;
  const double analytic = problem.fracture_energy;

  calibrate_to_mesh(problem, input, 1.);

  EXPECT_EQ(problem.critical_stretch, 0.01);
  EXPECT_DOUBLE_EQ(problem.fracture_energy, analytic * std::pow(lattice_resistance(on_damage, dropped, 0.2), 2));
}

TEST(CalibrationToTheMesh, ChangesNothingWhereTheResistanceHasNotBeenMeasured) {
  Case input = some_case(Calibration::mesh_consistent);
  input.points_per_direction = 3;
  Problem<2> problem = some_problem();

  EXPECT_FALSE(calibrate_to_mesh(problem, input, 1.));

  EXPECT_EQ(problem.critical_stretch, 0.01);
}

TEST(CalibrationToTheMesh, AnalyticChangesNothing) {
  Problem<2> problem = some_problem();

  calibrate_to_mesh(problem, some_case(Calibration::analytic), 1.);

  EXPECT_EQ(problem.critical_stretch, 0.01);
  EXPECT_EQ(problem.fracture_energy, some_problem().fracture_energy);
}

/// Squares of 1 for x < 4, twice as wide beyond.
mesh::Mesh<2> graded() {
  mesh::Mesh<2> whole = tests::grid({8, 4, 8., 4.});
  for (auto& x : whole.coordinates) x[0] = std::max(x[0], 2. * x[0] - 4.);
  return whole;
}

TEST(ElementSize, IsTheMeanEdgeInTheSeedsOnEveryRank) {
  const auto comm = Tpetra::getDefaultComm();
  const auto whole = comm->getRank() == 0 ? graded() : mesh::Mesh<2>{};
  Problem<2> problem = some_problem();

  problem.seeds = {tests::Zone<2>::box({0., 0.}, {4., 4.}, 2.)};
  EXPECT_FLOAT_EQ(element_size(*comm, whole, problem), 1.);
  problem.seeds = {tests::Zone<2>::box({4., 0.}, {12., 4.}, 2.)};
  EXPECT_FLOAT_EQ(element_size(*comm, whole, problem), 1.5);
  problem.seeds = {tests::Zone<2>::ball({100., 100.}, 1., 2.)};  // nowhere: all elements count
  EXPECT_FLOAT_EQ(element_size(*comm, whole, problem), 1.25);
}

}  // namespace
}  // namespace perimorph::fracture
