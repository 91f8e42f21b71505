// Bonds that soften, from a tensile strength and a fracture energy.

#include "perimorph/materials/softening.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

namespace perimorph::materials {
namespace {

/// Its critical stretch is 50 times its limit.
const BondLaw fifty = [] {
  const double width = 49. * 0.5 * (0.8 / 3.6 + 1. / 3.);  // of phi, in limits
  return BondLaw::softening(Softening::bilinear, 1e-4, 1e-8 * (0.5 + width));
}();

TEST(StrengthOverLimit, IsThatOfASumOverDirections) {
  ASSERT_NEAR(fifty.critical_stretch(), 50e-4, 1e-12);
  // By a separate program, with 720 directions and strains in steps of 0.05 limits: bond-based 1.231 and 1.532,
  // kappa / mu = -0.5 and 0.5 in two dimensions 1.256 and 1.215.
  EXPECT_NEAR(strength_over_limit<2>(fifty), 1.231, 0.002);
  EXPECT_NEAR(strength_over_limit<3>(fifty), 1.532, 0.002);
  EXPECT_NEAR(strength_over_limit<2>(fifty, -0.5), 1.256, 0.002);
  EXPECT_NEAR(strength_over_limit<2>(fifty, 0.5), 1.215, 0.002);
}

TEST(StrengthOverLimit, TendsToOneForNearlyBrittleBonds) {
  const BondLaw nearly_brittle = BondLaw::softening(Softening::bilinear, 1e-4, 0.5001e-8);
  EXPECT_NEAR(strength_over_limit<2>(nearly_brittle), 1., 0.02);
  EXPECT_NEAR(strength_over_limit<3>(nearly_brittle), 1., 0.02);
  EXPECT_THROW(strength_over_limit<2>(0.01), base::Bug);
}

template <int dim>
void expect_strength_and_energy(ElasticModel model, double poissons_ratio) {
  constexpr double strength = 3.9, energy = 0.1;
  const auto concrete = elastic_material<dim>(model, 37000., poissons_ratio, 1.5, 15.);
  const auto toughness = softening_toughness(concrete, concrete, Softening::exponential, strength, energy);
  const double modulus = 1. / concrete.e0.inverse()(0, 0);
  const double ratio = strength_over_limit<dim>(toughness.law, concrete.dilatational_ratio);
  EXPECT_NEAR(toughness.law.limit() * ratio * modulus, strength, 1e-5 * strength);
  EXPECT_EQ(toughness.fracture_energy, energy);
  EXPECT_NEAR(2. * toughness.law.area() * energy_of_bonds(concrete, concrete), energy, 1e-10 * energy);
  EXPECT_FALSE(toughness.is_stretch_given);
}

TEST(SofteningToughness, GivesStrengthAndEnergyBack) {
  expect_strength_and_energy<2>(ElasticModel::plane_stress, 1. / 3.);
  expect_strength_and_energy<2>(ElasticModel::plane_stress, 0.2);
  expect_strength_and_energy<2>(ElasticModel::plane_strain, 0.2);
  expect_strength_and_energy<3>(ElasticModel::three_dimensional, 0.2);
}

TEST(SofteningToughness, IsNoneWhereBondsWouldBeMoreBrittleThanBrittleOnes) {
  const auto concrete = elastic_material<2>(ElasticModel::plane_stress, 37000., 0.2, 1.5, 15.);
  const double least = least_fracture_energy(concrete, concrete, 3.9);
  EXPECT_NEAR(softening_toughness(concrete, concrete, Softening::bilinear, 3.9, 1.001 * least).law.limit(),
              3.9 / 37000., 0.01 * 3.9 / 37000.);
  EXPECT_THROW(softening_toughness(concrete, concrete, Softening::bilinear, 3.9, least), base::Bug);
}

TEST(PerfectInterface, SoftensLikeTheLessToughMaterialWithItsEnergy) {
  auto mortar = elastic_material<2>(ElasticModel::plane_stress, 20000., 0.2, 1.5, 15.);
  const auto steel = elastic_material<2>(ElasticModel::plane_stress, 200000., 0.3, 1.5, 15.);
  mortar.toughness = softening_toughness(mortar, mortar, Softening::bilinear, 3., 0.05);
  const auto between = perfect_interface(steel, mortar);
  EXPECT_EQ(between.fracture_energy, 0.05);
  EXPECT_NEAR(2. * between.law.area() * energy_of_bonds(mortar, steel), 0.05, 1e-12);
  EXPECT_EQ(between.law.softening(), Softening::bilinear);
  EXPECT_LT(between.law.limit(), mortar.toughness.law.limit());
}

}  // namespace
}  // namespace perimorph::materials
