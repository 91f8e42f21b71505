#include "perimorph/morphing/morphing_field.hpp"

#include <algorithm>
#include <limits>

namespace perimorph::morphing {

namespace {

void check_radii(double inner, double outer) {
  PERIMORPH_ASSERT(inner >= 0. && outer >= inner, "alpha is 1 up to the radius {} and 0 from {} on", inner, outer);
}

}  // namespace

template <int dim>
Zone<dim> Zone<dim>::ball(const base::Point<dim>& center, double inner_radius, double outer_radius) {
  check_radii(inner_radius, outer_radius);
  PERIMORPH_ASSERT(center.allFinite(), "the center of a ball of radius {} is nowhere", inner_radius);
  return {center, center, inner_radius, outer_radius - inner_radius};
}

template <int dim>
Zone<dim> Zone<dim>::box(const base::Point<dim>& lower, const base::Point<dim>& upper, double rim) {
  PERIMORPH_ASSERT((lower.array() <= upper.array()).all(), "a box of the extent {}", (upper - lower).minCoeff());
  PERIMORPH_ASSERT(rim >= 0., "a rim of {}", rim);
  return {lower, upper, 0., rim};
}

template <int dim>
Zone<dim> Zone<dim>::cylinder(const base::Point<dim>& start, const base::Point<dim>& end, double inner_radius,
                              double outer_radius) {
  check_radii(inner_radius, outer_radius);
  PERIMORPH_ASSERT((end - start).squaredNorm() > 0., "an axis of length {}", (end - start).norm());
  return {start, end, inner_radius, outer_radius - inner_radius, Core::line};
}

template <int dim>
Zone<dim> Zone<dim>::everything() {
  const auto infinite = base::Point<dim>::Constant(std::numeric_limits<double>::infinity());
  return {-infinite, infinite, 0., 1.};
}

template <int dim>
double Zone<dim>::alpha(const base::Point<dim>& x, BlendingFunction function) const {
  const double distance = distance_to_core(x) - inner_radius;
  if (distance <= 0.) return 1.;
  if (distance >= rim) return 0.;
  const double t = distance / rim;
  return function == BlendingFunction::linear ? 1. - t : 1. - t * t * (3. - 2. * t);
}

template <int dim>
double Zone<dim>::distance(const base::Point<dim>& x) const {
  return std::max(0., distance_to_core(x) - inner_radius - rim);
}

template <int dim>
double Zone<dim>::distance_to_core(const base::Point<dim>& x) const {
  if (core == Core::box) return (lower - x).cwiseMax(x - upper).cwiseMax(0.).norm();
  const base::Point<dim> line = upper - lower;
  const double t = std::clamp(line.dot(x - lower) / line.squaredNorm(), 0., 1.);
  return (x - lower - t * line).norm();
}

template <int dim>
MorphingField<dim>::MorphingField(const mesh::Mesh<dim>& mesh, const elements::MaterialPoints<dim>& points,
                                  BlendingFunction function)
    : mesh_(mesh),
      points_(points),
      function_(function),
      alpha_(points.size(), 0.),
      carries_bonds_(mesh.n_elements(), 0) {
  PERIMORPH_ASSERT(points.first(mesh.n_elements()) == points.size(), "{} points, {} of them in {} elements",
                   points.size(), points.first(mesh.n_elements()), mesh.n_elements());
}

template <int dim>
std::vector<int> MorphingField<dim>::add(const std::vector<Zone<dim>>& zones) {
  std::vector<int> risen;
  if (zones.empty()) return risen;
  for (int e = 0; e < mesh_.n_real_elements(); ++e) {
    bool rose = false;
    for (int p = points_.first(e); p < points_.first(e + 1); ++p) {
      double alpha = alpha_[p];
      for (const auto& zone : zones) {
        if (alpha == 1.) break;
        alpha = std::max(alpha, zone.alpha(points_.position(p), function_));
      }
      PERIMORPH_DEBUG_ASSERT(alpha >= alpha_[p] && alpha <= 1., "alpha goes from {} to {}", alpha_[p], alpha);
      rose = rose || alpha > alpha_[p];
      alpha_[p] = alpha;
    }
    if (!rose) continue;
    carries_bonds_[e] = 1;
    risen.push_back(e);
  }
  const auto n_real = static_cast<std::ptrdiff_t>(risen.size());
  for (int image = mesh_.n_real_elements(); image < mesh_.n_elements(); ++image) {
    const int source = mesh_.image(image).element;
    if (!std::binary_search(risen.begin(), risen.begin() + n_real, source)) continue;
    std::copy_n(alpha_.begin() + points_.first(source), points_.count(source), alpha_.begin() + points_.first(image));
    carries_bonds_[image] = 1;
    risen.push_back(image);
  }
  return risen;
}

template struct Zone<2>;
template struct Zone<3>;
template class MorphingField<2>;
template class MorphingField<3>;

}  // namespace perimorph::morphing
