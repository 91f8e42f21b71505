#include "perimorph/discretization/node_frames.hpp"

#include <algorithm>

#include "perimorph/base/errors.hpp"

namespace perimorph::discretization {

using base::Point;

namespace {

template <int dim>
Eigen::Map<Point<dim>> vector_at(base::Field field, int node) {
  return Eigen::Map<Point<dim>>(field.getRawPtr() + static_cast<std::ptrdiff_t>(node) * dim);
}

template <class Sum, class Of>
double sum_of(const Sum& ramps, Of of) {
  double sum = 0.;
  for (const auto& [factor, ramp] : ramps) sum += factor * of(ramp);
  return sum;
}

/// What of a direction the first axes do not span.
template <class Axes, int dim>
Point<dim> rest_of(const Point<dim>& direction, const Axes& axes, int n_axes) {
  const auto first = axes.leftCols(n_axes);
  return direction - first * (first.transpose() * direction);
}

}  // namespace

template <int dim>
NodeFrames<dim>::NodeFrames(const DofMap<dim>& dofs, const Dirichlet<dim>& dirichlet) {
  const auto& oblique = dirichlet.oblique();
  if (oblique.empty()) return;
  frame_at_.assign(dofs.n_nodes(), -1);
  for (int n = 0; n < dofs.n_real_nodes(); ++n) {
    const auto found = oblique.find(dofs.reference_node(n));
    if (found == oblique.end()) continue;
    frame_at_[n] = static_cast<int>(frames_.size());
    frames_.push_back(make(n, found->second, dirichlet.load_factor()));
  }
}

/// By Gram and Schmidt; what follows from others is left out.
template <int dim>
typename NodeFrames<dim>::Frame NodeFrames<dim>::make(int node,
                                                      const std::vector<typename Dirichlet<dim>::Along>& along,
                                                      double load_factor) {
  constexpr double independent = 1e-4;
  Frame frame{node, Block::Zero(), {}};
  int n_axes = 0;
  for (const auto& [direction, value] : along) {
    const Point<dim> rest = rest_of(direction, frame.axes, n_axes);
    const double length = rest.norm();
    if (!value.holds_at(load_factor) || length < independent) continue;
    Sum sum = {{1. / length, value}};
    for (int axis = 0; axis < n_axes; ++axis) {
      const double share = direction.dot(frame.axes.col(axis));
      for (const auto& [factor, ramp] : frame.values[axis]) sum.emplace_back(-share * factor / length, ramp);
    }
    frame.values.push_back(std::move(sum));
    frame.axes.col(n_axes++) = rest / length;
  }
  while (n_axes < dim) {
    Point<dim> longest = Point<dim>::Zero();
    for (int c = 0; c < dim; ++c) {
      const Point<dim> rest = rest_of(Point<dim>(Point<dim>::Unit(c)), frame.axes, n_axes);
      if (rest.norm() > longest.norm()) longest = rest;
    }
    frame.axes.col(n_axes++) = longest.normalized();
  }
  return frame;
}

template <int dim>
std::vector<int> NodeFrames<dim>::prescribed() const {
  std::vector<int> dofs;
  for (const auto& frame : frames_) {
    for (int axis = 0; axis < static_cast<int>(frame.values.size()); ++axis) dofs.push_back(frame.node * dim + axis);
  }
  return dofs;
}

template <int dim>
bool NodeFrames<dim>::decides(int node, int component) const {
  constexpr double seen = 1e-6;
  const Frame* frame = find(node);
  if (frame == nullptr) return false;
  return frame->axes.row(component).head(static_cast<Eigen::Index>(frame->values.size())).norm() > seen;
}

template <int dim>
void NodeFrames<dim>::prescribe(base::Field u, double load_factor) const {
  for (const auto& frame : frames_) {
    auto at_node = vector_at<dim>(u, frame.node);
    Point<dim> along = frame.axes.transpose() * at_node;
    for (std::size_t axis = 0; axis < frame.values.size(); ++axis) {
      along[static_cast<Eigen::Index>(axis)] =
          sum_of(frame.values[axis], [&](const auto& ramp) { return ramp.at(load_factor); });
    }
    at_node = frame.axes * along;
  }
}

template <int dim>
void NodeFrames<dim>::add_rates(base::Field rates, double load_factor, double step) const {
  for (const auto& frame : frames_) {
    for (std::size_t axis = 0; axis < frame.values.size(); ++axis) {
      const double rate = sum_of(frame.values[axis], [&](const auto& ramp) { return ramp.rate_in(load_factor, step); });
      vector_at<dim>(rates, frame.node) += rate * frame.axes.col(static_cast<Eigen::Index>(axis));
    }
  }
}

template <int dim>
void NodeFrames<dim>::turn(base::Field vectors) const {
  for (const auto& frame : frames_) {
    if (frame.node * dim >= vectors.size()) continue;
    auto at_node = vector_at<dim>(vectors, frame.node);
    at_node = (frame.axes.transpose() * at_node).eval();
  }
}

template <int dim>
void NodeFrames<dim>::turn_back(base::Field vectors) const {
  for (const auto& frame : frames_) {
    if (frame.node * dim >= vectors.size()) continue;
    auto at_node = vector_at<dim>(vectors, frame.node);
    at_node = (frame.axes * at_node).eval();
  }
}

template <int dim>
typename NodeFrames<dim>::Block NodeFrames<dim>::between_unknowns(int node, int other, const Block& stiffness) const {
  Block result = stiffness;
  if (const auto* frame = find(node)) result = (frame->axes.transpose() * result).eval();
  if (const auto* frame = find(other)) result = (result * frame->axes).eval();
  return result;
}

template class NodeFrames<2>;
template class NodeFrames<3>;

}  // namespace perimorph::discretization
