// Materials, and what is between two of them.

#include "perimorph/materials/material.hpp"

#include <gtest/gtest.h>

#include "perimorph/materials/bond_materials.hpp"

namespace perimorph::materials {
namespace {

Material<2> plate(double youngs_modulus, double length, double energy = 0.) {
  auto material = elastic_material<2>(ElasticModel::plane_stress, youngs_modulus, 0.2, length, 3.);
  if (energy == 0.) return material;
  material.toughness = {critical_stretch<2>(material.micromodulus, energy, material.dilatational_ratio), energy};
  return material;
}

TEST(FractureEnergy, WithinOneMaterialIsThatOfItsOwnBonds) {
  const auto material = plate(1000., 0.3);
  const double expected = fracture_energy<2>(material.micromodulus, 0.02, material.dilatational_ratio);
  EXPECT_NEAR(fracture_energy(material, material, 0.02), expected, 1e-9 * expected);
}

TEST(FractureEnergy, BetweenTwoMaterialsIsThatOfTheirHarmonicMean) {
  auto soft = plate(1000., 0.3), stiff = plate(3000., 0.3);
  soft.dilatational_ratio = stiff.dilatational_ratio = 0.;
  const double alone = fracture_energy(soft, soft, 0.02);
  EXPECT_NEAR(fracture_energy(soft, stiff, 0.02), 1.5 * alone, 1e-9 * alone);  // 2 / (1/1 + 1/3)
  EXPECT_NEAR(critical_stretch(soft, stiff, fracture_energy(soft, stiff, 0.02)), 0.02, 1e-15);
}

TEST(Interface, IsAsToughAsTheLessToughMaterialIfItIsPerfect) {
  const auto tender = plate(1000., 0.3, 0.1), tough = plate(3000., 0.2, 5.), steel = plate(9000., 0.3);
  for (const auto* other : {&tough, &steel}) {
    const auto toughness = perfect_interface(tender, *other);
    EXPECT_EQ(toughness.fracture_energy, 0.1);
    EXPECT_NEAR(fracture_energy(tender, *other, toughness.critical_stretch()), 0.1, 1e-15);
  }
  EXPECT_FALSE(perfect_interface(steel, steel).breaks());
}

/// Critical stretch 0.001, so that bonds break by their stretch at E 0.001 / 0.2.
Material<2> rock(double youngs_modulus, std::optional<double> compressive_strength) {
  auto material = elastic_material<2>(ElasticModel::plane_stress, youngs_modulus, 0.2, 0.3, 3.);
  material.toughness = {0.001, 1.};
  material.compressive_strength = compressive_strength;
  return material;
}

double uncounted(const Material<2>& one, const Material<2>& other, const BondLaw& law = 0.001) {
  return lateral_compression(one, other, law).uncounted;
}

TEST(CompressiveStrength, OfStretchFollowsFromPoissonsRatio) {
  EXPECT_DOUBLE_EQ(compressive_strength_of_stretch(rock(1000., {})), 5.);
  EXPECT_TRUE(std::isinf(compressive_strength_of_stretch(plate(1000., 0.3))));  // it never breaks
  const auto auxetic = elastic_material<2>(ElasticModel::plane_stress, 1000., -0.1, 0.3, 3.);
  EXPECT_TRUE(std::isinf(compressive_strength_of_stretch(auxetic)));
}

TEST(CompressiveStrength, IsBorneByBondsOfWhoseStretchAsMuchDoesNotCount) {
  const auto material = rock(1000., 20.);
  const auto compression = lateral_compression(material, material, material.toughness.law);
  EXPECT_DOUBLE_EQ(compression.uncounted, 0.75);
  const double strain = 20. / 1000., stretch = 0.2 * strain;
  EXPECT_NEAR(material.toughness.law.under(compression).counted_stretch(stretch, stretch - strain), 0.001, 1e-15);
}

TEST(CompressiveStrength, BetweenTwoMaterialsIsThatOfTheOneWhoseStretchCountsMore) {
  const auto weak = rock(1000., 10.), strong = rock(3000., 150.), by_stretch = rock(1000., {}),
             steel = plate(9000., 0.3);
  EXPECT_DOUBLE_EQ(uncounted(weak, strong), 0.5);
  EXPECT_DOUBLE_EQ(uncounted(strong, weak), 0.5);
  EXPECT_EQ(uncounted(weak, by_stretch), 0.);
  EXPECT_DOUBLE_EQ(uncounted(steel, weak), 0.5);  // steel never breaks
  EXPECT_EQ(uncounted(steel, steel), 0.);         // the interface may
  EXPECT_EQ(uncounted(weak, strong, BondLaw::softening(Softening::bilinear, 0.001, 1e-5)), 0.);
}

TEST(BondMaterials, HaveTheHarmonicMeanBetweenTwo) {
  const Micromodulus one{2., 0.3, 3.}, other{5., 0.4, 3.};
  const std::vector<BondLaw> four = {0.01, 0.03, 0.03, 0.02};
  const BondMaterials both({one, other}, four, {0, 1, 1});
  EXPECT_EQ(both.stiffness(0, 0, 1.), one(1.));
  EXPECT_EQ(both.stiffness(1, 2, 1.), other(1.));
  EXPECT_DOUBLE_EQ(both.stiffness(0, 1, 1.), 2. * one(1.) * other(1.) / (one(1.) + other(1.)));
  EXPECT_EQ(both.stiffness(0, 1, 3.1), 0.);  // beyond the horizon
  EXPECT_EQ(both.law(1, 2).limit(), 0.02);
  EXPECT_EQ(both.law(2, 0).limit(), 0.03);
  EXPECT_EQ(both.smallest_limit(), 0.01);
  EXPECT_THROW(BondMaterials({one, {5., 0.4, 2.}}, four, {0, 1}), base::Bug);
  EXPECT_THROW(BondMaterials({one, other}, four, {2}), base::Bug);
  EXPECT_THROW(BondMaterials({one, other}, {0.01}, {0, 1}), base::Bug);
}

}  // namespace
}  // namespace perimorph::materials
