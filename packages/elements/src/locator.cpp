#include "perimorph/elements/locator.hpp"

#include <algorithm>

#include "perimorph/base/errors.hpp"

namespace perimorph::elements {

template <int dim>
Locator<dim>::Locator(const mesh::Mesh<dim>& mesh) : mesh_(mesh) {
  std::vector<base::Point<dim>> centroids;
  for (int e = 0; e < mesh.n_owned_elements; ++e) {
    centroids.push_back(mesh::centroid(mesh, e));
    largest_radius_ = std::max(largest_radius_, mesh::radius(mesh, e));
  }
  centroids_ = std::make_unique<base::PointTree<dim>>(std::move(centroids));
}

template <int dim>
std::optional<Location> Locator<dim>::find(const base::Point<dim>& x) const {
  PERIMORPH_ASSERT(x.allFinite(), "a point in {} dimensions is nowhere", dim);
  constexpr double more = 1. + 1e-5;  // than the elements, so that rounding leaves none out
  for (const int e : centroids_->within(x, more * largest_radius_)) {  // ascending, as global ids are
    if ((mesh::centroid(mesh_, e) - x).norm() > more * mesh::radius(mesh_, e)) continue;
    std::vector<base::Point<dim>> corners;
    for (int k = 0; k < mesh_.n_corners(e); ++k) corners.push_back(mesh_.coordinates[mesh_.corners_of(e)[k]]);
    if (const auto shape = shape_at<dim>(mesh_.types[e], corners, x)) return Location{e, *shape};
  }
  return std::nullopt;
}

template class Locator<2>;
template class Locator<3>;

}  // namespace perimorph::elements
