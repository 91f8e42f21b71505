// Bonds as springs in a matrix: K += Sum_bonds k [N_b - N_a]^T (xi (x) xi) [N_b - N_a]   [WHL19, eq. 22].

#include <algorithm>
#include <array>

#include "perimorph/operators/bond_forces.hpp"
#include "point_springs.hpp"

namespace perimorph::operators {

namespace {

template <int dim>
using Block = Eigen::Matrix<double, dim, dim>;

/// k xi (x) xi of a bond, as a matrix takes it. @param stiffness k, [force / length^3]
template <int dim>
Block<dim> spring_in(const StiffnessMatrix<dim>& matrix, const bonds::Bond<dim>& bond, double stiffness) {
  return matrix.selection().scale * stiffness * bond.xi * bond.xi.transpose();
}

/// What bonds lose, by ascending bond, as stiffness, [force / length^3].
template <int dim>
std::vector<std::pair<bonds::BondId, double>> losses(const CoupledModel<dim>& model, const bonds::BondChange& change) {
  std::vector<std::pair<bonds::BondId, double>> all;
  for (const auto b : change.broken) all.emplace_back(b, model.spring(model.bonds.bond(b)));
  const auto n_broken = static_cast<std::ptrdiff_t>(all.size());
  for (const auto& [b, stretch, loss] : change.softened) {
    all.emplace_back(b, loss * model.intact_spring(model.bonds.bond(b)));
  }
  std::inplace_merge(all.begin(), all.begin() + n_broken, all.end());
  return all;
}

}  // namespace

template <int dim>
void BondForces<dim>::couple(const StiffnessMatrix<dim>& matrix, Couplings<dim>& couplings) const {
  const auto& bonds = model_.bonds;
  for (int p = 0; p < bonds.n_pairs(); ++p) {
    const auto [first, second] = bonds.pair(p);
    const bool is_by_points = matrix.is_by_points(first) || matrix.is_by_points(second);
    for (auto b = bonds.first_bond(p); b < bonds.first_bond(p + 1); ++b) {
      const auto bond = bonds.bond(p, b);
      if (bond.is_broken || !matrix.selects(bond.xi)) continue;
      if (!is_by_points) {
        couplings.add_elements(first, second);
        break;
      }
      couplings.add_nodes(matrix.nodes_at(first, bond.first_end), matrix.nodes_at(second, bond.second_end));
    }
  }
}

/// Pair by pair of elements, then the springs at each element's points.
template <int dim>
void BondForces<dim>::add_to(StiffnessMatrix<dim>& matrix) const {
  const auto& bonds = model_.bonds;
  std::vector<Block<dim>> at_points(model_.points.size(), Block<dim>::Zero());
  std::vector<Block<dim>> between;
  for (int p = 0; p < bonds.n_pairs(); ++p) {
    const auto& pair = bonds.pair(p);
    const int n_first = model_.points.count(pair.first), n_second = model_.points.count(pair.second);
    between.clear();
    bonds.for_each_bond(p, [&](const bonds::Bond<dim>& bond) {
      if (bond.is_broken || !matrix.selects(bond.xi)) return;
      if (between.empty()) between.assign(static_cast<std::size_t>(n_first) * n_second, Block<dim>::Zero());
      const Block<dim> spring = spring_in(matrix, bond, model_.spring(bond));
      between[bond.first_end * n_second + bond.second_end] = spring;
      at_points[bond.first_point] += spring;
      at_points[bond.second_point] += spring;
    });
    if (!between.empty()) matrix.add_between(pair, between);
  }
  for (int e = 0; e < model_.mesh.n_elements(); ++e) {
    if (bonds.is_active(e) && !bonds.pairs_of(e).empty()) {
      matrix.add_at_points(e, at_points.data() + model_.points.first(e));
    }
  }
}

template <int dim>
void BondForces<dim>::take(const bonds::BondChange& change, StiffnessMatrix<dim>& matrix,
                           std::vector<int>& changed) const {
  std::vector<PointSpring<dim>> springs;
  for (const auto& [id, loss] : losses(model_, change)) {
    const auto bond = model_.bonds.bond(id);
    if (!matrix.selects(bond.xi)) continue;
    springs.push_back(
        {{bond.first_element, bond.second_element}, bond.first_end, bond.second_end, -spring_in(matrix, bond, loss)});
  }
  add_springs(model_, springs, matrix, changed);
}

template <int dim>
void add_springs(const CoupledModel<dim>& model, const std::vector<PointSpring<dim>>& springs,
                 StiffnessMatrix<dim>& matrix, std::vector<int>& changed) {
  std::array<Block<dim>, elements::max_points> at_first, at_second;
  std::vector<Block<dim>> between;
  for (auto next = springs.begin(); next != springs.end();) {
    const auto pair = next->pair;
    const int n_first = model.points.count(pair.first), n_second = model.points.count(pair.second);
    between.assign(static_cast<std::size_t>(n_first) * n_second, Block<dim>::Zero());
    std::fill_n(at_first.begin(), n_first, Block<dim>::Zero());
    std::fill_n(at_second.begin(), n_second, Block<dim>::Zero());
    for (; next != springs.end() && next->pair == pair; ++next) {
      between[next->first_end * n_second + next->second_end] += next->stiffness;
      at_first[next->first_end] += next->stiffness;
      at_second[next->second_end] += next->stiffness;
    }
    matrix.add_between(pair, between);
    matrix.add_at_points(pair.first, at_first.data());
    matrix.add_at_points(pair.second, at_second.data());
    for (const int element : {pair.first, pair.second}) matrix.append_owned_nodes(element, changed);
  }
}

template void add_springs<2>(const CoupledModel<2>&, const std::vector<PointSpring<2>>&, StiffnessMatrix<2>&,
                             std::vector<int>&);
template void add_springs<3>(const CoupledModel<3>&, const std::vector<PointSpring<3>>&, StiffnessMatrix<3>&,
                             std::vector<int>&);
template void BondForces<2>::couple(const StiffnessMatrix<2>&, Couplings<2>&) const;
template void BondForces<2>::add_to(StiffnessMatrix<2>&) const;
template void BondForces<2>::take(const bonds::BondChange&, StiffnessMatrix<2>&, std::vector<int>&) const;
template void BondForces<3>::couple(const StiffnessMatrix<3>&, Couplings<3>&) const;
template void BondForces<3>::add_to(StiffnessMatrix<3>&) const;
template void BondForces<3>::take(const bonds::BondChange&, StiffnessMatrix<3>&, std::vector<int>&) const;

}  // namespace perimorph::operators
