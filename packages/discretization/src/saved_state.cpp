#include "perimorph/discretization/saved_state.hpp"

#include <algorithm>

#include "perimorph/base/errors.hpp"

namespace perimorph::discretization {

using base::GlobalId;

namespace {

template <int dim>
constexpr auto stride = static_cast<std::size_t>(SavedState<dim>::values_per_element);

}  // namespace

template <int dim>
SavedState<dim> save(const State<dim>& state, const Topology<dim>& topology) {
  PERIMORPH_ASSERT(state.displacement.size() == static_cast<std::size_t>(topology.dofs().n_nodes()) * dim,
                   "{} displacements of {} nodes", state.displacement.size(), topology.dofs().n_nodes());
  SavedState<dim> saved{state, {}, {}};
  const auto& mesh = topology.mesh();
  const auto& bonds = topology.bonds();
  for (const auto& [call, broken] : state.broken) {
    for (const auto id : broken) {
      const auto bond = bonds.bond(id);
      if (bond.first_element >= mesh.n_owned_elements) continue;
      saved.broken.push_back({topology.points().global_id(bond.first_element, bond.first_end),
                              topology.points().global_id(bond.second_element, bond.second_end), call});
    }
  }
  saved.displacement.assign(mesh.n_owned_elements * stride<dim>, 0.);
  for (int e = 0; e < mesh.n_owned_elements; ++e) {
    double* values = saved.displacement.data() + e * stride<dim>;
    for (int k = 0; k < mesh.n_corners(e); ++k) {
      std::copy_n(state.displacement.data() + topology.dofs().nodes_of(e)[k] * dim, dim, values + k * dim);
    }
  }
  return saved;
}

template <int dim>
BrokenByCall find_broken(const base::Comm& comm, const SavedState<dim>& saved, const Topology<dim>& topology) {
  constexpr int n = elements::max_points;
  const auto& mesh = topology.mesh();
  const auto& bonds = topology.bonds();
  std::map<GlobalId, int> place_of;
  for (int e = 0; e < mesh.n_elements(); ++e) place_of[mesh.element_ids[e]] = e;
  BrokenByCall found;
  GlobalId n_own = 0;
  for (const auto& broken : saved.broken) {
    const auto first = place_of.find(broken.first / n), second = place_of.find(broken.second / n);
    if (first == place_of.end() || second == place_of.end()) continue;
    const auto bond = bonds.find(first->second, static_cast<int>(broken.first % n), second->second,
                                 static_cast<int>(broken.second % n));
    if (bond == bonds.n_bonds()) continue;
    found[broken.call].push_back(bond);
    n_own += first->second < mesh.n_owned_elements;
  }
  for (auto& [call, ascending] : found) std::sort(ascending.begin(), ascending.end());
  const GlobalId n_found = base::sum(comm, n_own);
  if (n_found == saved.counts.broken_bonds) return found;
  throw base::UserError(
      fmt::format("of {} broken bonds only {} are bonds of this body", saved.counts.broken_bonds, n_found));
}

template <int dim>
std::vector<double> nodal_displacement(const SavedState<dim>& saved, const Topology<dim>& topology) {
  const auto& dofs = topology.dofs();
  PERIMORPH_ASSERT(saved.displacement.size() == topology.mesh().n_elements() * stride<dim>,
                   "{} displacements of {} elements", saved.displacement.size(), topology.mesh().n_elements());
  std::vector<double> u(static_cast<std::size_t>(dofs.n_nodes()) * dim, 0.);
  for (int e = 0; e < topology.mesh().n_elements(); ++e) {
    const double* values = saved.displacement.data() + e * stride<dim>;
    for (int k = 0; k < topology.mesh().n_corners(e); ++k) {
      std::copy_n(values + k * dim, dim, u.data() + dofs.nodes_of(e)[k] * dim);
    }
  }
  return u;
}

#define PERIMORPH_INSTANTIATE(dim)                                                                    \
  template SavedState<dim> save(const State<dim>&, const Topology<dim>&);                             \
  template BrokenByCall find_broken(const base::Comm&, const SavedState<dim>&, const Topology<dim>&); \
  template std::vector<double> nodal_displacement(const SavedState<dim>&, const Topology<dim>&);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::discretization
