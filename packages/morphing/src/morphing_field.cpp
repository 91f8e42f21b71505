#include "perimorph/morphing/morphing_field.hpp"

#include <algorithm>
#include <limits>

namespace perimorph::morphing {

template <int dim>
Zone<dim> Zone<dim>::ball(const base::Point<dim>& center, double inner_radius, double outer_radius) {
  return {center, center, inner_radius, outer_radius - inner_radius};
}

template <int dim>
Zone<dim> Zone<dim>::box(const base::Point<dim>& lower, const base::Point<dim>& upper, double rim) {
  return {lower, upper, 0., rim};
}

template <int dim>
Zone<dim> Zone<dim>::cylinder(const base::Point<dim>& start, const base::Point<dim>& end, double inner_radius,
                              double outer_radius) {
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
      carries_bonds_(mesh.n_elements(), 0) {}

template <int dim>
std::vector<int> MorphingField<dim>::add(const std::vector<Zone<dim>>& zones) {
  std::vector<int> risen;
  if (zones.empty()) return risen;
  for (int e = 0; e < mesh_.n_elements(); ++e) {
    bool rose = false;
    for (int p = points_.first(e); p < points_.first(e + 1); ++p) {
      double alpha = alpha_[p];
      for (const auto& zone : zones) {
        if (alpha == 1.) break;
        alpha = std::max(alpha, zone.alpha(points_.position(p), function_));
      }
      rose = rose || alpha > alpha_[p];
      alpha_[p] = alpha;
    }
    if (!rose) continue;
    carries_bonds_[e] = 1;
    risen.push_back(e);
  }
  return risen;
}

template struct Zone<2>;
template struct Zone<3>;
template class MorphingField<2>;
template class MorphingField<3>;

}  // namespace perimorph::morphing
