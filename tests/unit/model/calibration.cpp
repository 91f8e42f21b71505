#include "perimorph/model/calibration.hpp"

#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>
#include <cmath>

#include "support/meshes.hpp"

namespace perimorph::model {
namespace {

constexpr auto on_damage = discretization::DiscontinuousElements::on_damage;
constexpr auto dropped = operators::PeridynamicStiffness::dropped;

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

TEST(LatticeResistance, GrowsWithWhatTheVolumeCarries) {
  const double without = lattice_resistance(on_damage, dropped, 1. / 3.);
  EXPECT_DOUBLE_EQ(lattice_resistance(on_damage, dropped, 1. / 3., -0.5) / without, 0.96);
  EXPECT_DOUBLE_EQ(lattice_resistance(on_damage, dropped, 1. / 3., 1.75) / without, 1.035);
  EXPECT_DOUBLE_EQ(lattice_resistance(on_damage, dropped, 1. / 3., 80.) / without, 1.09);
}

/// Without loads, on elements of 1 with l = 0.2.
Problem<2> some_problem(Calibration calibration = Calibration::mesh_consistent) {
  const auto plane_stress = materials::ElasticModel::plane_stress;
  auto material = materials::elastic_material<2>(plane_stress, 1000., 1. / 3., 0.2, 3.);
  material.toughness = {0.01, materials::fracture_energy<2>(material.micromodulus, 0.01)};
  Problem<2> problem{{material}, {}, {}, {}, {{}, {base::Point<2>::Zero(), base::Point<2>::Zero()}}, true};
  problem.calibration = calibration;
  return problem;
}

TEST(CalibrationToTheMesh, LowersTheCriticalStretchByTheResistance) {
  Problem<2> problem = some_problem();
  const double given = problem.materials[0].toughness.fracture_energy;

  EXPECT_TRUE(calibrate_to_mesh(problem, {}, 1.));

  EXPECT_DOUBLE_EQ(problem.materials[0].toughness.critical_stretch(),
                   0.01 / lattice_resistance(on_damage, dropped, 0.2));
  EXPECT_EQ(problem.materials[0].toughness.fracture_energy, given);
}

TEST(CalibrationToTheMesh, LeavesAGivenCriticalStretchAndRaisesTheFractureEnergy) {
  Problem<2> problem = some_problem();
  problem.materials[0].toughness.is_stretch_given = true;
  const double analytic = problem.materials[0].toughness.fracture_energy;

  calibrate_to_mesh(problem, {}, 1.);

  EXPECT_EQ(problem.materials[0].toughness.critical_stretch(), 0.01);
  EXPECT_DOUBLE_EQ(problem.materials[0].toughness.fracture_energy,
                   analytic * std::pow(lattice_resistance(on_damage, dropped, 0.2), 2));
}

TEST(CalibrationToTheMesh, ChangesNothingWhereTheResistanceHasNotBeenMeasured) {
  NumericalOptions three_points, never_parting;
  three_points.points_per_direction = 3;
  never_parting.discontinuous = discretization::DiscontinuousElements::never;
  for (const auto& options : {three_points, never_parting}) {
    Problem<2> problem = some_problem();

    EXPECT_FALSE(calibrate_to_mesh(problem, options, 1.));

    EXPECT_EQ(problem.materials[0].toughness.critical_stretch(), 0.01);
  }
}

TEST(CalibrationToTheMesh, AnalyticChangesNothing) {
  Problem<2> problem = some_problem(Calibration::analytic);

  calibrate_to_mesh(problem, {}, 1.);

  EXPECT_EQ(problem.materials[0].toughness.critical_stretch(), 0.01);
  EXPECT_EQ(problem.materials[0].toughness.fracture_energy, some_problem().materials[0].toughness.fracture_energy);
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

  problem.seeds = {morphing::Zone<2>::box({0., 0.}, {4., 4.}, 2.)};
  EXPECT_FLOAT_EQ(element_size(*comm, whole, problem), 1.);
  problem.seeds = {morphing::Zone<2>::box({4., 0.}, {12., 4.}, 2.)};
  EXPECT_FLOAT_EQ(element_size(*comm, whole, problem), 1.5);
  problem.seeds = {morphing::Zone<2>::ball({100., 100.}, 1., 2.)};  // nowhere: all elements count
  EXPECT_FLOAT_EQ(element_size(*comm, whole, problem), 1.25);
}

}  // namespace
}  // namespace perimorph::model
