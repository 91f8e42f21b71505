#include "perimorph/discretization/hanging_nodes.hpp"

#include <algorithm>

#include "perimorph/base/errors.hpp"

namespace perimorph::discretization {

template <int dim>
HangingNodes<dim>::HangingNodes(const DofMap<dim>& dofs) {
  const auto& hanging = dofs.mesh().hanging_nodes;
  if (hanging.empty()) return;
  std::vector<int> node_of(dofs.mesh().n_nodes(), -1);  // by node of the reference mesh
  std::vector<char> has_several(node_of.size(), 0);     // at discontinuous elements
  for (int n = 0; n < dofs.n_real_nodes(); ++n) {
    int& node = node_of[dofs.reference_node(n)];
    if (node >= 0) has_several[dofs.reference_node(n)] = 1;
    node = n;
  }
  const auto node_at = [&](int reference_node) {
    PERIMORPH_ASSERT(node_of[reference_node] >= 0 && has_several[reference_node] == 0,
                     "node {}, at a hanging one, is at a discontinuous element", reference_node);
    return node_of[reference_node];
  };
  for (const auto& [node, n_parents, parents] : hanging) {
    ties_.push_back({node_at(node), {}});
    for (int i = 0; i < n_parents; ++i) ties_.back().parents.push_back(node_at(parents[i]));
  }
  std::sort(ties_.begin(), ties_.end(), [](const Tie& a, const Tie& b) { return a.node < b.node; });
  tie_of_.assign(dofs.n_nodes(), -1);
  for (std::size_t i = 0; i < ties_.size(); ++i) tie_of_[ties_[i].node] = static_cast<int>(i);
}

template <int dim>
std::vector<int> HangingNodes<dim>::dofs() const {
  std::vector<int> all;
  for (const auto& tie : ties_) {
    for (int c = 0; c < dim; ++c) all.push_back(tie.node * dim + c);
  }
  return all;
}

template <int dim>
const std::vector<int>& HangingNodes<dim>::parents_of(int node) const {
  return tie_of_.empty() || tie_of_[node] < 0 ? none_ : ties_[tie_of_[node]].parents;
}

template <int dim>
void HangingNodes<dim>::complete(base::Field values) const {
  for (const auto& [node, parents] : ties_) {
    for (int c = 0; c < dim; ++c) {
      double sum = 0.;
      for (const int parent : parents) sum += values[parent * dim + c];
      values[node * dim + c] = sum / static_cast<double>(parents.size());
    }
  }
}

template <int dim>
void HangingNodes<dim>::gather(base::Field forces) const {
  for (const auto& [node, parents] : ties_) {
    for (int c = 0; c < dim; ++c) {
      const double share = forces[node * dim + c] / static_cast<double>(parents.size());
      for (const int parent : parents) forces[parent * dim + c] += share;
      forces[node * dim + c] = 0.;
    }
  }
}

template class HangingNodes<2>;
template class HangingNodes<3>;

}  // namespace perimorph::discretization
