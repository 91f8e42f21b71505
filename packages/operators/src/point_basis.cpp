#include "perimorph/operators/point_basis.hpp"

#include <Eigen/LU>
#include <Tpetra_MultiVector.hpp>
#include <algorithm>
#include <numeric>

#include "perimorph/base/errors.hpp"

namespace perimorph::operators {

namespace {

/// Whether an element has as many points as nodes, no stiffness of its own and no supports.
template <int dim>
bool is_suitable(const CoupledModel<dim>& model, const discretization::Space<dim>& space, int element) {
  const int n = model.mesh.n_corners(element);
  if (!model.elasticity.is_zero(element) || model.points.count(element) != n) return false;
  const int* nodes = model.dofs.nodes_of(element);
  return std::none_of(nodes, nodes + n, [&](int node) {
    for (int c = 0; c < dim; ++c) {
      if (space.is_constrained(node * dim + c)) return true;
    }
    return false;
  });
}

}  // namespace

template <int dim>
PointBasis<dim>::PointBasis(const CoupledModel<dim>& model, const discretization::Space<dim>& space,
                            const std::vector<char>& discontinuous)
    : unknowns_(model.dofs.owned_dofs()), holds_(discontinuous) {
  PERIMORPH_ASSERT(static_cast<int>(discontinuous.size()) == model.mesh.n_elements(), "{} flags for {} elements",
                   discontinuous.size(), model.mesh.n_elements());
  const auto& dofs = model.dofs;
  auto ends = base::gather_on_all(*unknowns_->getComm(), std::vector<base::GlobalId>{dofs.n_owned_nodes()});
  std::partial_sum(ends.begin(), ends.end(), ends.begin());  // of the ranks' nodes, whose numbers are contiguous
  const auto rank_of = [&](int node) {
    return std::upper_bound(ends.begin(), ends.end(), dofs.global_node(node)) - ends.begin();
  };
  for (int e = 0; e < model.mesh.n_elements(); ++e) {
    if (!holds_[e]) continue;
    const int* nodes = dofs.nodes_of(e);
    const int n = model.mesh.n_corners(e);
    const bool is_one_ranks =
        std::all_of(nodes, nodes + n, [&](int node) { return rank_of(node) == rank_of(nodes[0]); });
    holds_[e] = is_one_ranks && is_suitable(model, space, e);
    if (!holds_[e] || nodes[0] >= dofs.n_owned_nodes()) continue;
    elements_.push_back({nodes_.size(), n, table_of(model.points.reference(e))});
    nodes_.insert(nodes_.end(), nodes, nodes + n);
    for (int q = 0; q < n; ++q) points_.push_back(model.points.position(model.points.first(e) + q));
  }
}

template <int dim>
PointBasis<dim> PointBasis<dim>::within(const std::vector<int>& nodes, const Teuchos::RCP<const Map>& unknowns) const {
  PERIMORPH_ASSERT(unknowns->getNodeNumElements() == nodes.size() * dim, "{} unknowns of {} nodes",
                   unknowns->getNodeNumElements(), nodes.size());
  PointBasis part(*this);
  part.unknowns_ = unknowns;
  part.elements_.clear();
  part.nodes_.clear();
  for (const auto& [first, n, added] : elements_) {
    if (!std::binary_search(nodes.begin(), nodes.end(), nodes_[first])) continue;
    part.elements_.push_back({part.nodes_.size(), n, added});
    for (int k = 0; k < n; ++k) {
      const auto place = std::lower_bound(nodes.begin(), nodes.end(), nodes_[first + k]);
      PERIMORPH_ASSERT(place != nodes.end() && *place == nodes_[first + k], "node {} without node {}", nodes_[first],
                       nodes_[first + k]);
      part.nodes_.push_back(static_cast<int>(place - nodes.begin()));
    }
  }
  return part;
}

template <int dim>
std::shared_ptr<const typename PointBasis<dim>::CornerMatrix> PointBasis<dim>::table_of(
    const elements::ReferenceElement<dim>& reference) {
  auto& table = tables_[&reference];
  if (table == nullptr) {
    CornerMatrix at_points(reference.n_points, reference.n_corners);
    for (int q = 0; q < reference.n_points; ++q) at_points.row(q) = reference.shape[q];
    table = std::make_shared<const CornerMatrix>(at_points.inverse() -
                                                 CornerMatrix::Identity(reference.n_points, reference.n_corners));
  }
  return table;
}

template <int dim>
void PointBasis<dim>::move_to_points(std::vector<base::Point<dim>>& coordinates) const {
  PERIMORPH_ASSERT(coordinates.size() * dim == unknowns_->getNodeNumElements(), "{} nodes for {} unknowns",
                   coordinates.size(), unknowns_->getNodeNumElements());
  for (std::size_t i = 0; i < nodes_.size(); ++i) coordinates[nodes_[i]] = points_[i];
}

template <int dim>
void PointBasis<dim>::apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp mode, double alpha,
                            double beta) const {
  PERIMORPH_ASSERT(&x != &y, "the result would replace the argument while it is read");
  y.update(alpha, x, beta);
  const auto input = x.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto output = y.getLocalViewHost(Tpetra::Access::ReadWrite);
  for (std::size_t column = 0; column < input.extent(1); ++column) {
    for (const auto& [first, n, added] : elements_) {
      const int* nodes = nodes_.data() + first;
      for (int k = 0; k < n; ++k) {
        for (int l = 0; l < n; ++l) {
          const double factor = alpha * (mode == Teuchos::NO_TRANS ? (*added)(k, l) : (*added)(l, k));
          for (int c = 0; c < dim; ++c)
            output(nodes[k] * dim + c, column) += factor * input(nodes[l] * dim + c, column);
        }
      }
    }
  }
}

template <int dim>
base::NodeWeights weights_of_old_unknowns(const CoupledModel<dim>& model, const PointBasis<dim>* basis,
                                          const discretization::DofMap<dim>& old_dofs,
                                          const PointBasis<dim>* old_basis) {
  const auto is_by_points = [](const PointBasis<dim>* one, int e) { return one != nullptr && one->holds(e); };
  PERIMORPH_ASSERT(basis != nullptr || old_basis == nullptr, "points that were unknowns have become nodes again");
  base::NodeWeights weights(model.dofs.n_owned_nodes());
  for (int e = 0; e < model.mesh.n_elements(); ++e) {
    const int* nodes = model.dofs.nodes_of(e);
    const int* old_nodes = old_dofs.nodes_of(e);
    const bool becomes_points = is_by_points(basis, e) && !is_by_points(old_basis, e);
    for (int k = 0; k < model.mesh.n_corners(e); ++k) {
      if (nodes[k] >= model.dofs.n_owned_nodes() || !weights[nodes[k]].empty()) continue;
      if (!becomes_points) {
        weights[nodes[k]] = {{old_nodes[k], 1.}};
        continue;
      }
      const auto& shape = model.points.shape(e, k);
      for (int l = 0; l < model.mesh.n_corners(e); ++l) weights[nodes[k]].push_back({old_nodes[l], shape(l)});
    }
  }
  return weights;
}

template base::NodeWeights weights_of_old_unknowns<2>(const CoupledModel<2>&, const PointBasis<2>*,
                                                      const discretization::DofMap<2>&, const PointBasis<2>*);
template base::NodeWeights weights_of_old_unknowns<3>(const CoupledModel<3>&, const PointBasis<3>*,
                                                      const discretization::DofMap<3>&, const PointBasis<3>*);
template class PointBasis<2>;
template class PointBasis<3>;

}  // namespace perimorph::operators
