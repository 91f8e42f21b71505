#include "perimorph/operators/supports.hpp"

#include <algorithm>
#include <cmath>

#include "perimorph/base/errors.hpp"
#include "perimorph/operators/stiffness_matrix.hpp"

namespace perimorph::operators {

template <int dim>
Supports<dim>::Supports(const CoupledModel<dim>& model, const discretization::Space<dim>& space,
                        const std::vector<char>& discontinuous)
    : constraints(space.n_owned(), 0.), anchors(space.n_owned(), 0.) {
  PERIMORPH_ASSERT(static_cast<int>(discontinuous.size()) == model.mesh.n_elements(), "{} flags for {} elements",
                   discontinuous.size(), model.mesh.n_elements());
  for (int e = 0; e < model.mesh.n_elements(); ++e) {
    double volume = 0.;
    for (int p = model.points.first(e); p < model.points.first(e + 1); ++p) volume += model.points.weight(p);
    const double stiffness = model.elasticity.e0(e)(0, 0) * std::pow(volume, (dim - 2.) / dim);
    for (int k = 0; k < model.mesh.n_corners(e); ++k) {
      const int node = model.dofs.nodes_of(e)[k];
      if (node >= model.dofs.n_owned_nodes()) continue;
      for (int dof = node * dim; dof < (node + 1) * dim; ++dof) {
        if (space.is_constrained(dof)) constraints[dof] = std::max(constraints[dof], stiffness);
        const bool may_move = !space.is_constrained(dof) || space.frames().has(node);
        if (discontinuous[e] && may_move) anchors[dof] = anchor * stiffness;
      }
    }
  }
}

template <int dim>
Anchors<dim>::Anchors(const std::vector<double>& stiffness) {
  for (std::size_t dof = 0; dof < stiffness.size(); ++dof) {
    if (stiffness[dof] != 0.) springs_.push_back({static_cast<int>(dof), stiffness[dof]});
  }
}

template <int dim>
void Anchors<dim>::add_tangent_product(base::ConstField x, base::Field force) const {
  PERIMORPH_ASSERT(x.size() == force.size(), "{} displacements, {} forces", x.size(), force.size());
  for (const auto& [dof, stiffness] : springs_) force[dof] += stiffness * x[dof];
}

template <int dim>
void Anchors<dim>::add_to(StiffnessMatrix<dim>& matrix) const {
  for (const auto& [dof, stiffness] : springs_) matrix.add_diagonal(dof, stiffness);
}

template <int dim>
Teuchos::RCP<ForceTerm<dim>> Anchors<dim>::within(const MeshPart& part) const {
  const auto those = Teuchos::rcp(new Anchors(*this));
  auto& springs = those->springs_;
  springs.erase(std::remove_if(springs.begin(), springs.end(),
                               [&](const Spring& spring) { return !part.holds_node(spring.dof / dim); }),
                springs.end());
  return those;
}

template <int dim>
void Anchors<dim>::scale(double factor) {
  PERIMORPH_ASSERT(factor > 0., "anchors scaled by {}", factor);
  for (auto& spring : springs_) spring.stiffness *= factor;
}

template struct Supports<2>;
template struct Supports<3>;
template class Anchors<2>;
template class Anchors<3>;

}  // namespace perimorph::operators
