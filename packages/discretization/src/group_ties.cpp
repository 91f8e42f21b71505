#include "perimorph/discretization/group_ties.hpp"

#include <Eigen/Eigenvalues>
#include <Tpetra_Map.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "perimorph/base/errors.hpp"
#include "perimorph/base/parallel.hpp"

namespace perimorph::discretization {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Columns that span the same, orthonormal over the rows of all ranks; fewer where some depend on others. Collective.
/// @param n_owned of the rows, which come first
MatrixXd orthonormal(const base::Comm& comm, const MatrixXd& columns, Index n_owned) {
  constexpr double independent = 1e-10;  // of squared lengths
  if (columns.cols() == 0) return columns;
  const auto own = columns.topRows(n_owned);
  const MatrixXd products = own.transpose() * own;
  std::vector<double> sums(products.data(), products.data() + products.size());
  base::sum(comm, sums);
  const Eigen::Map<const MatrixXd> all(sums.data(), products.rows(), products.cols());
  const VectorXd scale =
      all.diagonal().unaryExpr([](double square) { return square > 0. ? 1. / std::sqrt(square) : 0.; });
  const Eigen::SelfAdjointEigenSolver<MatrixXd> modes(scale.asDiagonal() * all * scale.asDiagonal());
  MatrixXd result(columns.rows(), 0);
  for (Index i = 0; i < columns.cols(); ++i) {
    const double square = modes.eigenvalues()[i];
    if (square <= independent) continue;
    result.conservativeResize(Eigen::NoChange, result.cols() + 1);
    result.rightCols(1) = columns * (scale.asDiagonal() * modes.eigenvectors().col(i)) / std::sqrt(square);
  }
  return result;
}

}  // namespace

template <int dim>
GroupTies<dim>::GroupTies(const DofMap<dim>& dofs, const std::vector<GroupMotion<dim>>& groups, double load_factor)
    : comm_(dofs.owned_dofs()->getComm()), n_owned_(dofs.n_owned_nodes() * dim) {
  for (const auto& group : groups) ties_.push_back(make(dofs, group, load_factor));
}

template <int dim>
typename GroupTies<dim>::Tie GroupTies<dim>::make(const DofMap<dim>& dofs, const GroupMotion<dim>& group,
                                                  double load_factor) const {
  Tie tie;
  std::vector<base::Point<dim>> arms;  // of the degrees of freedom
  for (int n = 0; n < dofs.n_real_nodes(); ++n) {
    const auto found = std::lower_bound(group.nodes.begin(), group.nodes.end(), dofs.reference_node(n));
    if (found == group.nodes.end() || *found != dofs.reference_node(n)) continue;
    for (int c = 0; c < dim; ++c) {
      if (group.shared_component >= 0 && c != group.shared_component) continue;
      tie.dofs.push_back(n * dim + c);
      arms.push_back(group.arms[found - group.nodes.begin()]);
    }
  }
  const auto n_rows = static_cast<Index>(tie.dofs.size());
  std::array<const Ramp<double>*, GroupMotion<dim>::n_motions> prescribed{};
  for (const auto& [motion, value] : group.prescribed) {
    if (value.holds_at(load_factor)) prescribed[motion] = &value;
  }
  MatrixXd free(n_rows, 0);
  tie.prescribed.resize(n_rows, 0);
  for (int motion = 0; motion < GroupMotion<dim>::n_motions; ++motion) {
    if (group.shared_component >= 0 && motion != group.shared_component) continue;
    auto& columns = prescribed[motion] == nullptr ? free : tie.prescribed;
    columns.conservativeResize(Eigen::NoChange, columns.cols() + 1);
    for (Index i = 0; i < n_rows; ++i) {
      columns(i, columns.cols() - 1) = rigid_displacement<dim>(motion, arms[i])[tie.dofs[i] % dim];
    }
    if (prescribed[motion] != nullptr) tie.values.push_back(*prescribed[motion]);
  }
  tie.free = orthonormal(*comm_, free, std::lower_bound(tie.dofs.begin(), tie.dofs.end(), n_owned_) - tie.dofs.begin());
  return tie;
}

template <int dim>
std::vector<int> GroupTies<dim>::dofs() const {
  std::vector<int> all;
  for (const auto& tie : ties_) all.insert(all.end(), tie.dofs.begin(), tie.dofs.end());
  std::sort(all.begin(), all.end());
  return all;
}

template <int dim>
std::vector<int> GroupTies<dim>::owned_dofs() const {
  auto own = dofs();
  own.erase(std::lower_bound(own.begin(), own.end(), n_owned_), own.end());
  return own;
}

template <int dim>
std::vector<std::vector<int>> GroupTies<dim>::nodes() const {
  std::vector<std::vector<int>> groups;
  for (const auto& tie : ties_) {
    groups.emplace_back();
    for (const int dof : tie.dofs) groups.back().push_back(dof / dim);
  }
  return groups;
}

template <int dim>
std::vector<std::vector<double>> GroupTies<dim>::free_motions() const {
  std::vector<std::vector<double>> motions;
  for (const auto& tie : ties_) {
    for (Index motion = 0; motion < tie.free.cols(); ++motion) {
      motions.emplace_back(n_owned_, 0.);
      for (std::size_t i = 0; i < tie.dofs.size() && tie.dofs[i] < n_owned_; ++i) {
        motions.back()[tie.dofs[i]] = tie.free(static_cast<Index>(i), motion);
      }
    }
  }
  return motions;
}

template <int dim>
bool GroupTies<dim>::decides(int node, int component) const {
  constexpr double seen = 1e-6;
  const int dof = node * dim + component;
  return std::any_of(ties_.begin(), ties_.end(), [&](const Tie& tie) {
    const auto found = std::lower_bound(tie.dofs.begin(), tie.dofs.end(), dof);
    return found != tie.dofs.end() && *found == dof && tie.prescribed.row(found - tie.dofs.begin()).norm() > seen;
  });
}

/// Adds the prescribed motions times what of(ramp) makes of each. Local.
template <int dim>
template <class Of>
void GroupTies<dim>::add_prescribed(base::Field field, Of of) const {
  for (const auto& tie : ties_) {
    VectorXd values(tie.values.size());
    std::transform(tie.values.begin(), tie.values.end(), values.begin(), of);
    const VectorXd displacement = tie.prescribed * values;
    for (std::size_t i = 0; i < tie.dofs.size(); ++i) field[tie.dofs[i]] += displacement[static_cast<Index>(i)];
  }
}

template <int dim>
void GroupTies<dim>::prescribe(base::Field u, double load_factor) const {
  if (is_empty()) return;
  add_prescribed(u, [&](const auto& ramp) { return -ramp.at(load_factor); });
  project(u);
  add_prescribed(u, [&](const auto& ramp) { return ramp.at(load_factor); });
}

template <int dim>
void GroupTies<dim>::add_rates(base::Field rates, double load_factor, double step) const {
  add_prescribed(rates, [&](const auto& ramp) { return ramp.rate_in(load_factor, step); });
}

template <int dim>
void GroupTies<dim>::project(base::Field values) const {
  if (is_empty()) return;
  std::vector<double> parts;
  for (const auto& tie : ties_) {
    const auto first = static_cast<Index>(parts.size());
    parts.resize(parts.size() + tie.free.cols(), 0.);
    Eigen::Map<VectorXd> own(parts.data() + first, tie.free.cols());
    for (std::size_t i = 0; i < tie.dofs.size() && tie.dofs[i] < n_owned_; ++i) {
      own += values[tie.dofs[i]] * tie.free.row(static_cast<Index>(i)).transpose();
    }
  }
  base::sum(*comm_, parts);
  const double* next = parts.data();
  for (const auto& tie : ties_) {
    const VectorXd combined = tie.free * Eigen::Map<const VectorXd>(next, tie.free.cols());
    next += tie.free.cols();
    for (std::size_t i = 0; i < tie.dofs.size() && tie.dofs[i] < values.size(); ++i) {
      values[tie.dofs[i]] = combined[static_cast<Index>(i)];
    }
  }
}

template class GroupTies<2>;
template class GroupTies<3>;

}  // namespace perimorph::discretization
