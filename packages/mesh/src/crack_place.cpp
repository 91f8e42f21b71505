#include "perimorph/mesh/crack_place.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <set>

#include "perimorph/mesh/shared_sides.hpp"
#include "perimorph/mesh/sorted_sides.hpp"

namespace perimorph::mesh {

namespace {

constexpr double relative_tolerance = 1e-6;  // of an element's radius
constexpr double shortest = 0.25;            // crack, of an element's radius

template <int dim>
using Points = std::vector<Point<dim>>;

/// The half-space inside a side of an element: up . x <= height.
template <int dim>
struct HalfSpace {
  Point<dim> up;  ///< of length 1
  double height;

  double above(const Point<dim>& x) const { return up.dot(x) - height; }
};

template <int dim>
Point<dim> mean(const Points<dim>& points) {
  Point<dim> sum = Point<dim>::Zero();
  for (const auto& x : points) sum += x;
  return sum / static_cast<double>(points.size());
}

template <int dim>
HalfSpace<dim> inside_of(const Points<dim>& side) {
  Point<dim> up;
  if constexpr (dim == 2) {
    up << side[1][1] - side[0][1], side[0][0] - side[1][0];
  } else {
    up = (side[2] - side[0]).cross(side[side.size() == 3 ? 0 : 3] - side[1]);  // the diagonals; in a triangle two edges
  }
  up.normalize();
  return {up, up.dot(mean<dim>(side))};
}

template <int dim>
std::vector<HalfSpace<dim>> sides_of(const Mesh<dim>& mesh, int element) {
  std::vector<HalfSpace<dim>> all;
  const int n_sides = static_cast<int>(sides(mesh.types[element]).size());
  for (int s = 0; s < n_sides; ++s) all.push_back(inside_of<dim>(corner_points(mesh, {element, s})));
  return all;
}

/// What of a polygon (a segment counts as one of two corners) is at most so high above a side: Sutherland and Hodgman.
template <int dim>
Points<dim> clipped(const Points<dim>& polygon, const HalfSpace<dim>& side, double tolerance) {
  Points<dim> left;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
    const double from_height = side.above(from) - tolerance, to_height = side.above(to) - tolerance;
    if (from_height <= 0.) left.push_back(from);
    if ((from_height < 0. && to_height > 0.) || (from_height > 0. && to_height < 0.)) {
      left.push_back(from + (to - from) * (from_height / (from_height - to_height)));
    }
  }
  return left;
}

/// Length of a segment, mean width of a polygon, [length].
template <int dim>
double extent(const Points<dim>& polygon) {
  double length = 0., area = 0.;
  for (std::size_t i = 1; i < polygon.size(); ++i) {
    length = std::max(length, (polygon[i] - polygon[0]).norm());
    if constexpr (dim == 3) {
      if (i > 1) area += 0.5 * (polygon[i] - polygon[0]).cross(polygon[i - 1] - polygon[0]).norm();
    }
  }
  return dim == 2 || length == 0. ? length : area / length;
}

/// Where a crack lies in one mesh.
template <int dim>
class CrackSearch {
 public:
  CrackSearch(const Mesh<dim>& mesh, const std::vector<CrackFacet<dim>>& crack) : mesh_(mesh) {
    for (const auto& facet : crack) {
      facets_.emplace_back(facet.begin(), facet.end());
      for (const auto& corner : facet) box_.extend(corner);
    }
    for (const auto& side : mesh.boundary) outer_.insert(side);
    for (const auto& [a, b] : coincident_sides(mesh, mesh.boundary)) {  // a crack of the mesh's own is inside
      outer_.erase(a);
      outer_.erase(b);
    }
  }

  CrackPlace place(double size) const {
    auto place = CrackPlace::outside;
    for (int e = 0; e < mesh_.n_elements(); ++e) {
      const double reach = (1. + relative_tolerance) * radius(mesh_, e);
      if (box_.squaredExteriorDistance(centroid(mesh_, e)) > reach * reach) continue;
      if (!enters(e, sides_of(mesh_, e))) continue;
      if (box_.diagonal().norm() >= shortest * size * radius(mesh_, e)) return CrackPlace::inside;
      place = CrackPlace::too_short;
    }
    return place;
  }

 private:
  double tolerance(int element) const { return relative_tolerance * radius(mesh_, element); }

  /// Whether some piece of the crack lies in the element, or on a side of it behind which the body goes on.
  bool enters(int element, const std::vector<HalfSpace<dim>>& sides) const {
    return std::any_of(facets_.begin(), facets_.end(), [&](Points<dim> piece) {
      for (const auto& side : sides) piece = clipped(piece, side, tolerance(element));
      if (piece.size() < 2 || extent<dim>(piece) <= 10. * tolerance(element)) return false;
      const Point<dim> middle = mean<dim>(piece);
      bool is_on_surface = false;
      for (std::size_t s = 0; s < sides.size(); ++s) {
        if (sides[s].above(middle) < -tolerance(element)) continue;
        if (outer_.count({element, static_cast<int>(s)}) == 0) return true;
        is_on_surface = true;
      }
      return !is_on_surface;
    });
  }

  const Mesh<dim>& mesh_;
  std::vector<Points<dim>> facets_;
  Eigen::AlignedBox<double, dim> box_;
  std::set<Side> outer_;
};

}  // namespace

template <int dim>
CrackPlace place_of(const Mesh<dim>& whole, const std::vector<CrackFacet<dim>>& crack, double size) {
  return CrackSearch<dim>(whole, crack).place(size);
}

template CrackPlace place_of<2>(const Mesh<2>&, const std::vector<CrackFacet<2>>&, double);
template CrackPlace place_of<3>(const Mesh<3>&, const std::vector<CrackFacet<3>>&, double);

}  // namespace perimorph::mesh
