#include "perimorph/materials/micromodulus.hpp"

namespace perimorph::materials {

namespace {
constexpr double pi = 3.14159265358979323846;

/// G_c / s_c^2.
template <int dim>
double energy_per_squared_stretch(const Micromodulus& c) {
  const double moment = kernel_moment(dim + 4, c.characteristic_length, c.horizon);
  return c.tau0 * moment * (dim == 2 ? 1. : pi / 2.);
}
}  // namespace

double kernel_moment(int n, double characteristic_length, double horizon) {
  PERIMORPH_ASSERT(n >= 0, "the moment of r^{}", n);
  PERIMORPH_ASSERT(std::isfinite(characteristic_length) && characteristic_length > 0., "a characteristic length of {}",
                   characteristic_length);
  PERIMORPH_ASSERT(std::isfinite(horizon) && horizon > 0., "a horizon of {}", horizon);
  // I_n = n! l^(n+1) (1 - exp(-x) Sum_{k<=n} x^k/k!),  x = delta/l; for small x the tail of the exponential series.
  const double x = horizon / characteristic_length;
  double factorial = 1., term = 1.;
  for (int k = 1; k <= n; ++k) {
    factorial *= k;
    term *= x / k;
  }
  double tail = 0.;
  for (int k = n + 1; k < n + 2000; ++k) {
    term *= x / k;
    tail += term;
    if (term < 1e-17 * tail) break;
  }
  return factorial * std::pow(characteristic_length, n + 1) * std::exp(-x) * tail;
}

template <int dim>
Micromodulus calibrate(ElasticModel model, double youngs_modulus, double characteristic_length, double horizon) {
  const double c1111 = elasticity_tensor<dim>(model, youngs_modulus, bond_based_poissons_ratio(model))(0, 0);
  const double moment = kernel_moment(dim + 3, characteristic_length, horizon);
  const double angular = dim == 2 ? 8. / (3. * pi) : 5. / (2. * pi);
  return {angular * c1111 / moment, characteristic_length, horizon};
}

template <int dim>
double fracture_energy(const Micromodulus& micromodulus, double critical_stretch) {
  PERIMORPH_ASSERT(critical_stretch >= 0., "a critical stretch of {}", critical_stretch);
  return critical_stretch * critical_stretch * energy_per_squared_stretch<dim>(micromodulus);
}

template <int dim>
double critical_stretch(const Micromodulus& micromodulus, double energy) {
  PERIMORPH_ASSERT(energy >= 0., "a fracture energy of {}", energy);
  return std::sqrt(energy / energy_per_squared_stretch<dim>(micromodulus));
}

template Micromodulus calibrate<2>(ElasticModel, double, double, double);
template Micromodulus calibrate<3>(ElasticModel, double, double, double);
template double fracture_energy<2>(const Micromodulus&, double);
template double fracture_energy<3>(const Micromodulus&, double);
template double critical_stretch<2>(const Micromodulus&, double);
template double critical_stretch<3>(const Micromodulus&, double);

}  // namespace perimorph::materials
