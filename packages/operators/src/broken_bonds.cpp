#include "perimorph/operators/broken_bonds.hpp"

namespace perimorph::operators {

using base::Point;

namespace {

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

}  // namespace

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

template <int dim>
double bond_energy(const CoupledModel<dim>& model, const std::vector<std::size_t>& bonds,
                   const std::vector<Point<dim>>& at_points) {
  double energy = 0.;
  for (const auto b : bonds) {
    const auto [first, second] = model.bonds.pair(model.bonds.pair_of(b));
    if (first >= model.mesh.n_owned_elements) continue;
    const int i = model.points.first(first) + model.bonds.first_end(b);
    const int j = model.points.first(second) + model.bonds.second_end(b);
    const Point<dim> xi = model.points.position(j) - model.points.position(i);
    const double stretch = xi.dot(at_points[j] - at_points[i]);
    energy += 0.5 * model.spring(b, i, j) * stretch * stretch;
  }
  return energy;
}

template void subtract_bond_forces<2>(const CoupledModel<2>&, const std::vector<std::size_t>&,
                                      const std::vector<Point<2>>&, std::vector<double>&);
template void subtract_bond_forces<3>(const CoupledModel<3>&, const std::vector<std::size_t>&,
                                      const std::vector<Point<3>>&, std::vector<double>&);
template double bond_energy<2>(const CoupledModel<2>&, const std::vector<std::size_t>&, const std::vector<Point<2>>&);
template double bond_energy<3>(const CoupledModel<3>&, const std::vector<std::size_t>&, const std::vector<Point<3>>&);

}  // namespace perimorph::operators
