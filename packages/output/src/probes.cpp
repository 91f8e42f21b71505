#include "perimorph/output/probes.hpp"

#include <Eigen/QR>
#include <algorithm>

#include "perimorph/base/errors.hpp"
#include "perimorph/cases/geometry.hpp"
#include "perimorph/operators/fields.hpp"

namespace perimorph::output {

using base::Point;
using fracture::Body;

namespace {

/// Stress inside an element from that at its material points: interpolated from corners, at which it is such that it
/// meets that at the points, or comes closest if there are more of them.
template <int dim>
base::Voigt<dim> interpolated_stress(const Body<dim>& body, const elements::Location& at) {
  const auto model = body.model();
  const auto stress = operators::stress_at_points(model, at.element, body.displacement(), body.system().at_points());
  const auto n = static_cast<int>(stress.size()), n_corners = static_cast<int>(at.shape.size());
  PERIMORPH_ASSERT(n >= n_corners, "stress at {} points of an element with {} corners", n, n_corners);
  Eigen::MatrixXd shapes(n, n_corners), values(n, base::n_voigt<dim>);
  for (int q = 0; q < n; ++q) {
    shapes.row(q) = model.points.shape(at.element, q);
    values.row(q) = stress[q];
  }
  return (at.shape * shapes.householderQr().solve(values)).transpose();
}

template <int dim>
Point<dim> interpolated_displacement(const Body<dim>& body, const elements::Location& at) {
  const auto model = body.model();
  Point<dim> sum = Point<dim>::Zero();
  for (int k = 0; k < body.mesh().n_corners(at.element); ++k) {
    const int node = model.dofs.nodes_of(at.element)[k];
    sum += at.shape[k] * base::at_node<dim>(body.displacement(), node);
  }
  return sum;
}

}  // namespace

template <int dim>
Probes<dim>::Probes(const base::Comm& comm, const mesh::Mesh<dim>& mesh, const std::vector<cases::Probe>& probes) {
  for (const auto& probe : probes) {
    int number = 0;
    for (const auto& position : cases::places_of<dim>(probe)) places_.push_back({probe.name, ++number, position});
  }
  std::vector<Point<dim>> positions;
  for (const auto& place : places_) positions.push_back(place.position);
  own_ = discretization::sampled_here(comm, mesh, positions);
}

template <int dim>
std::vector<typename Probes<dim>::Sample> Probes<dim>::measure(const base::Comm& comm, const Body<dim>& body) const {
  std::vector<Sample> own;
  for (const auto& [place, at] : own_) {
    Sample sample{place, {}, {}};
    Eigen::Map<Point<dim>>(sample.displacement.data()) = interpolated_displacement(body, at);
    Eigen::Map<base::Voigt<dim>>(sample.stress.data()) = interpolated_stress(body, at);
    own.push_back(sample);
  }
  auto all = base::gather_on_root(comm, own);
  std::sort(all.begin(), all.end(), [](const Sample& a, const Sample& b) { return a.place < b.place; });
  return all;
}

template class Probes<2>;
template class Probes<3>;

}  // namespace perimorph::output
