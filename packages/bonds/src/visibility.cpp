#include "perimorph/bonds/visibility.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>

#include "perimorph/base/errors.hpp"

namespace perimorph::bonds {

namespace {

template <int dim>
base::Point<dim> centroid(const mesh::CrackFacet<dim>& facet) {
  base::Point<dim> c = base::Point<dim>::Zero();
  for (const auto& corner : facet) c += corner / dim;
  return c;
}

template <int dim>
double radius(const mesh::CrackFacet<dim>& facet) {
  double r = 0.;
  for (const auto& corner : facet) r = std::max(r, (corner - centroid<dim>(facet)).norm());
  return r;
}

template <class Points>
auto box_around(const Points& points) {
  Eigen::AlignedBox<double, Points::value_type::RowsAtCompileTime> box;
  for (const auto& x : points) box.extend(x);
  return box;
}

constexpr double slack = 1e-9;  // relative to bond and facet: a bond through a facet's corner is cut

/// Solves x + t (p - x) = f0 + sum_i s_i (f_i - f0); they meet if t, s_i and 1 - sum s_i are not negative and t <= 1.
template <int dim>
bool meets(const mesh::CrackFacet<dim>& facet, const base::Point<dim>& x, const base::Point<dim>& p) {
  Eigen::Matrix<double, dim, dim> directions;
  directions.col(0) = p - x;
  double scale = directions.col(0).norm();
  for (int i = 1; i < dim; ++i) {
    directions.col(i) = facet[0] - facet[i];
    scale *= directions.col(i).norm();
  }
  if (std::abs(directions.determinant()) <= 1e-12 * scale) return false;  // parallel
  const base::Point<dim> solution = directions.inverse() * (facet[0] - x);
  const double t = solution[0];
  const auto s = solution.template tail<dim - 1>();
  return t >= -slack && t <= 1. + slack && s.minCoeff() >= -slack && s.sum() <= 1. + slack;
}

/// To the facet's line or plane, of any length.
template <int dim>
base::Point<dim> normal(const mesh::CrackFacet<dim>& facet) {
  const base::Point<dim> edge = facet[1] - facet[0];
  if constexpr (dim == 2) {
    return {-edge[1], edge[0]};
  } else {
    return edge.cross(facet[2] - facet[0]);
  }
}

}  // namespace

template <int dim>
Visibility<dim>::Visibility(const mesh::Mesh<dim>& mesh, const std::vector<mesh::Side>& sides,
                            const std::vector<Facet>& pre_cracks)
    : pre_cracks_(pre_cracks) {
  for (const auto& facet : pre_cracks_) {
    for (const auto& corner : facet) {
      PERIMORPH_ASSERT(corner.allFinite(), "one of {} facets of pre-cracks is nowhere", pre_cracks_.size());
    }
  }
  for (const auto& side : sides) {
    const auto corners = mesh::corner_points(mesh, side);
    for (std::size_t k = dim - 1; k < corners.size(); ++k) {  // a fan: one segment in 2D, one or two triangles in 3D
      Facet facet;
      facet[0] = corners[0];
      for (int i = 1; i < dim; ++i) facet[i] = corners[k - dim + 1 + i];
      boundary_.push_back(facet);
    }
  }
  std::vector<base::Point<dim>> centers;
  for (const auto& facet : boundary_) {
    centers.push_back(centroid<dim>(facet));
    largest_radius_ = std::max(largest_radius_, radius<dim>(facet));
  }
  tree_ = std::make_unique<base::PointTree<dim>>(std::move(centers));
}

template <int dim>
std::vector<mesh::CrackFacet<dim>> Visibility<dim>::near(const base::Point<dim>& center, double reach) const {
  PERIMORPH_ASSERT(reach >= 0., "a reach of {}", reach);
  std::vector<Facet> found;
  for (const int f : tree_->within(center, reach + largest_radius_)) found.push_back(boundary_[f]);
  for (const auto& facet : pre_cracks_) {
    if (box_around(facet).squaredExteriorDistance(center) <= reach * reach) found.push_back(facet);
  }
  return found;
}

template <int dim>
std::vector<mesh::CrackFacet<dim>> Visibility<dim>::among(const std::vector<Facet>& facets,
                                                          const std::vector<base::Point<dim>>& points) {
  PERIMORPH_ASSERT(!points.empty(), "{} facets between no points", facets.size());
  std::vector<Facet> found;
  const auto box = box_around(points);
  for (const auto& facet : facets) {
    const auto facets_box = box_around(facet);
    const double margin = slack * (box.diagonal().norm() + facets_box.diagonal().norm());  // as in meets()
    if (box.squaredExteriorDistance(facets_box) > margin * margin) continue;
    // Heights above the facet's line or plane, times the length of its normal.
    const base::Point<dim> up = normal<dim>(facet);
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    for (const auto& x : points) {
      const double height = up.dot(x - facet[0]);
      lowest = std::min(lowest, height);
      highest = std::max(highest, height);
    }
    const double touching = slack * (highest - lowest);  // as in meets()
    if (lowest <= touching && highest >= -touching) found.push_back(facet);
  }
  return found;
}

template <int dim>
bool Visibility<dim>::blocks(const std::vector<Facet>& facets, const base::Point<dim>& x, const base::Point<dim>& p) {
  return std::any_of(facets.begin(), facets.end(), [&](const Facet& facet) { return meets<dim>(facet, x, p); });
}

template class Visibility<2>;
template class Visibility<3>;

}  // namespace perimorph::bonds
