#include "perimorph/operators/broken_bonds.hpp"

#include "perimorph/base/errors.hpp"

namespace perimorph::operators {

using base::Point;

namespace {

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
                          const PointFields<dim>& at_points, std::vector<double>& force) {
  PERIMORPH_ASSERT(static_cast<int>(at_points.displacement.size()) == model.points.size(),
                   "displacements at {} of {} points", at_points.displacement.size(), model.points.size());
  PERIMORPH_ASSERT(static_cast<int>(force.size()) == model.dofs.n_owned_nodes() * dim, "{} forces on {} owned nodes",
                   force.size(), model.dofs.n_owned_nodes());
  for (const auto b : broken) {
    const auto bond = model.bonds.bond(b);
    const Point<dim> pull = BondSpring<dim>(model, bond, at_points).pull();
    spread(model, bond.first_element, bond.first_end, pull, force);
    spread<dim>(model, bond.second_element, bond.second_end, -pull, force);
  }
}

template <int dim>
double bond_energy(const CoupledModel<dim>& model, const std::vector<std::size_t>& bonds,
                   const PointFields<dim>& at_points) {
  PERIMORPH_ASSERT(static_cast<int>(at_points.displacement.size()) == model.points.size(),
                   "displacements at {} of {} points", at_points.displacement.size(), model.points.size());
  double energy = 0.;
  for (const auto b : bonds) {
    const auto bond = model.bonds.bond(b);
    if (bond.first_element >= model.mesh.n_owned_elements) continue;
    energy += BondSpring<dim>(model, bond, at_points).energy();
  }
  return energy;
}

template void subtract_bond_forces<2>(const CoupledModel<2>&, const std::vector<std::size_t>&, const PointFields<2>&,
                                      std::vector<double>&);
template void subtract_bond_forces<3>(const CoupledModel<3>&, const std::vector<std::size_t>&, const PointFields<3>&,
                                      std::vector<double>&);
template double bond_energy<2>(const CoupledModel<2>&, const std::vector<std::size_t>&, const PointFields<2>&);
template double bond_energy<3>(const CoupledModel<3>&, const std::vector<std::size_t>&, const PointFields<3>&);

}  // namespace perimorph::operators
