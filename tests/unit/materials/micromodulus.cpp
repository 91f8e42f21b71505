#include "perimorph/materials/micromodulus.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "perimorph/materials/decay.hpp"

namespace perimorph::materials {
namespace {

constexpr double pi = 3.14159265358979323846;

/// Simpson's rule with 4000 intervals.
double integral(double from, double to, const std::function<double(double)>& f) {
  constexpr int n = 4000;
  const double h = (to - from) / n;
  double sum = f(from) + f(to);
  for (int i = 1; i < n; ++i) sum += (i % 2 == 1 ? 4. : 2.) * f(from + i * h);
  return sum * h / 3.;
}

// Simpson's error is (h/l)^4 / 180 times a constant of order 10 here: h/l is 1/50 at most.
constexpr double simpson = 1e-7;

TEST(KernelMoment, EqualsItsIntegral) {
  for (const int n : {0, 1, 4, 5, 6, 7}) {
    for (const double l : {0.1, 0.5, 3., 100.}) {
      SCOPED_TRACE("n = " + std::to_string(n) + ", l = " + std::to_string(l));
      const double expected = integral(0., 4., [&](double r) { return std::pow(r, n) * std::exp(-r / l); });
      EXPECT_NEAR(kernel_moment(n, l, 4.), expected, simpson * expected);
    }
  }
}

TEST(KernelMoment, IsThatOfTheWholeLineForALongHorizon) {
  EXPECT_NEAR(kernel_moment(5, 0.1, 10.), 120. * 1e-6, 1e-12 * 120e-6);  // n! l^(n+1)
}

TEST(KernelMoment, IsThePolynomialsForALongCharacteristicLength) {
  EXPECT_NEAR(kernel_moment(5, 1e9, 2.), 64. / 6., 1e-7);  // exp(-r/l) = 1 - 2e-9
}

TEST(Micromodulus, FallsExponentiallyUpToTheHorizonAndIsZeroBeyond) {
  const Micromodulus c0{3., 0.5, 2.};
  EXPECT_EQ(c0(0.), 3.);
  EXPECT_DOUBLE_EQ(c0(1.), 3. * std::exp(-2.));
  EXPECT_GT(c0(2.), 0.);
  EXPECT_GT(c0(2. + 1e-12), 0.);  // the same distance but for rounding
  EXPECT_EQ(c0(2. + 1e-6), 0.);
}

/// WHL19, eq. 17: E0_ijkl = 1/2 Int c0 xi_i xi_j xi_k xi_l dV; in polar coordinates, angles integrated numerically too.
TEST(Calibration, ReproducesTheElasticityTensorInThePlane) {
  for (const auto model : {ElasticModel::plane_stress, ElasticModel::plane_strain}) {
    const auto expected = elasticity_tensor<2>(model, 1000., bond_based_poissons_ratio(model));
    for (const double l : {0.2, 1., 10.}) {
      const Micromodulus c0 = calibrate<2>(model, 1000., bond_based_poissons_ratio(model), l, 3.);
      const double radial = integral(0., 3., [&](double r) { return c0(r) * std::pow(r, 5); });
      const auto component = [&](int cosines, int sines) {
        return 0.5 * radial * integral(0., 2. * pi, [&](double phi) {
                 return std::pow(std::cos(phi), cosines) * std::pow(std::sin(phi), sines);
               });
      };
      EXPECT_NEAR(component(4, 0), expected(0, 0), simpson * expected(0, 0));
      EXPECT_NEAR(component(2, 2), expected(0, 1), simpson * expected(0, 1));
      EXPECT_NEAR(component(2, 2), expected(2, 2), simpson * expected(2, 2));
    }
  }
}

TEST(Calibration, ReproducesTheElasticityTensorInSpace) {
  const auto model = ElasticModel::three_dimensional;
  const auto expected = elasticity_tensor<3>(model, 1000., bond_based_poissons_ratio(model));
  const Micromodulus c0 = calibrate<3>(model, 1000., 0.25, 0.5, 3.);
  const double radial = integral(0., 3., [&](double r) { return c0(r) * std::pow(r, 6); });
  const double zzzz = 2. * pi * integral(0., pi, [](double t) { return std::pow(std::cos(t), 4) * std::sin(t); });
  const double zzxx =
      pi * integral(0., pi, [](double t) { return std::pow(std::cos(t) * std::sin(t), 2) * std::sin(t); });
  EXPECT_NEAR(0.5 * radial * zzzz, expected(2, 2), simpson * expected(2, 2));
  EXPECT_NEAR(0.5 * radial * zzxx, expected(0, 1), simpson * expected(0, 1));
}

TEST(Calibration, GivesBondsTheShearModulusWhateverThePoissonsRatio) {
  for (const double ratio : {-0.3, 0.2, 0.4}) {
    const double of_mu = 1. / (1. + ratio);  // mu over that of a ratio of 0, at the same Young's modulus
    const auto tau0 = [](ElasticModel model, double nu) { return calibrate<2>(model, 1000., nu, 0.3, 3.).tau0; };
    EXPECT_NEAR(tau0(ElasticModel::plane_stress, ratio) / tau0(ElasticModel::plane_stress, 0.), of_mu, 1e-12);
    EXPECT_NEAR(tau0(ElasticModel::plane_strain, ratio) / tau0(ElasticModel::plane_stress, 0.), of_mu, 1e-12);
  }
}

/// G_c = s_c^2 mu l (a + kappa / mu j), with a and j that depend on the horizon over l alone.
TEST(FractureEnergy, CountsWhatTheDilatationStores) {
  const auto plane = calibrate<2>(ElasticModel::plane_stress, 2.4, 0.2, 1., 12.);  // mu = 1
  EXPECT_NEAR(fracture_energy<2>(plane, 1., 0.), 14.88, 0.005);
  EXPECT_NEAR(fracture_energy<2>(plane, 1., 1.) - fracture_energy<2>(plane, 1., 0.), 2.38, 0.005);
  const auto solid = calibrate<3>(ElasticModel::three_dimensional, 2.4, 0.2, 1., 12.);
  EXPECT_NEAR(fracture_energy<3>(solid, 1., 0.), 25.05, 0.005);
  EXPECT_NEAR(fracture_energy<3>(solid, 1., -0.5) - fracture_energy<3>(solid, 1., 0.), -0.5 * 4.60, 0.005);
}

TEST(FractureEnergy, AndCriticalStretchAreInverse) {
  EXPECT_NEAR(critical_stretch<2>({2., 0.3, 1.5}, fracture_energy<2>({2., 0.3, 1.5}, 0.07, 2.), 2.), 0.07, 1e-15);
  const Micromodulus plane = calibrate<2>(ElasticModel::plane_strain, 1000., 0.25, 0.3, 1.5);
  EXPECT_NEAR(critical_stretch<2>(plane, fracture_energy<2>(plane, 0.07)), 0.07, 1e-15);
  const Micromodulus solid = calibrate<3>(ElasticModel::three_dimensional, 1000., 0.25, 0.3, 1.5);
  EXPECT_NEAR(critical_stretch<3>(solid, fracture_energy<3>(solid, 0.07)), 0.07, 1e-15);
}

/// Silling and Askari 2005: all bonds that cross a line, 1/2 c0 s^2 r^4 each (a bond's force here is c0 (xi.eta) xi).
TEST(FractureEnergy, IsThatOfAllBondsAcrossALine) {
  const Micromodulus c0 = calibrate<2>(ElasticModel::plane_stress, 1000., 1. / 3., 0.4, 2.);
  const double s = 0.03;
  // A point at height z below the line; bonds longer than z, within an angle acos(z/r) of its normal.
  const double expected = integral(0., 2., [&](double z) {
    return integral(z, 2., [&](double r) {
      const double angles = r > 0. ? 2. * std::acos(std::min(1., z / r)) : 0.;
      return 0.5 * c0(r) * s * s * std::pow(r, 4) * angles * r;
    });
  });
  EXPECT_NEAR(fracture_energy<2>(c0, s), expected, 1e-4 * expected);  // the root of acos at z = r slows Simpson down
}

TEST(FractureEnergy, IsAsCasesSaysForAShortCharacteristicLength) {
  // 3 E / pi s^2 I6 / I5, I6 / I5 = 6 l for a long horizon: 18 / pi = 5.73.
  const Micromodulus c0 = calibrate<2>(ElasticModel::plane_stress, 1., 1. / 3., 1., 15.);
  EXPECT_NEAR(fracture_energy<2>(c0, 1.), 5.73, 0.03);  // a horizon of 15 l cuts off 0.5 %
  EXPECT_NEAR(fracture_energy<2>(calibrate<2>(ElasticModel::plane_stress, 1., 1. / 3., 1., 40.), 1.), 18. / pi, 1e-6);
}

TEST(FractureEnergy, OfThePapersCasesIsWhatTheirCriticalStretchesMean) {
  struct PaperCase {
    double youngs_modulus, length, stretch, energy;  // MPa, mm, -, N/mm
  };
  const PaperCase disk{3100., 0.1, 0.055, 5.4}, plate{71400., 0.05, 0.1, 205.}, beam{30000., 0.1, 0.05, 43.},
      double_notch{30000., 0.2, 0.1, 344.};
  for (const auto& c : {disk, plate, beam, double_notch}) {
    const Micromodulus c0 =
        calibrate<2>(ElasticModel::plane_stress, c.youngs_modulus, 1. / 3., c.length, 15. * c.length);
    EXPECT_NEAR(fracture_energy<2>(c0, c.stretch), c.energy, 0.01 * c.energy);  // printed with two or three digits
  }
}

// Rounding r/l to single precision changes exp(-r/l) by r/l exp(-r/l) 6e-8; the series and its sums add some roundings.
TEST(Decay, IsTheExponentialToSinglePrecision) {
  constexpr double length = 0.3;
  for (int i = 0; i < 4000; i += 8) {
    EightValues distances;
    for (int lane = 0; lane < 8; ++lane) distances[lane] = 0.01 * (i + lane);  // to 133 lengths, where it is 0
    const EightValues actual = decay(distances.square(), length);
    for (int lane = 0; lane < 8; ++lane) {
      EXPECT_NEAR(actual[lane], std::exp(-distances[lane] / length), 3e-7) << distances[lane];
    }
  }
}

TEST(Decay, IsTheSameToTheBitInEveryPlace) {
  EightValues squared;
  squared << 0., 0.1, 0.2, 0.3, 0.5, 0.8, 1.3, 2.1;
  const EightValues together = decay(squared, 0.4);
  for (int lane = 0; lane < 8; ++lane) {
    EXPECT_EQ(decay(EightValues::Constant(squared[lane]), 0.4)[0], together[lane]);
  }
}

TEST(Micromodulus, RefusesLengthsAndStretchesThatAreNone) {
  EXPECT_THROW(kernel_moment(-1, 1., 1.), base::Bug);
  EXPECT_THROW(kernel_moment(5, 0., 1.), base::Bug);
  EXPECT_THROW(calibrate<2>(ElasticModel::plane_stress, 1., 1. / 3., 1., -3.), base::Bug);
  EXPECT_THROW(calibrate<2>(ElasticModel::plane_stress, 0., 1. / 3., 1., 3.), base::Bug);
  const auto c0 = calibrate<2>(ElasticModel::plane_stress, 1., 1. / 3., 1., 3.);
  EXPECT_THROW(fracture_energy<2>(c0, -0.1), base::Bug);
  EXPECT_THROW(critical_stretch<2>(c0, std::nan("")), base::Bug);
}

}  // namespace
}  // namespace perimorph::materials
