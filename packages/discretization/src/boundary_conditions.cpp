#include "perimorph/discretization/boundary_conditions.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "perimorph/base/errors.hpp"

namespace perimorph::discretization {

using base::Point;

template <int dim>
Dirichlet<dim>::Dirichlet(const base::Comm& comm, const mesh::Mesh<dim>& mesh,
                          const std::vector<PrescribedComponent>& conditions, const std::vector<RigidGroup>& groups)
    : mesh_(mesh), begun_(mesh.n_nodes() * dim, 0), groups_(group_motions(comm, mesh, groups, conditions)) {
  base::on_all_ranks(comm, [&] {
    for (const auto& [first, second, node] : contradictions(mesh, conditions, groups)) {
      throw base::UserError(
          fmt::format("the displacements \"{}\" and \"{}\" prescribe different values for the {} of the node at ({})",
                      conditions[first].name, conditions[second].name, name_of_displacement(conditions[second]),
                      fmt::join(mesh.coordinates[node], ", ")));
    }
    for (const auto& condition : conditions) {
      if (moved_by(condition, groups) == nullptr) {
        on_nodes_.push_back(condition);
      } else {
        of_groups_.push_back(condition.value);
      }
    }
    follow_conditions();
  });
}

/// What holds at the present load factor.
template <int dim>
void Dirichlet<dim>::follow_conditions() {
  fixed_.assign(mesh_.n_nodes() * dim, 0);
  values_.assign(mesh_.n_nodes() * dim, Ramp<double>{0., 0.});
  oblique_.clear();
  for (const auto& condition : on_nodes_) {
    if (condition.value.holds_at(load_factor_)) prescribe(condition);
  }
  gather_oblique();
}

template <int dim>
void Dirichlet<dim>::prescribe(const PrescribedComponent& condition) {
  if (!condition.direction.empty()) return;
  PERIMORPH_ASSERT(condition.component >= 0 && condition.component < dim, "\"{}\" prescribes component {}",
                   condition.name, condition.component);
  for (const int node : mesh_.node_sets.at(condition.node_set)) {
    const int dof = node * dim + condition.component;
    fixed_[dof] = 1;
    values_[dof] = condition.value;
  }
}

/// What else is prescribed at those nodes counts among it.
template <int dim>
void Dirichlet<dim>::gather_oblique() {
  for (const auto& condition : on_nodes_) {
    if (condition.direction.empty() || !condition.value.holds_at(load_factor_)) continue;
    for (const int node : mesh_.node_sets.at(condition.node_set)) oblique_[node];
  }
  if (oblique_.empty()) return;
  for (const auto& condition : on_nodes_) {
    if (!condition.value.holds_at(load_factor_)) continue;
    for (const int node : mesh_.node_sets.at(condition.node_set)) {
      const auto found = oblique_.find(node);
      if (found != oblique_.end()) found->second.push_back({direction_of<dim>(condition), condition.value});
    }
  }
  for (const auto& [node, along] : oblique_) {
    std::fill_n(fixed_.begin() + static_cast<std::ptrdiff_t>(node) * dim, dim, 0);
  }
}

template <int dim>
bool Dirichlet<dim>::apply_load(double load_factor) {
  const double before = std::exchange(load_factor_, load_factor);
  const auto changes = [&](const Ramp<double>& value) { return value.holds_at(before) != value.holds_at(load_factor); };
  if (std::exchange(has_begun_, false)) std::fill(begun_.begin(), begun_.end(), 0);
  bool are_others = std::any_of(of_groups_.begin(), of_groups_.end(), changes);
  for (const auto& condition : on_nodes_) {
    if (!changes(condition.value)) continue;
    are_others = true;
    if (!condition.value.holds_at(load_factor) || !std::isfinite(condition.value.begin)) continue;
    PERIMORPH_ASSERT(condition.direction.empty(), "\"{}\" begins along a direction", condition.name);
    has_begun_ = true;
    for (const int node : mesh_.node_sets.at(condition.node_set)) begun_[node * dim + condition.component] = 1;
  }
  if (are_others) follow_conditions();
  return are_others;
}

namespace {

/// Integral of each corner's shape function times what `of` makes of the outward area, over a flat or bilinear side.
/// @param of an area vector, [length^(dim-1)]
template <class Of>
auto shape_integrals(const std::vector<Point<2>>& x, Of of) {
  using Integral = std::decay_t<decltype(of(Point<2>()))>;
  const Point<2> along = x[1] - x[0];
  return std::vector<Integral>(2, of(Point<2>(along[1], -along[0])) / 2.);
}

template <class Of>
auto shape_integrals(const std::vector<Point<3>>& x, Of of) {
  using Integral = std::decay_t<decltype(of(Point<3>()))>;
  if (x.size() == 3) return std::vector<Integral>(3, of(Point<3>((x[1] - x[0]).cross(x[2] - x[0]))) / 6.);
  std::vector<Integral> integrals(4, of(Point<3>(Point<3>::Zero())));
  const auto& square = elements::reference_element<2>(mesh::ElementType::quad4);
  for (int q = 0; q < square.n_points; ++q) {
    Point<3> along_xi = Point<3>::Zero(), along_eta = Point<3>::Zero();
    for (int k = 0; k < 4; ++k) {
      along_xi += square.gradients[q](0, k) * x[k];
      along_eta += square.gradients[q](1, k) * x[k];
    }
    const Integral area = of(Point<3>(along_xi.cross(along_eta)));
    for (int k = 0; k < 4; ++k) integrals[k] += square.shape[q](k) * square.weights[q] * area;
  }
  return integrals;
}

}  // namespace

template <int dim>
std::vector<double> Loads<dim>::forces(const mesh::Mesh<dim>& mesh, const elements::MaterialPoints<dim>& points,
                                       const DofMap<dim>& dofs, double load_factor) const {
  PERIMORPH_ASSERT(std::isfinite(load_factor), "load factor {}", load_factor);
  return integrate(mesh, points, dofs, [=](const auto& load) { return load.at(load_factor); });
}

template <int dim>
std::vector<double> Loads<dim>::rates(const mesh::Mesh<dim>& mesh, const elements::MaterialPoints<dim>& points,
                                      const DofMap<dim>& dofs) const {
  return integrate(mesh, points, dofs, [](const auto& load) { return load.rate; });
}

/// Forces on the nodes of what value(load) makes of each load.
template <int dim>
template <class Value>
std::vector<double> Loads<dim>::integrate(const mesh::Mesh<dim>& mesh, const elements::MaterialPoints<dim>& points,
                                          const DofMap<dim>& dofs, Value value) const {
  std::vector<double> forces(static_cast<std::size_t>(dofs.n_owned_nodes()) * dim, 0.);
  const auto add = [&](int node, const Point<dim>& force) {
    if (node >= dofs.n_owned_nodes()) return;
    for (int c = 0; c < dim; ++c) forces[node * dim + c] += force[c];
  };
  const auto add_on = [&](const std::string& side_set, const auto& of, const auto& factor) {
    for (const auto& side : mesh.side_sets.at(side_set)) {
      const auto integrals = shape_integrals(mesh::corner_points(mesh, side), of);
      const auto& corners = mesh::sides(mesh.types[side.element])[side.side];
      for (std::size_t k = 0; k < corners.size(); ++k) {
        add(dofs.nodes_of(side.element)[corners[k]], integrals[k] * factor);
      }
    }
  };
  for (const auto& traction : tractions_) {
    const Point<dim> per_area = value(traction.value);
    add_on(
        traction.side_set, [](const Point<dim>& area) { return area.norm(); }, per_area);
  }
  for (const auto& pressure : pressures_) {
    add_on(
        pressure.side_set, [](const Point<dim>& area) { return area; }, -value(pressure.value));
  }
  const Point<dim> anywhere = value(body_force_), acceleration = value(self_weight_.acceleration);
  if (anywhere.isZero(0.) && acceleration.isZero(0.)) return forces;
  for (int e = 0; e < mesh.n_elements(); ++e) {
    const auto density = self_weight_.densities.find(mesh.block_names[mesh.blocks[e]]);
    const bool is_other = density == self_weight_.densities.end();
    const Point<dim> body = anywhere + (is_other ? self_weight_.other_density : density->second) * acceleration;
    for (int q = 0; q < points.count(e); ++q) {
      const double volume = points.weight(points.first(e) + q);
      for (int k = 0; k < mesh.n_corners(e); ++k) {
        add(dofs.nodes_of(e)[k], points.shape(e, q)(k) * volume * body);
      }
    }
  }
  return forces;
}

template class Dirichlet<2>;
template class Dirichlet<3>;
template class Loads<2>;
template class Loads<3>;

}  // namespace perimorph::discretization
