// Bonds as springs in a matrix: K += Sum_bonds k [N_b - N_a]^T (xi (x) xi) [N_b - N_a]   [WHL19, eq. 22].

#include <algorithm>
#include <array>
#include <optional>

#include "perimorph/operators/bond_forces.hpp"
#include "perimorph/operators/stiffness_matrix.hpp"

namespace perimorph::operators {

namespace {

template <int dim>
using Block = Eigen::Matrix<double, dim, dim>;

/// k xi (x) xi of a bond, as a matrix takes it, or nothing if it does not select the bond.
template <int dim>
std::optional<Block<dim>> spring_in(const StiffnessMatrix<dim>& matrix, const CoupledModel<dim>& model,
                                    std::size_t bond, int i, int j) {
  const base::Point<dim> xi = model.points.position(j) - model.points.position(i);
  if (!matrix.selects(xi)) return std::nullopt;
  return matrix.selection().scale * model.spring(bond, i, j) * xi * xi.transpose();
}

}  // namespace

template <int dim>
void BondForces<dim>::couple(const StiffnessMatrix<dim>& matrix, Couplings<dim>& couplings) const {
  const auto& bonds = model_.bonds;
  const auto& points = model_.points;
  for (int p = 0; p < bonds.n_pairs(); ++p) {
    const auto [first, second] = bonds.pair(p);
    const bool is_by_points = matrix.is_by_points(first) || matrix.is_by_points(second);
    for (auto b = bonds.first_bond(p); b < bonds.first_bond(p + 1); ++b) {
      if (bonds.broken(b)) continue;
      const int i = bonds.first_end(b), j = bonds.second_end(b);
      if (!matrix.selects(points.position(points.first(second) + j) - points.position(points.first(first) + i))) {
        continue;
      }
      if (is_by_points) {
        couplings.add_nodes(matrix.nodes_at(first, i), matrix.nodes_at(second, j));
      } else {
        couplings.add_elements(first, second);
        break;
      }
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
    const int first_a = model_.points.first(pair.first), first_b = model_.points.first(pair.second);
    const int n_qb = model_.points.count(pair.second);
    bool has_springs = false;
    for (auto b = bonds.first_bond(p); b < bonds.first_bond(p + 1); ++b) {
      if (bonds.broken(b)) continue;
      const int i = first_a + bonds.first_end(b), j = first_b + bonds.second_end(b);
      const auto spring = spring_in(matrix, model_, b, i, j);
      if (!spring) continue;
      if (!has_springs)
        between.assign(static_cast<std::size_t>(model_.points.count(pair.first)) * n_qb, Block<dim>::Zero());
      has_springs = true;
      between[bonds.first_end(b) * n_qb + bonds.second_end(b)] = *spring;
      at_points[i] += *spring;
      at_points[j] += *spring;
    }
    if (has_springs) matrix.add_between(pair, between);
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
  const auto& bonds = model_.bonds;
  const auto& broken = change.broken;
  std::array<Block<dim>, elements::max_points> at_a, at_b;
  std::vector<Block<dim>> between;
  for (std::size_t next = 0; next < broken.size();) {
    const int p = bonds.pair_of(broken[next]);
    const auto& pair = bonds.pair(p);
    const int first_a = model_.points.first(pair.first), first_b = model_.points.first(pair.second);
    const int n_qa = model_.points.count(pair.first), n_qb = model_.points.count(pair.second);
    between.assign(static_cast<std::size_t>(n_qa) * n_qb, Block<dim>::Zero());
    std::fill_n(at_a.begin(), n_qa, Block<dim>::Zero());
    std::fill_n(at_b.begin(), n_qb, Block<dim>::Zero());
    bool has_springs = false;
    for (; next < broken.size() && broken[next] < bonds.first_bond(p + 1); ++next) {
      const int qa = bonds.first_end(broken[next]), qb = bonds.second_end(broken[next]);
      const auto spring = spring_in(matrix, model_, broken[next], first_a + qa, first_b + qb);
      if (!spring) continue;
      has_springs = true;
      between[qa * n_qb + qb] = -*spring;
      at_a[qa] -= *spring;
      at_b[qb] -= *spring;
    }
    if (!has_springs) continue;
    matrix.add_between(pair, between);
    matrix.add_at_points(pair.first, at_a.data());
    matrix.add_at_points(pair.second, at_b.data());
    for (const int element : {pair.first, pair.second}) matrix.append_owned_nodes(element, changed);
  }
}

template void BondForces<2>::couple(const StiffnessMatrix<2>&, Couplings<2>&) const;
template void BondForces<2>::add_to(StiffnessMatrix<2>&) const;
template void BondForces<2>::take(const bonds::BondChange&, StiffnessMatrix<2>&, std::vector<int>&) const;
template void BondForces<3>::couple(const StiffnessMatrix<3>&, Couplings<3>&) const;
template void BondForces<3>::add_to(StiffnessMatrix<3>&) const;
template void BondForces<3>::take(const bonds::BondChange&, StiffnessMatrix<3>&, std::vector<int>&) const;

}  // namespace perimorph::operators
