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
