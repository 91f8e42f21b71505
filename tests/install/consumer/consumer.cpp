// Another program that is built on the installed packages: the stiffness of steel in plane stress, and the edges of one
// element.
#include <cstdio>

#include "perimorph/materials/elasticity.hpp"
#include "perimorph/mesh/mesh.hpp"

int main() {
  using namespace perimorph;
  const base::Stiffness<2> stiffness =
      materials::elasticity_tensor<2>(materials::ElasticModel::plane_stress, 210e3, 1. / 3.);
  mesh::Mesh<2> element;
  element.coordinates = {{0., 0.}, {2., 0.}, {2., 1.}, {0., 1.}};
  element.types = {mesh::ElementType::quad4};
  element.first_corner = {0, 4};
  element.corners = {0, 1, 2, 3};
  std::printf("%.6g %.6g %zu\n", stiffness(0, 0), mesh::mean_edge(element), alignof(base::Stiffness<2>));
}
