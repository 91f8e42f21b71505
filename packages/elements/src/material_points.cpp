#include "perimorph/elements/material_points.hpp"

#include <Eigen/LU>
#include <cmath>
#include <limits>

namespace perimorph::elements {

template <int dim>
MaterialPoints<dim>::MaterialPoints(const mesh::Mesh<dim>& mesh, int points_per_direction) : mesh_(mesh) {
  first_ = {0};
  PERIMORPH_ASSERT(mesh.n_elements() <= std::numeric_limits<int>::max() / max_points, "{} elements", mesh.n_elements());
  for (int e = 0; e < mesh.n_elements(); ++e) {
    references_.push_back(&reference_element<dim>(mesh.types[e], points_per_direction));
    const auto& reference = *references_.back();
    for (int q = 0; q < reference.n_points; ++q) {
      base::Point<dim> x = base::Point<dim>::Zero();
      for (int k = 0; k < reference.n_corners; ++k)
        x += reference.shape[q](k) * mesh.coordinates[mesh.corners_of(e)[k]];
      const double determinant = jacobian(e, q).determinant();  // images have their corners in the same order
      const double volume = reference.weights[q] * (mesh.is_image(e) ? std::abs(determinant) : determinant);
      PERIMORPH_ASSERT(volume > 0., "element {} has volume {} at point {}", mesh.element_ids[e], volume, q);
      positions_.push_back(x);
      weights_.push_back(volume);
    }
    first_.push_back(static_cast<int>(weights_.size()));
  }
}

template <int dim>
ShapeGradients<dim> MaterialPoints<dim>::gradients(int element, int q) const {
  PERIMORPH_DEBUG_ASSERT(q >= 0 && q < count(element), "point {} of {} of element {}", q, count(element), element);
  return jacobian(element, q).inverse().transpose() * references_[element]->gradients[q];
}

template <int dim>
Eigen::Matrix<double, dim, dim> MaterialPoints<dim>::jacobian(int element, int q) const {
  const auto& gradients = references_[element]->gradients[q];
  Eigen::Matrix<double, dim, dim> j = Eigen::Matrix<double, dim, dim>::Zero();
  const int* corners = mesh_.corners_of(element);
  for (int k = 0; k < gradients.cols(); ++k) j += mesh_.coordinates[corners[k]] * gradients.col(k).transpose();
  return j;
}

template class MaterialPoints<2>;
template class MaterialPoints<3>;

}  // namespace perimorph::elements
