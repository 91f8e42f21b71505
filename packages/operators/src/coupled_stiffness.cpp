#include "perimorph/operators/coupled_stiffness.hpp"

#include <Tpetra_CrsMatrix.hpp>
#include <algorithm>
#include <array>
#include <numeric>

#include "perimorph/elements/strain.hpp"

namespace perimorph::operators {

namespace {

/// std::lower_bound, for the few columns of a row: counting has no branches, so the compiler makes vectors of it.
int lower_bound(const int* begin, const int* end, int value) {
  int n_smaller = 0;
  for (; begin != end; ++begin) n_smaller += static_cast<int>(*begin < value);
  return n_smaller;
}

}  // namespace

template <int dim>
CoupledStiffness<dim>::CoupledStiffness(const CoupledModel<dim>& model, const Supports<dim>& supports,
                                        const BondSelection& selection, Teuchos::RCP<const PointBasis<dim>> basis)
    : model_(model), selection_(selection), basis_(std::move(basis)), has_selected_bonds_(model.bonds.n_pairs(), 0) {
  for (const char fixed : supports.fixed) free_.push_back(fixed ? 0. : 1.);
  for (int p = 0; p < model.bonds.n_pairs(); ++p) {
    for (auto b = model.bonds.first_bond(p); b < model.bonds.first_bond(p + 1) && !has_selected_bonds_[p]; ++b) {
      has_selected_bonds_[p] = !model.bonds.broken(b) && is_selected(model.bonds.pair(p), b);
    }
  }
  find_pattern();
  make_matrix();
  for (int e = 0; e < model.mesh.n_elements(); ++e) {
    if (model.bonds.is_active(e) && !model.elasticity.is_zero(e)) add_element(e);
  }
  add_springs();
  add_diagonal(supports.diagonal);
}

template <int dim>
Teuchos::RCP<Tpetra::Operator<double>> CoupledStiffness<dim>::linear_operator() const {
  return matrix_;
}

template <int dim>
std::size_t CoupledStiffness<dim>::bytes() const {
  const auto local = matrix_->getLocalMatrixHost();
  return local.nnz() * (sizeof(double) + sizeof(int)) + (local.numRows() + std::size_t{1}) * sizeof(std::size_t);
}

/// By node, the nodes that bonds couple it to because one of their ends is an unknown. Owned nodes.
template <int dim>
std::vector<std::vector<int>> CoupledStiffness<dim>::nodes_bonded_by_points() const {
  std::vector<std::vector<int>> bonded(model_.dofs.n_owned_nodes());
  const auto nodes_at = [&](int element, int point) {
    const int* nodes = model_.dofs.nodes_of(element);
    return is_by_points(element) ? std::pair{nodes + point, nodes + point + 1}
                                 : std::pair{nodes, nodes + model_.mesh.n_corners(element)};
  };
  for (int p = 0; p < model_.bonds.n_pairs(); ++p) {
    const auto [first, second] = model_.bonds.pair(p);
    if (!has_selected_bonds_[p] || !(is_by_points(first) || is_by_points(second))) continue;
    for (auto b = model_.bonds.first_bond(p); b < model_.bonds.first_bond(p + 1); ++b) {
      if (model_.bonds.broken(b) || !is_selected(model_.bonds.pair(p), b)) continue;
      const auto [a, end_a] = nodes_at(first, model_.bonds.first_end(b));
      const auto [c, end_c] = nodes_at(second, model_.bonds.second_end(b));
      for (const int* i = a; i < end_a; ++i) {
        for (const int* j = c; j < end_c; ++j) {
          if (*i < model_.dofs.n_owned_nodes()) bonded[*i].push_back(*j);
          if (*j < model_.dofs.n_owned_nodes()) bonded[*j].push_back(*i);
        }
      }
    }
  }
  return bonded;
}

/// A node is coupled to all nodes of its elements and of the elements that these have bonds with.
template <int dim>
void CoupledStiffness<dim>::find_pattern() {
  const auto& mesh = model_.mesh;
  const auto& dofs = model_.dofs;
  std::vector<std::vector<int>> elements_of(dofs.n_owned_nodes());
  for (int e = 0; e < mesh.n_elements(); ++e) {
    for (int k = 0; k < mesh.n_corners(e); ++k) {
      const int node = dofs.nodes_of(e)[k];
      if (node < dofs.n_owned_nodes()) elements_of[node].push_back(e);
    }
  }
  const auto bonded_by_points = nodes_bonded_by_points();
  std::vector<int> seen_by(dofs.n_nodes(), -1);
  first_.push_back(0);
  for (int row = 0; row < dofs.n_owned_nodes(); ++row) {
    const auto include = [&](int node) {
      if (seen_by[node] == row) return;
      seen_by[node] = row;
      columns_.push_back(node);
    };
    const auto include_all = [&](int element) {
      for (int k = 0; k < mesh.n_corners(element); ++k) include(dofs.nodes_of(element)[k]);
    };
    include(row);
    for (const int node : bonded_by_points[row]) include(node);
    for (const int e : elements_of[row]) {
      if (is_by_points(e)) continue;
      include_all(e);
      for (const int p : model_.bonds.pairs_of(e)) {
        const auto [first, second] = model_.bonds.pair(p);
        const int other = first == e ? second : first;
        if (has_selected_bonds_[p] && !is_by_points(other)) include_all(other);
      }
    }
    std::sort(columns_.begin() + static_cast<std::ptrdiff_t>(first_.back()), columns_.end());
    first_.push_back(columns_.size());
  }
}

template <int dim>
void CoupledStiffness<dim>::make_matrix() {
  using Local = typename Matrix::local_matrix_device_type;
  const std::size_t n_rows = static_cast<std::size_t>(model_.dofs.n_owned_nodes()) * dim;
  const std::size_t n_entries = columns_.size() * dim * dim;
  typename Local::row_map_type::non_const_type row_starts("row starts", n_rows + 1);
  typename Local::index_type entries("columns", n_entries);
  typename Local::values_type values("values", n_entries);

  std::size_t position = 0;
  for (int row = 0; row < model_.dofs.n_owned_nodes(); ++row) {
    diagonal_.push_back(std::lower_bound(columns_.begin() + static_cast<std::ptrdiff_t>(first_[row]),
                                         columns_.begin() + static_cast<std::ptrdiff_t>(first_[row + 1]), row) -
                        columns_.begin());
    for (int c = 0; c < dim; ++c) {
      row_starts(row * dim + c) = position;
      for (std::size_t block = first_[row]; block < first_[row + 1]; ++block) {
        for (int d = 0; d < dim; ++d) entries(position++) = columns_[block] * dim + d;
      }
    }
  }
  row_starts(n_rows) = position;

  const auto& dofs = model_.dofs;
  matrix_ = Teuchos::rcp(new Matrix(dofs.owned_dofs(), dofs.all_dofs(), row_starts, entries, values));
  matrix_->expertStaticFillComplete(dofs.owned_dofs(), dofs.owned_dofs(), dofs.import());
  values_ = matrix_->getLocalMatrixHost().values.data();
}

template <int dim>
void CoupledStiffness<dim>::add_block(int row, int column, const Block& block) {
  if (block.isZero(0.)) return;  // perhaps no entry either
  const int* begin = columns_.data() + first_[row];
  const int* end = columns_.data() + first_[row + 1];
  const std::size_t width = static_cast<std::size_t>(end - begin) * dim;
  double* target = values_ + first_[row] * dim * dim + lower_bound(begin, end, column) * dim;
  const double* is_row_free = free_.data() + row * dim;
  const double* is_column_free = free_.data() + column * dim;
  for (int c = 0; c < dim; ++c) {
    for (int d = 0; d < dim; ++d) target[c * width + d] += is_row_free[c] * block(c, d) * is_column_free[d];
  }
}

template <int dim>
void CoupledStiffness<dim>::add_element(int element) {
  elements::with_corners<dim>(model_.mesh.n_corners(element), [&](auto corners) {
    constexpr int n = decltype(corners)::value;
    Eigen::Matrix<double, dim * n, dim* n> k = Eigen::Matrix<double, dim * n, dim * n>::Zero();
    for (int q = 0; q < model_.points.count(element); ++q) {
      const auto b = elements::strain_matrix<dim, n>(model_.points.gradients(element, q));
      const base::Stiffness<dim> e =
          model_.points.weight(model_.points.first(element) + q) * model_.elasticity.at(element, q);
      k.noalias() += b.transpose() * (e * b);
    }
    const int* nodes = model_.dofs.nodes_of(element);
    for (int i = 0; i < n; ++i) {
      if (nodes[i] >= model_.dofs.n_owned_nodes()) continue;
      for (int j = 0; j < n; ++j) add_block(nodes[i], nodes[j], k.template block<dim, dim>(i * dim, j * dim));
    }
  });
}

/// Adds the springs at an element's points, (n_points) blocks: K += N^T diag(at_points) N.
template <int dim>
void CoupledStiffness<dim>::add_at_points(int element, const Block* at_points) {
  const int* nodes = model_.dofs.nodes_of(element);
  for (int k = 0; k < model_.mesh.n_corners(element); ++k) {
    if (nodes[k] >= model_.dofs.n_owned_nodes()) continue;
    for (int l = 0; l < model_.mesh.n_corners(element); ++l) {
      Block block = Block::Zero();
      for (int q = 0; q < model_.points.count(element); ++q) {
        block += shape(element, q, k) * shape(element, q, l) * at_points[q];
      }
      add_block(nodes[k], nodes[l], block);
    }
  }
}

/// Subtracts the springs between the points of two elements, (n_points, n_points) blocks: K -= N_a^T between N_b, and
/// its transpose.
template <int dim>
void CoupledStiffness<dim>::add_between(const bonds::ElementPair& pair, const std::vector<Block>& between) {
  const auto [a, b] = pair;
  const int* nodes_a = model_.dofs.nodes_of(a);
  const int* nodes_b = model_.dofs.nodes_of(b);
  const int n_qa = model_.points.count(a), n_qb = model_.points.count(b);
  for (int l = 0; l < model_.mesh.n_corners(b); ++l) {
    std::array<Block, elements::max_points> half;  // between N_b, for corner l
    for (int qa = 0; qa < n_qa; ++qa) {
      half[qa].setZero();
      for (int qb = 0; qb < n_qb; ++qb) half[qa] += shape(b, qb, l) * between[qa * n_qb + qb];
    }
    for (int k = 0; k < model_.mesh.n_corners(a); ++k) {
      Block block = Block::Zero();
      for (int qa = 0; qa < n_qa; ++qa) block -= shape(a, qa, k) * half[qa];
      if (nodes_a[k] < model_.dofs.n_owned_nodes()) add_block(nodes_a[k], nodes_b[l], block);
      if (nodes_b[l] < model_.dofs.n_owned_nodes()) add_block(nodes_b[l], nodes_a[k], block.transpose());
    }
  }
}

/// K += Sum_bonds k [N_b - N_a]^T (xi (x) xi) [N_b - N_a]   [WHL19, eq. 22], pair by pair of elements.
template <int dim>
void CoupledStiffness<dim>::add_springs() {
  std::vector<Block> at_points(model_.points.size(), Block::Zero());
  std::vector<Block> between;
  for (int p = 0; p < model_.bonds.n_pairs(); ++p) {
    if (!has_selected_bonds_[p]) continue;
    const auto& pair = model_.bonds.pair(p);
    const int first_a = model_.points.first(pair.first), first_b = model_.points.first(pair.second);
    const int n_qb = model_.points.count(pair.second);
    between.assign(model_.points.count(pair.first) * n_qb, Block::Zero());
    for (auto b = model_.bonds.first_bond(p); b < model_.bonds.first_bond(p + 1); ++b) {
      if (model_.bonds.broken(b) || !is_selected(pair, b)) continue;
      const int i = first_a + model_.bonds.first_end(b), j = first_b + model_.bonds.second_end(b);
      const Block spring = spring_block(b, i, j);
      between[model_.bonds.first_end(b) * n_qb + model_.bonds.second_end(b)] = spring;
      at_points[i] += spring;
      at_points[j] += spring;
    }
    add_between(pair, between);
  }
  for (int e = 0; e < model_.mesh.n_elements(); ++e) {
    if (model_.bonds.is_active(e) && !model_.bonds.pairs_of(e).empty()) {
      add_at_points(e, at_points.data() + model_.points.first(e));
    }
  }
}

template <int dim>
std::vector<int> CoupledStiffness<dim>::subtract(const std::vector<std::size_t>& broken) {
  std::vector<int> changed;
  std::array<Block, elements::max_points> at_a, at_b;
  std::vector<Block> between;
  for (std::size_t next = 0; next < broken.size();) {
    const int p = model_.bonds.pair_of(broken[next]);
    const auto& pair = model_.bonds.pair(p);
    const int first_a = model_.points.first(pair.first), first_b = model_.points.first(pair.second);
    const int n_qa = model_.points.count(pair.first), n_qb = model_.points.count(pair.second);
    between.assign(n_qa * n_qb, Block::Zero());
    std::fill_n(at_a.begin(), n_qa, Block::Zero());
    std::fill_n(at_b.begin(), n_qb, Block::Zero());
    for (; next < broken.size() && broken[next] < model_.bonds.first_bond(p + 1); ++next) {
      if (!is_selected(pair, broken[next])) continue;
      const int qa = model_.bonds.first_end(broken[next]), qb = model_.bonds.second_end(broken[next]);
      const Block spring = spring_block(broken[next], first_a + qa, first_b + qb);
      between[qa * n_qb + qb] = -spring;
      at_a[qa] -= spring;
      at_b[qb] -= spring;
    }
    if (!has_selected_bonds_[p]) continue;
    add_between(pair, between);
    add_at_points(pair.first, at_a.data());
    add_at_points(pair.second, at_b.data());
    for (const int element : {pair.first, pair.second}) {
      const int* nodes = model_.dofs.nodes_of(element);
      std::copy_if(nodes, nodes + model_.mesh.n_corners(element), std::back_inserter(changed),
                   [&](int node) { return node < model_.dofs.n_owned_nodes(); });
    }
  }
  return changed;
}

template <int dim>
typename CoupledStiffness<dim>::Block CoupledStiffness<dim>::spring_block(std::size_t bond, int i, int j) const {
  const base::Point<dim> xi = model_.points.position(j) - model_.points.position(i);
  return selection_.scale * model_.spring(bond, i, j) * xi * xi.transpose();
}

template <int dim>
base::Point<dim> CoupledStiffness<dim>::bond_vector(const bonds::ElementPair& pair, std::size_t bond) const {
  return model_.points.position(model_.points.first(pair.second) + model_.bonds.second_end(bond)) -
         model_.points.position(model_.points.first(pair.first) + model_.bonds.first_end(bond));
}

template <int dim>
void CoupledStiffness<dim>::add_diagonal(const std::vector<double>& diagonal) {
  for (int row = 0; row < model_.dofs.n_owned_nodes(); ++row) {
    const std::size_t width = (first_[row + 1] - first_[row]) * dim;
    for (int c = 0; c < dim; ++c) {
      values_[first_[row] * dim * dim + c * width + (diagonal_[row] - first_[row]) * dim + c] +=
          diagonal[row * dim + c];
    }
  }
}

template <int dim>
BondSelection short_range(const CoupledModel<dim>& model, const base::Comm& comm, double reach) {
  std::vector<double> sums = {0., 0.};  // all bonds, selected bonds
  for (int p = 0; p < model.bonds.n_pairs(); ++p) {
    const auto [first, second] = model.bonds.pair(p);
    if (first >= model.mesh.n_owned_elements) continue;
    for (auto b = model.bonds.first_bond(p); b < model.bonds.first_bond(p + 1); ++b) {
      const int i = model.points.first(first) + model.bonds.first_end(b);
      const int j = model.points.first(second) + model.bonds.second_end(b);
      const double squared = (model.points.position(j) - model.points.position(i)).squaredNorm();
      const double stiffness = model.spring(b, i, j) * squared * squared;
      sums[0] += stiffness;
      if (squared <= reach * reach) sums[1] += stiffness;
    }
  }
  base::sum(comm, sums);
  return {reach, sums[1] > 0. ? sums[0] / sums[1] : 1.};
}

template BondSelection short_range<2>(const CoupledModel<2>&, const base::Comm&, double);
template BondSelection short_range<3>(const CoupledModel<3>&, const base::Comm&, double);
template class CoupledStiffness<2>;
template class CoupledStiffness<3>;

}  // namespace perimorph::operators
