#include "perimorph/materials/elasticity.hpp"

#include <cmath>

#include "perimorph/base/errors.hpp"

namespace perimorph::materials {

double bond_based_poissons_ratio(ElasticModel model) { return model == ElasticModel::plane_stress ? 1. / 3. : 1. / 4.; }

double dilatational_ratio(ElasticModel model, double poissons_ratio) {
  const double nu = poissons_ratio, beyond = nu - bond_based_poissons_ratio(model);
  return model == ElasticModel::plane_stress ? 3. * beyond / (1. - nu) : 4. * beyond / (1. - 2. * nu);
}

double expansion_factor(ElasticModel model, double poissons_ratio) {
  return model == ElasticModel::plane_strain ? 1. + poissons_ratio : 1.;
}

template <int dim>
base::Stiffness<dim> elasticity_tensor(ElasticModel model, double youngs_modulus, double poissons_ratio) {
  PERIMORPH_ASSERT((model == ElasticModel::three_dimensional) == (dim == 3), "dimension {}", dim);
  PERIMORPH_ASSERT(std::isfinite(youngs_modulus) && youngs_modulus > 0., "Young's modulus is {}", youngs_modulus);
  PERIMORPH_ASSERT(poissons_ratio > -1. && poissons_ratio < (model == ElasticModel::plane_stress ? 1. : 0.5),
                   "Poisson's ratio is {}", poissons_ratio);
  const double nu = poissons_ratio;
  const double mu = youngs_modulus / (2. * (1. + nu));
  // Plane stress eliminates the strain through the thickness; otherwise lambda is that of three dimensions.
  const double lambda = model == ElasticModel::plane_stress ? youngs_modulus * nu / (1. - nu * nu)
                                                            : youngs_modulus * nu / ((1. + nu) * (1. - 2. * nu));
  base::Stiffness<dim> tensor = base::Stiffness<dim>::Zero();
  tensor.template topLeftCorner<dim, dim>().setConstant(lambda);
  for (int i = 0; i < base::n_voigt<dim>; ++i) tensor(i, i) += i < dim ? 2. * mu : mu;
  return tensor;
}

template base::Stiffness<2> elasticity_tensor<2>(ElasticModel, double, double);
template base::Stiffness<3> elasticity_tensor<3>(ElasticModel, double, double);

}  // namespace perimorph::materials
