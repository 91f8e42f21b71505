#include "perimorph/materials/elasticity.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "perimorph/base/errors.hpp"

namespace perimorph::materials {
namespace {

constexpr double e = 200., nu = 0.3, rounding = 1e-12;  // of moduli of some hundreds

TEST(ElasticityTensor, InPlaneStressUniaxialStressContractsByPoissonsRatio) {
  const Eigen::Vector3d strain =
      elasticity_tensor<2>(ElasticModel::plane_stress, e, nu).inverse() * Eigen::Vector3d(1., 0., 0.);
  EXPECT_LT((strain - Eigen::Vector3d(1. / e, -nu / e, 0.)).norm(), rounding);
}

TEST(ElasticityTensor, InThreeDimensionsUniaxialStressContractsByPoissonsRatio) {
  base::Voigt<3> stress = base::Voigt<3>::Zero(), expected = stress;
  stress[0] = 1.;
  expected.head<3>() << 1. / e, -nu / e, -nu / e;
  EXPECT_LT((elasticity_tensor<3>(ElasticModel::three_dimensional, e, nu).inverse() * stress - expected).norm(),
            rounding);
}

/// No strain across the plane, and alpha dT = 1.
TEST(ExpansionFactor, GivesInPlaneStrainTheStressOfThreeDimensions) {
  base::Voigt<3> strain;
  strain << 0.3 - 1., -0.2 - 1., -1., 0., 0., 0.5;
  const base::Voigt<3> solid = elasticity_tensor<3>(ElasticModel::three_dimensional, e, nu) * strain;
  const double free = expansion_factor(ElasticModel::plane_strain, nu);
  const base::Voigt<2> plane =
      elasticity_tensor<2>(ElasticModel::plane_strain, e, nu) * base::Voigt<2>(0.3 - free, -0.2 - free, 0.5);
  EXPECT_LT((plane - base::Voigt<2>(solid[0], solid[1], solid[5])).norm(), rounding * solid.norm());
  EXPECT_EQ(expansion_factor(ElasticModel::plane_stress, nu), 1.);
  EXPECT_EQ(expansion_factor(ElasticModel::three_dimensional, nu), 1.);
}

TEST(ElasticityTensor, InPlaneStrainIsTheThreeDimensionalOneWithoutStrainAcross) {
  const auto solid = elasticity_tensor<3>(ElasticModel::three_dimensional, e, nu);
  const auto plane = elasticity_tensor<2>(ElasticModel::plane_strain, e, nu);
  const int kept[] = {0, 1, 5};  // xx, yy, xy
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(plane(i, j), solid(kept[i], kept[j]), rounding);
  }
}

TEST(ElasticityTensor, ShearModulusActsOnEngineeringShear) {
  EXPECT_NEAR(elasticity_tensor<2>(ElasticModel::plane_stress, e, nu)(2, 2), e / (2. * (1. + nu)), rounding);
  EXPECT_NEAR(elasticity_tensor<3>(ElasticModel::three_dimensional, e, nu)(3, 3), e / (2. * (1. + nu)), rounding);
}

TEST(ElasticityTensor, AtTheBondBasedRatioHasTheSymmetryOfCentralForces) {
  // C1122 = C1212 (Cauchy).
  for (const auto model : {ElasticModel::plane_stress, ElasticModel::plane_strain}) {
    const auto c = elasticity_tensor<2>(model, e, bond_based_poissons_ratio(model));
    EXPECT_NEAR(c(0, 1), c(2, 2), rounding);
    EXPECT_NEAR(c(0, 0), 3. * c(0, 1), rounding);
  }
  const auto c = elasticity_tensor<3>(ElasticModel::three_dimensional, e,
                                      bond_based_poissons_ratio(ElasticModel::three_dimensional));
  EXPECT_NEAR(c(0, 1), c(3, 3), rounding);
}

TEST(DilatationalRatio, IsWhatCentralForcesLack) {
  for (const auto model : {ElasticModel::plane_stress, ElasticModel::plane_strain}) {
    const auto c = elasticity_tensor<2>(model, e, nu);
    EXPECT_NEAR(dilatational_ratio(model, nu), (c(0, 1) - c(2, 2)) / c(2, 2), rounding);
    EXPECT_EQ(dilatational_ratio(model, bond_based_poissons_ratio(model)), 0.);
  }
  const auto c = elasticity_tensor<3>(ElasticModel::three_dimensional, e, 0.1);
  EXPECT_NEAR(dilatational_ratio(ElasticModel::three_dimensional, 0.1), (c(0, 1) - c(3, 3)) / c(3, 3), rounding);
}

TEST(ElasticityTensor, RefusesModuliThatNoSolidHas) {
  EXPECT_THROW(elasticity_tensor<2>(ElasticModel::three_dimensional, e, nu), base::Bug);
  EXPECT_THROW(elasticity_tensor<2>(ElasticModel::plane_stress, -e, nu), base::Bug);
  EXPECT_THROW(elasticity_tensor<2>(ElasticModel::plane_strain, e, 0.5), base::Bug);
  EXPECT_THROW(elasticity_tensor<2>(ElasticModel::plane_stress, e, -1.), base::Bug);
}

}  // namespace
}  // namespace perimorph::materials
