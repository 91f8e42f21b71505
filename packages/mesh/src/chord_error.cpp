#include "perimorph/mesh/chord_error.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "perimorph/mesh/sorted_sides.hpp"

namespace perimorph::mesh {

namespace {

Point<2> normal_of(const std::vector<Point<2>>& corners) {
  const Point<2> along = corners[1] - corners[0];
  return Point<2>(along[1], -along[0]).normalized();
}

Point<3> normal_of(const std::vector<Point<3>>& corners) {
  return Point<3>((corners[1] - corners[0]).cross(corners[2] - corners[0])).normalized();
}

/// What two neighbouring sides share: nodes in 2D, edges in 3D, by their nodes.
template <int dim>
std::vector<SideKey> rims_of(const std::vector<int>& nodes) {
  std::vector<SideKey> rims;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    rims.push_back(dim == 2 ? side_key({nodes[k]}) : side_key({nodes[k], nodes[(k + 1) % nodes.size()]}));
  }
  return rims;
}

template <int dim>
Point<dim> mean(const std::vector<Point<dim>>& corners) {
  Point<dim> sum = Point<dim>::Zero();
  for (const auto& corner : corners) sum += corner;
  return sum / static_cast<double>(corners.size());
}

}  // namespace

template <int dim>
std::vector<ChordError<dim>> chord_errors(const Mesh<dim>& whole) {
  constexpr double sharpest = 40. / 180. * 3.14159265358979323846, flattest = 1e-6;
  std::vector<ChordError<dim>> errors;
  std::map<SideKey, Side> first_at;
  for (const auto& side : whole.boundary) {
    const auto corners = corner_points(whole, side);
    for (const auto& rim : rims_of<dim>(side_nodes(whole, side))) {
      const auto [found, is_new] = first_at.try_emplace(rim, side);
      if (is_new) continue;
      const auto others = corner_points(whole, found->second);
      const double angle = std::acos(std::clamp(normal_of(corners).dot(normal_of(others)), -1., 1.));
      if (angle > sharpest || angle < flattest) continue;
      const double distance = angle * (mean<dim>(corners) - mean<dim>(others)).norm() / 8.;
      errors.push_back({side.element, distance, mean<dim>(corners)});
      errors.push_back({found->second.element, distance, mean<dim>(others)});
    }
  }
  std::sort(errors.begin(), errors.end(), [](const auto& a, const auto& b) { return a.element < b.element; });
  return errors;
}

template std::vector<ChordError<2>> chord_errors(const Mesh<2>&);
template std::vector<ChordError<3>> chord_errors(const Mesh<3>&);

}  // namespace perimorph::mesh
