#include "perimorph/operators/internal_force.hpp"

#include "perimorph/elements/strain.hpp"

namespace perimorph::operators {

using base::Point;

namespace {

/// Corner displacements of an element, node by node, (dim * n).
template <int dim, int n>
Eigen::Matrix<double, dim * n, 1> gather(const int* nodes, const double* u) {
  Eigen::Matrix<double, dim * n, 1> d;
  for (int k = 0; k < n; ++k) d.template segment<dim>(k * dim) = Eigen::Map<const Point<dim>>(u + nodes[k] * dim);
  return d;
}

template <int dim>
void add_local_forces(const CoupledModel<dim>& model, const double* u, std::vector<double>& force) {
  for (int e = 0; e < model.mesh.n_elements(); ++e) {
    if (!model.bonds.is_active(e) || model.elasticity.is_zero(e)) continue;
    elements::with_corners<dim>(model.mesh.n_corners(e), [&](auto corners) {
      constexpr int n = decltype(corners)::value;
      const int* nodes = model.dofs.nodes_of(e);
      const auto d = gather<dim, n>(nodes, u);
      Eigen::Matrix<double, dim * n, 1> f = Eigen::Matrix<double, dim * n, 1>::Zero();
      for (int q = 0; q < model.points.count(e); ++q) {
        const auto b = elements::strain_matrix<dim, n>(model.points.gradients(e, q));
        const base::Voigt<dim> stress = model.elasticity.at(e, q) * (b * d);
        f += model.points.weight(model.points.first(e) + q) * b.transpose() * stress;
      }
      for (int k = 0; k < n; ++k) {
        if (nodes[k] >= model.dofs.n_owned_nodes()) continue;
        for (int c = 0; c < dim; ++c) force[nodes[k] * dim + c] += f[k * dim + c];
      }
    });
  }
}

/// Pull of a bond on its first point, [force].
template <int dim>
Point<dim> pull(const CoupledModel<dim>& model, std::size_t bond, int i, int j, const std::vector<Point<dim>>& u) {
  const Point<dim> xi = model.points.position(j) - model.points.position(i);
  return model.spring(bond, i, j) * xi.dot(u[j] - u[i]) * xi;
}

/// Spreads a force at a point of an element to the owned nodes among its corners.
template <int dim>
void spread(const CoupledModel<dim>& model, int element, int q, const Point<dim>& at_point,
            std::vector<double>& force) {
  const int* nodes = model.dofs.nodes_of(element);
  const auto& shape = model.points.shape(element, q);
  for (int k = 0; k < model.mesh.n_corners(element); ++k) {
    if (nodes[k] >= model.dofs.n_owned_nodes()) continue;
    for (int c = 0; c < dim; ++c) force[nodes[k] * dim + c] += shape[k] * at_point[c];
  }
}

template <int dim>
std::vector<Point<dim>> bond_forces(const CoupledModel<dim>& model, const std::vector<Point<dim>>& u) {
  std::vector<Point<dim>> force(u.size(), Point<dim>::Zero());
  for (int p = 0; p < model.bonds.n_pairs(); ++p) {
    const auto [first, second] = model.bonds.pair(p);
    const int first_a = model.points.first(first), first_b = model.points.first(second);
    for (auto b = model.bonds.first_bond(p); b < model.bonds.first_bond(p + 1); ++b) {
      if (model.bonds.broken(b)) continue;
      const int i = first_a + model.bonds.first_end(b), j = first_b + model.bonds.second_end(b);
      const Point<dim> f = pull(model, b, i, j, u);
      force[i] -= f;
      force[j] += f;
    }
  }
  return force;
}

}  // namespace

template <int dim>
std::vector<Point<dim>> displacements_at_points(const CoupledModel<dim>& model, const double* u) {
  std::vector<Point<dim>> at_points(model.points.size(), Point<dim>::Zero());
  for (int e = 0; e < model.mesh.n_elements(); ++e) {
    if (model.bonds.pairs_of(e).empty()) continue;
    const int* nodes = model.dofs.nodes_of(e);
    for (int q = 0; q < model.points.count(e); ++q) {
      const auto& shape = model.points.shape(e, q);
      Point<dim>& value = at_points[model.points.first(e) + q];
      for (int k = 0; k < model.mesh.n_corners(e); ++k) {
        value += shape[k] * Eigen::Map<const Point<dim>>(u + nodes[k] * dim);
      }
    }
  }
  return at_points;
}

template <int dim>
std::vector<double> internal_force(const CoupledModel<dim>& model, const double* u,
                                   const std::vector<Point<dim>>& at_points) {
  std::vector<double> force(static_cast<std::size_t>(model.dofs.n_owned_nodes()) * dim, 0.);
  add_local_forces(model, u, force);
  const auto at_point = bond_forces(model, at_points);
  for (int e = 0; e < model.mesh.n_elements(); ++e) {
    if (!model.bonds.is_active(e) || model.bonds.pairs_of(e).empty()) continue;
    for (int q = 0; q < model.points.count(e); ++q) spread(model, e, q, at_point[model.points.first(e) + q], force);
  }
  return force;
}

template <int dim>
void subtract_bond_forces(const CoupledModel<dim>& model, const std::vector<std::size_t>& broken,
                          const std::vector<Point<dim>>& at_points, std::vector<double>& force) {
  for (const auto b : broken) {
    const auto [first, second] = model.bonds.pair(model.bonds.pair_of(b));
    const int qa = model.bonds.first_end(b), qb = model.bonds.second_end(b);
    const Point<dim> f = pull(model, b, model.points.first(first) + qa, model.points.first(second) + qb, at_points);
    spread(model, first, qa, f, force);
    spread<dim>(model, second, qb, -f, force);
  }
}

template std::vector<Point<2>> displacements_at_points<2>(const CoupledModel<2>&, const double*);
template std::vector<Point<3>> displacements_at_points<3>(const CoupledModel<3>&, const double*);
template std::vector<double> internal_force<2>(const CoupledModel<2>&, const double*, const std::vector<Point<2>>&);
template std::vector<double> internal_force<3>(const CoupledModel<3>&, const double*, const std::vector<Point<3>>&);

template void subtract_bond_forces<2>(const CoupledModel<2>&, const std::vector<std::size_t>&,
                                      const std::vector<Point<2>>&, std::vector<double>&);
template void subtract_bond_forces<3>(const CoupledModel<3>&, const std::vector<std::size_t>&,
                                      const std::vector<Point<3>>&, std::vector<double>&);
}  // namespace perimorph::operators
