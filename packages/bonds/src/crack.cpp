#include "perimorph/bonds/crack.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <tuple>

#include "perimorph/base/errors.hpp"
#include "perimorph/mesh/shared_sides.hpp"

namespace perimorph::bonds {

using base::Point;

namespace {

template <int dim>
Point<dim> corner(const OpenSide<dim>& side, int k) {
  return Eigen::Map<const Point<dim>>(side.points[k].data());
}

template <int dim>
Point<dim> center(const OpenSide<dim>& side) {
  Point<dim> sum = Point<dim>::Zero();
  for (int k = 0; k < side.n_corners; ++k) sum += corner(side, k);
  return sum / side.n_corners;
}

/// Normal of a side, as long as the side is large.
Point<2> normal(const OpenSide<2>& side) {
  const Point<2> along = corner(side, 1) - corner(side, 0);
  return {along[1], -along[0]};
}

/// Half the cross product of the diagonals; a triangle's second one ends in the corner where the first begins.
Point<3> normal(const OpenSide<3>& side) {
  const int last = side.n_corners == 3 ? 0 : 3;
  return 0.5 * (corner(side, 2) - corner(side, 0)).cross(corner(side, last) - corner(side, 1));
}

/// Whether more than half of a pair's bonds are broken.
template <int dim>
bool is_open(const BondFamilies<dim>& bonds, int p) {
  std::size_t n_broken = 0;
  bonds.for_each_bond(p, [&](const Bond<dim>& bond) { n_broken += bond.is_broken; });
  return 2 * n_broken > bonds.first_bond(p + 1) - bonds.first_bond(p);
}

/// Unit normal of the plane that fits the sides best.
template <int dim>
Point<dim> mean_normal(const std::vector<OpenSide<dim>>& sides, const std::vector<int>& chosen) {
  PERIMORPH_ASSERT(!chosen.empty(), "no plane fits none of {} sides", sides.size());
  double weight = 0.;
  Point<dim> mean = Point<dim>::Zero();
  Eigen::Matrix<double, dim, dim> moments = Eigen::Matrix<double, dim, dim>::Zero();
  for (const int s : chosen) {
    for (int k = 0; k < sides[s].n_corners; ++k) {
      const Point<dim> x = corner(sides[s], k) - corner(sides[chosen[0]], 0);
      const double w = size(sides[s]) / sides[s].n_corners;
      weight += w;
      mean += w * x;
      moments += w * x * x.transpose();
    }
  }
  moments -= mean * mean.transpose() / weight;
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, dim, dim>>(moments).eigenvectors().col(0);
}

}  // namespace

template <int dim>
std::vector<OpenSide<dim>> open_sides(const mesh::Mesh<dim>& mesh, const BondFamilies<dim>& bonds) {
  std::vector<OpenSide<dim>> found;
  for (int p = 0; p < bonds.n_pairs(); ++p) {
    const auto [first, second] = bonds.pair(p);
    if (first == second || first >= mesh.n_owned_elements || !bonds.is_damaged(first) || !is_open(bonds, p)) continue;
    const int s = mesh::shared_side(mesh, first, second);
    if (s < 0) continue;
    const auto points = mesh::corner_points(mesh, {first, s});
    OpenSide<dim> side{mesh.element_ids[first], mesh.element_ids[second], static_cast<int>(points.size()), {}};
    for (std::size_t k = 0; k < points.size(); ++k) std::copy_n(points[k].data(), dim, side.points[k].data());
    found.push_back(side);
  }
  std::sort(found.begin(), found.end());
  PERIMORPH_DEBUG_ASSERT(std::adjacent_find(found.begin(), found.end(), std::not_fn(std::less<>())) == found.end(),
                         "one of {} open sides is there twice", found.size());
  return found;
}

template <int dim>
std::vector<mesh::Side> broken_surface(const mesh::Mesh<dim>& mesh, const BondFamilies<dim>& bonds) {
  std::vector<mesh::Side> surface;
  for (int p = 0; p < bonds.n_pairs(); ++p) {
    const auto [first, second] = bonds.pair(p);
    if (first == second || !bonds.is_damaged(first) || !is_open(bonds, p)) continue;
    for (const auto& [element, other] : {std::pair{first, second}, {second, first}}) {
      const int side = mesh::shared_side(mesh, element, other);
      if (side >= 0 && element < mesh.n_owned_elements) surface.push_back({element, side});
    }
  }
  std::sort(surface.begin(), surface.end(), [](const mesh::Side& a, const mesh::Side& b) {
    return std::tie(a.element, a.side) < std::tie(b.element, b.side);
  });
  return surface;
}

template <int dim>
double size(const OpenSide<dim>& side) {
  PERIMORPH_ASSERT(side.n_corners >= dim && side.n_corners <= OpenSide<dim>::max_corners, "a side of {} corners in {}D",
                   side.n_corners, dim);
  return normal(side).norm();
}

template <int dim>
double crack_size(const std::vector<OpenSide<dim>>& sides, double radius) {
  PERIMORPH_ASSERT(radius >= 0., "a radius of {}", radius);
  std::vector<Point<dim>> centers;
  for (const auto& side : sides) centers.push_back(center(side));
  const base::PointTree<dim> tree(centers);
  double sum = 0.;
  for (std::size_t s = 0; s < sides.size(); ++s) {
    sum += std::abs(normal(sides[s]).dot(mean_normal(sides, tree.within(centers[s], radius))));
  }
  return sum;
}

#define PERIMORPH_INSTANTIATE(dim)                                                                   \
  template std::vector<mesh::Side> broken_surface(const mesh::Mesh<dim>&, const BondFamilies<dim>&); \
  template std::vector<OpenSide<dim>> open_sides(const mesh::Mesh<dim>&, const BondFamilies<dim>&);  \
  template double size(const OpenSide<dim>&);                                                        \
  template double crack_size(const std::vector<OpenSide<dim>>&, double);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::bonds
