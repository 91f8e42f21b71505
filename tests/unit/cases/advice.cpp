#include "perimorph/cases/advice.hpp"

#include <gmock/gmock.h>

namespace perimorph::cases {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

/// On elements of 1: what the documentation recommends.
Case good() {
  Case input;
  input.dimension = 2;
  input.numerical.points_per_direction = 2;
  input.material.poissons_ratio = 1. / 3.;
  input.material.fracture_energy = 0.1;
  input.material.calibration = model::Calibration::mesh_consistent;
  input.peridynamics.characteristic_length = 1. / 3.;
  input.peridynamics.horizon = 4.;
  input.numerical.growth_inner_radius = 8.;
  input.numerical.growth_outer_radius = 16.;
  Seed tip;
  tip.name = "tip";
  tip.shape = SeedShape::ball;
  tip.inner_radius = 8.;
  tip.outer_radius = 16.;
  input.morphing.seeds = {tip};
  return input;
}

TEST(Advice, HasNothingToSayOfAGoodCase) { EXPECT_THAT(advice(good(), 1.), IsEmpty()); }

TEST(Advice, AVolumeThatHardlyChangesWantsASmoothRim) {
  Case input = good();
  input.material.poissons_ratio = 0.45;
  EXPECT_THAT(advice(input, 1.), IsEmpty());
  input.material.elastic_model = materials::ElasticModel::plane_strain;
  EXPECT_THAT(advice(input, 1.), ElementsAre(StartsWith("/Morphing/Function: where alpha begins and ends to fall")));
  input.numerical.blending_function = morphing::BlendingFunction::cubic;
  EXPECT_THAT(advice(input, 1.), IsEmpty());
}

TEST(Advice, ADensityWithoutWeightHasNoEffect) {
  Case input = good();
  input.material.density = 2.4e-9;
  EXPECT_THAT(advice(input, 1.), ElementsAre(StartsWith("/Boundary Conditions/Self-Weight: is zero")));
  input.morphing.seeds.clear();
  EXPECT_THAT(advice(input, 1.), ElementsAre(HasSubstr("densities have no effect")));
  input.boundary_conditions.self_weight_constant = {0., -9810.};
  EXPECT_THAT(advice(input, 1.), IsEmpty());
}

TEST(Advice, AThermalExpansionWithoutATemperatureHasNoEffect) {
  Case input = good();
  input.material.thermal_expansion = 1e-5;
  EXPECT_THAT(advice(input, 1.), ElementsAre(StartsWith("/Boundary Conditions/Temperatures: has none")));
  input.boundary_conditions.temperatures.emplace_back();
  EXPECT_THAT(advice(input, 1.), IsEmpty());
}

TEST(Advice, ContactWithoutAZoneHasNoEffect) {
  Case input = good();
  input.peridynamics.crack_faces = discretization::CrackFaces::contact;
  EXPECT_THAT(advice(input, 1.), IsEmpty());
  input.morphing.seeds.clear();
  EXPECT_THAT(advice(input, 1.), ElementsAre(StartsWith("/Peridynamics/Crack Faces: \"Contact\" has no effect")));
}

TEST(Advice, HasNothingToSayOfABodyWithoutZones) {
  Case input = good();
  input.morphing.seeds.clear();
  input.peridynamics.horizon = 1.;
  EXPECT_THAT(advice(input, 1.), IsEmpty());
}

TEST(Advice, ACharacteristicLengthOfAFifthOfAnElementHoldsCracksUp) {
  Case input = good();
  input.peridynamics.characteristic_length = 0.2;
  EXPECT_THAT(advice(input, 1.),
              ElementsAre(AllOf(StartsWith("/Peridynamics/Characteristic Length: 0.2 is 0.20 of an element"),
                                HasSubstr("(for which the critical stretch makes up)"))));
  input.dimension = 3;
  EXPECT_THAT(advice(input, 1.), IsEmpty());  // little is held up there
  input.dimension = 2;
  input.material.calibration = model::Calibration::analytic;
  EXPECT_THAT(advice(input, 1.)[0], Not(HasSubstr("makes up")));
  input.material.fracture_energy.reset();
  EXPECT_THAT(advice(input, 1.), IsEmpty());  // nothing breaks
}

TEST(Advice, ElementsThatNeverPartHoldCracksUp) {
  Case input = good();
  input.numerical.discontinuous = discretization::DiscontinuousElements::never;
  const auto expected = ElementsAre(StartsWith("/Morphing/Discontinuous Elements: \"Never\": broken elements hold"));
  EXPECT_THAT(advice(input, 1.), expected);
  input.peridynamics.characteristic_length = 0.2;
  EXPECT_THAT(advice(input, 1.), expected);
  input.material.fracture_energy.reset();
  EXPECT_THAT(advice(input, 1.), IsEmpty());
}

TEST(Advice, AHorizonOfTwoElementsIsTooShort) {
  Case input = good();
  input.peridynamics.horizon = 2.;
  input.peridynamics.characteristic_length = 0.3;
  const auto lines = advice(input, 1.);
  ASSERT_EQ(lines.size(), 2);
  EXPECT_THAT(lines[0], StartsWith("/Peridynamics/Horizon: 2 is 2.0 elements; with fewer than three"));
  EXPECT_THAT(lines[1], StartsWith("/Peridynamics/Horizon: 2 is 6.7 characteristic lengths and cuts off"));
}

TEST(Advice, AHorizonOfEightCharacteristicLengthsCutsTheMicromodulusOff) {
  Case input = good();
  input.peridynamics.characteristic_length = 0.5;
  EXPECT_THAT(advice(input, 1.), ElementsAre(HasSubstr("cuts off 19 % of the micromodulus")));
}

TEST(Advice, AThinRimGivesSpuriousStrains) {
  Case input = good();
  input.morphing.seeds[0].outer_radius = 10.;
  EXPECT_THAT(advice(input, 1.),
              ElementsAre(StartsWith("/Morphing/Seeds/tip/Outer Radius: alpha falls over 2, 0.50 horizons")));
  input = good();
  input.numerical.growth_outer_radius = 10.;
  EXPECT_THAT(advice(input, 1.), ElementsAre(StartsWith("/Morphing/Growth Outer Radius: alpha falls over 2")));
}

TEST(Advice, AZoneOfOneHorizonLetsNothingBreak) {
  Case input = good();
  input.morphing.seeds[0].inner_radius = 4.;
  EXPECT_THAT(advice(input, 1.),
              ElementsAre(StartsWith("/Morphing/Seeds/tip/Inner Radius: the zone reaches 4, 1.00 horizons")));
  input = good();
  input.numerical.growth_inner_radius = 4.;
  EXPECT_THAT(advice(input, 1.), ElementsAre(StartsWith("/Morphing/Growth Inner Radius: the zone reaches 4")));
}

TEST(Advice, ABoxIsMeasuredByItsNarrowSide) {
  Case input = good();
  input.morphing.seeds[0] = {};
  input.morphing.seeds[0].name = "bar";
  input.morphing.seeds[0].shape = SeedShape::box;
  input.morphing.seeds[0].lower_corner = {0., 0.};
  input.morphing.seeds[0].upper_corner = {40., 6.};
  input.morphing.seeds[0].rim = 8.;
  EXPECT_THAT(advice(input, 1.),
              ElementsAre(StartsWith("/Morphing/Seeds/bar/Upper Corner: the zone reaches 3, 0.75 horizons")));
}

}  // namespace
}  // namespace perimorph::cases
