#include "perimorph/operators/stiffness_matrix.hpp"

#include <Tpetra_CrsMatrix.hpp>
#include <algorithm>
#include <array>
#include <numeric>

#include "perimorph/base/errors.hpp"

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
void Couplings<dim>::add_elements(int first, int second) {
  const auto n = static_cast<int>(elements.size());
  PERIMORPH_DEBUG_ASSERT(first >= 0 && first < n && second >= 0 && second < n, "elements {} and {} of {}", first,
                         second, n);
  elements[first].push_back(second);
  elements[second].push_back(first);
}

template <int dim>
void Couplings<dim>::add_nodes(const Nodes& first, const Nodes& second) {
  const auto n_owned = static_cast<int>(nodes.size());
  for (const int* i = first.first; i < first.second; ++i) {
    for (const int* j = second.first; j < second.second; ++j) {
      if (*i < n_owned) nodes[*i].push_back(*j);
      if (*j < n_owned) nodes[*j].push_back(*i);
    }
  }
}

template <int dim>
StiffnessMatrix<dim>::StiffnessMatrix(const CoupledModel<dim>& model, const discretization::Space<dim>& space,
                                      ForceTerms<dim> terms, const std::vector<double>& constraints,
                                      const BondSelection& selection, Teuchos::RCP<const PointBasis<dim>> basis)
    : model_(model),
      space_(space),
      terms_(std::move(terms)),
      selection_(selection),
      basis_(std::move(basis)),
      free_(space.n_local(), 1.) {
  PERIMORPH_ASSERT(constraints.size() == space.n_owned(), "{} constraints for {} degrees of freedom",
                   constraints.size(), space.n_owned());
  PERIMORPH_ASSERT(selection_.reach > 0. && selection_.scale > 0., "bonds up to {}, times {}", selection_.reach,
                   selection_.scale);
  for (const int dof : space.constrained()) free_[dof] = 0.;
  Couplings<dim> couplings;
  couplings.elements.resize(model.mesh.n_elements());
  couplings.nodes.resize(model.dofs.n_owned_nodes());
  for (const auto& term : terms_) term->couple(*this, couplings);
  find_pattern(couplings);
  make_matrix();
  for (const auto& term : terms_) term->add_to(*this);
  for (const int dof : space.constrained()) {
    if (static_cast<std::size_t>(dof) < space.n_owned()) add_diagonal(dof, constraints[dof]);
  }
}

template <int dim>
Teuchos::RCP<Tpetra::Operator<double>> StiffnessMatrix<dim>::linear_operator() const {
  return matrix_;
}

template <int dim>
std::size_t StiffnessMatrix<dim>::bytes() const {
  const auto local = matrix_->getLocalMatrixHost();
  return local.nnz() * (sizeof(double) + sizeof(int)) + (local.numRows() + std::size_t{1}) * sizeof(std::size_t);
}

template <int dim>
typename Couplings<dim>::Nodes StiffnessMatrix<dim>::nodes_at(int element, int q) const {
  PERIMORPH_DEBUG_ASSERT(q >= 0 && q < model_.points.count(element), "point {} of {}", q, model_.points.count(element));
  const int* nodes = model_.dofs.nodes_of(element);
  return is_by_points(element) ? std::pair{nodes + q, nodes + q + 1}
                               : std::pair{nodes, nodes + model_.mesh.n_corners(element)};
}

template <int dim>
void StiffnessMatrix<dim>::append_owned_nodes(int element, std::vector<int>& nodes) const {
  const int* corners = model_.dofs.nodes_of(element);
  std::copy_if(corners, corners + model_.mesh.n_corners(element), std::back_inserter(nodes),
               [&](int node) { return node < model_.dofs.n_owned_nodes(); });
}

/// A node is coupled to all nodes of its elements and of the elements that these are coupled to.
template <int dim>
void StiffnessMatrix<dim>::find_pattern(const Couplings<dim>& couplings) {
  const auto& mesh = model_.mesh;
  const auto& dofs = model_.dofs;
  std::vector<std::vector<int>> elements_of(dofs.n_owned_nodes());
  for (int e = 0; e < mesh.n_elements(); ++e) {
    for (int k = 0; k < mesh.n_corners(e); ++k) {
      visit_unknowns_of(dofs.nodes_of(e)[k], [&](int node, double) {
        if (node < dofs.n_owned_nodes()) elements_of[node].push_back(e);
      });
    }
  }
  std::vector<int> seen_by(dofs.n_nodes(), -1);
  first_.push_back(0);
  for (int row = 0; row < dofs.n_owned_nodes(); ++row) {
    const auto include = [&](int any_node) {
      const int node = any_node < dofs.n_real_nodes() ? any_node : dofs.image(any_node).node;
      if (seen_by[node] == row) return;
      seen_by[node] = row;
      columns_.push_back(node);
    };
    const auto include_all = [&](int element) {
      for (int k = 0; k < mesh.n_corners(element); ++k) {
        visit_unknowns_of(dofs.nodes_of(element)[k], [&](int node, double) { include(node); });
      }
    };
    include(row);
    for (const int node : couplings.nodes[row]) include(node);
    for (const int e : elements_of[row]) {
      if (is_by_points(e)) continue;
      include_all(e);
      for (const int other : couplings.elements[e]) include_all(other);
    }
    std::sort(columns_.begin() + static_cast<std::ptrdiff_t>(first_.back()), columns_.end());
    first_.push_back(columns_.size());
  }
}

template <int dim>
void StiffnessMatrix<dim>::make_matrix() {
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
template <class Visit>
void StiffnessMatrix<dim>::visit_unknowns_of(int node, Visit visit) const {
  const auto& parents = space_.hanging_nodes().parents_of(node);
  if (parents.empty()) return visit(node, 1.);
  for (const int parent : parents) visit(parent, 1. / static_cast<double>(parents.size()));
}

template <int dim>
void StiffnessMatrix<dim>::add_between_nodes(int row, int column, const Block& block) {
  visit_unknowns_of(row, [&](int i, double of_row) {
    if (i >= model_.dofs.n_owned_nodes()) return;
    visit_unknowns_of(column, [&](int j, double of_column) { add_block(i, j, of_row * of_column * block); });
  });
}

template <int dim>
void StiffnessMatrix<dim>::add_block(int row, int column, const Block& of_nodes) {
  if (of_nodes.isZero(0.)) return;  // perhaps no entry either
  if (column >= model_.dofs.n_real_nodes()) {
    const auto& [node, signs] = model_.dofs.image(column);
    return add_block(row, node, of_nodes * signs.asDiagonal());
  }
  const Block block = space_.frames().is_empty() ? of_nodes : space_.frames().between_unknowns(row, column, of_nodes);
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
void StiffnessMatrix<dim>::add_element(int element, const Eigen::Ref<const Eigen::MatrixXd>& k) {
  const int* nodes = model_.dofs.nodes_of(element);
  const int n = model_.mesh.n_corners(element);
  PERIMORPH_ASSERT(k.rows() == n * dim && k.cols() == n * dim, "{} x {} numbers for {} nodes", k.rows(), k.cols(), n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) add_between_nodes(nodes[i], nodes[j], k.template block<dim, dim>(i * dim, j * dim));
  }
}

template <int dim>
void StiffnessMatrix<dim>::add_at_points(int element, const Block* at_points) {
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

template <int dim>
void StiffnessMatrix<dim>::add_between(const bonds::ElementPair& pair, const std::vector<Block>& between) {
  const auto [a, b] = pair;
  const int* nodes_a = model_.dofs.nodes_of(a);
  const int* nodes_b = model_.dofs.nodes_of(b);
  const int n_qa = model_.points.count(a), n_qb = model_.points.count(b);
  PERIMORPH_ASSERT(static_cast<int>(between.size()) == n_qa * n_qb, "{} springs between {} and {} points",
                   between.size(), n_qa, n_qb);
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

template <int dim>
std::vector<int> StiffnessMatrix<dim>::take(const bonds::BondChange& change) {
  PERIMORPH_ASSERT(std::is_sorted(change.broken.begin(), change.broken.end()), "{} bonds are not in ascending order",
                   change.broken.size());
  std::vector<int> changed;
  for (const auto& term : terms_) term->take(change, *this, changed);
  return changed;
}

template <int dim>
std::vector<int> StiffnessMatrix<dim>::update_tangent() {
  std::vector<int> changed;
  for (const auto& term : terms_) term->update_tangent(*this, changed);
  return changed;
}

template <int dim>
void StiffnessMatrix<dim>::add_diagonal(int owned_dof, double stiffness) {
  PERIMORPH_ASSERT(owned_dof >= 0 && owned_dof < model_.dofs.n_owned_nodes() * dim, "degree of freedom {}", owned_dof);
  const int row = owned_dof / dim, c = owned_dof % dim;
  const std::size_t width = (first_[row + 1] - first_[row]) * dim;
  values_[first_[row] * dim * dim + c * width + (diagonal_[row] - first_[row]) * dim + c] += stiffness;
}

template <int dim>
BondSelection short_range(const CoupledModel<dim>& model, const base::Comm& comm, double reach) {
  PERIMORPH_ASSERT(reach > 0., "bonds up to {}", reach);
  std::vector<double> sums = {0., 0.};  // all bonds, selected bonds
  model.bonds.for_each_bond([&](const bonds::Bond<dim>& bond) {
    if (bond.first_element >= model.mesh.n_owned_elements) return;
    const double squared = bond.xi.squaredNorm();
    const double stiffness = model.spring(bond) * squared * squared;
    sums[0] += stiffness;
    if (squared <= reach * reach) sums[1] += stiffness;
  });
  base::sum(comm, sums);
  return {reach, sums[1] > 0. ? sums[0] / sums[1] : 1.};
}

template BondSelection short_range<2>(const CoupledModel<2>&, const base::Comm&, double);
template BondSelection short_range<3>(const CoupledModel<3>&, const base::Comm&, double);
template struct Couplings<2>;
template struct Couplings<3>;
template class StiffnessMatrix<2>;
template class StiffnessMatrix<3>;

}  // namespace perimorph::operators
