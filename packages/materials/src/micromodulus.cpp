#include "perimorph/materials/micromodulus.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>

namespace perimorph::materials {

namespace {
constexpr double pi = 3.14159265358979323846;

/// Int_0^delta theta1(z)^2 dz, [length]: theta1(z) = dim / m times the integral of r^2 c0(r) over the points of a
/// neighbourhood that lie beyond a plane at a distance z, and m that over all of it.
template <int dim>
double squared_dilatation(const Micromodulus& c) {
  using Quadrature = boost::math::quadrature::gauss_kronrod<double, 31>;
  const double l = c.characteristic_length, delta = c.horizon;
  const auto beyond = [&](double z) {
    const auto share = [&](double r) {  // of the circle or sphere of radius r
      const double cosine = std::min(1., z / r);
      return dim == 2 ? std::acos(cosine) / pi : 0.5 * (1. - cosine);
    };
    return Quadrature::integrate([&](double r) { return std::pow(r, dim + 3) * std::exp(-r / l) * share(r); }, z,
                                 delta);
  };
  const double whole = kernel_moment(dim + 3, l, delta);
  const auto squared = [&](double z) {
    const double theta = dim * beyond(z) / whole;
    return theta * theta;
  };
  return Quadrature::integrate(squared, 0., delta);
}

/// G_c / s_c^2. mu = tau0 m0 / (2 dim (dim + 2)), m0 the integral of r^4 exp(-r/l) over a neighbourhood.
template <int dim>
double energy_per_squared_stretch(const Micromodulus& c, double dilatational_ratio) {
  const double of_bonds =
      c.tau0 * kernel_moment(dim + 4, c.characteristic_length, c.horizon) * (dim == 2 ? 1. : pi / 2.);
  if (dilatational_ratio == 0.) return of_bonds;
  const double m0 = 2. * pi * (dim - 1) * c.tau0 * kernel_moment(dim + 3, c.characteristic_length, c.horizon);
  return of_bonds + dilatational_ratio * m0 / (2 * dim * (dim + 2)) * squared_dilatation<dim>(c);
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
Micromodulus calibrate(ElasticModel model, double youngs_modulus, double poissons_ratio, double characteristic_length,
                       double horizon) {
  const auto e0 = elasticity_tensor<dim>(model, youngs_modulus, poissons_ratio);
  const double mu = e0(dim, dim);
  const double c1111 = e0(0, 0) - dilatational_ratio(model, poissons_ratio) * mu;
  const double moment = kernel_moment(dim + 3, characteristic_length, horizon);
  const double angular = dim == 2 ? 8. / (3. * pi) : 5. / (2. * pi);
  return {angular * c1111 / moment, characteristic_length, horizon};
}

template <int dim>
double fracture_energy(const Micromodulus& micromodulus, double critical_stretch, double dilatational_ratio) {
  PERIMORPH_ASSERT(critical_stretch >= 0., "a critical stretch of {}", critical_stretch);
  return critical_stretch * critical_stretch * energy_per_squared_stretch<dim>(micromodulus, dilatational_ratio);
}

template <int dim>
double critical_stretch(const Micromodulus& micromodulus, double energy, double dilatational_ratio) {
  PERIMORPH_ASSERT(energy >= 0., "a fracture energy of {}", energy);
  return std::sqrt(energy / energy_per_squared_stretch<dim>(micromodulus, dilatational_ratio));
}

template Micromodulus calibrate<2>(ElasticModel, double, double, double, double);
template Micromodulus calibrate<3>(ElasticModel, double, double, double, double);
template double fracture_energy<2>(const Micromodulus&, double, double);
template double fracture_energy<3>(const Micromodulus&, double, double);
template double critical_stretch<2>(const Micromodulus&, double, double);
template double critical_stretch<3>(const Micromodulus&, double, double);

}  // namespace perimorph::materials
