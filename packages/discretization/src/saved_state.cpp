#include "perimorph/discretization/saved_state.hpp"

#include <algorithm>
#include <set>

#include "perimorph/base/errors.hpp"

namespace perimorph::discretization {

using base::GlobalId;

namespace {

template <int dim>
constexpr auto stride = static_cast<std::size_t>(SavedState<dim>::values_per_element);

template <int dim>
std::pair<GlobalId, GlobalId> global_ends(const Topology<dim>& topology, const bonds::Bond<dim>& bond) {
  return {topology.points().global_id(bond.first_element, bond.first_end),
          topology.points().global_id(bond.second_element, bond.second_end)};
}

/// Calls visit(record, ends) for the records between points of local elements. Local.
template <int dim, class Record, class Visit>
void visit_local(const std::vector<Record>& records, const mesh::Mesh<dim>& mesh, Visit visit) {
  constexpr int n = elements::max_points;
  std::map<GlobalId, int> place_of;
  for (int e = 0; e < mesh.n_elements(); ++e) place_of[mesh.element_ids[e]] = e;
  for (const auto& record : records) {
    const auto first = place_of.find(record.first / n), second = place_of.find(record.second / n);
    if (first == place_of.end() || second == place_of.end()) continue;
    visit(record, bonds::BondEnds{first->second, static_cast<int>(record.first % n), second->second,
                                  static_cast<int>(record.second % n)});
  }
}

/// Calls visit(record, bond) for the records of bonds that this rank holds. Local.
template <int dim, class Record, class Visit>
void visit_held(const std::vector<Record>& records, const Topology<dim>& topology, Visit visit) {
  const auto& bonds = topology.bonds();
  visit_local(records, topology.mesh(), [&](const Record& record, const bonds::BondEnds& ends) {
    const auto bond = bonds.find(ends.first_element, ends.first_end, ends.second_element, ends.second_end);
    if (bond != bonds.n_bonds()) visit(record, bonds.bond(bond));
  });
}

/// How many of all ranks' records are of bonds whose first element this rank owns. Local.
template <int dim, class Record>
GlobalId count_owned(const std::vector<Record>& records, const mesh::Mesh<dim>& mesh) {
  const std::set<GlobalId> owned(mesh.element_ids.begin(), mesh.element_ids.begin() + mesh.n_owned_elements);
  return std::count_if(records.begin(), records.end(),
                       [&](const Record& record) { return owned.count(record.first / elements::max_points) > 0; });
}

/// What owned elements have at their corners, out of what nodes have. Local.
template <int dim>
std::vector<double> of_elements(const std::vector<double>& at_nodes, const Topology<dim>& topology) {
  const auto& mesh = topology.mesh();
  std::vector<double> all(mesh.n_owned_elements * stride<dim>, 0.);
  for (int e = 0; e < mesh.n_owned_elements; ++e) {
    double* values = all.data() + e * stride<dim>;
    for (int k = 0; k < mesh.n_corners(e); ++k) {
      std::copy_n(at_nodes.data() + topology.dofs().nodes_of(e)[k] * dim, dim, values + k * dim);
    }
  }
  return all;
}

void check_found(GlobalId n_found, GlobalId n, const char* what) {
  if (n_found == n) return;
  throw base::UserError(fmt::format("of {} {} bonds only {} are bonds of this body", n, what, n_found));
}

}  // namespace

template <int dim>
SavedState<dim> save(const State<dim>& state, const Topology<dim>& topology) {
  PERIMORPH_ASSERT(state.displacement.size() == static_cast<std::size_t>(topology.dofs().n_nodes()) * dim,
                   "{} displacements of {} nodes", state.displacement.size(), topology.dofs().n_nodes());
  SavedState<dim> saved{state, {}, {}, {}, {}, {}};
  const auto& mesh = topology.mesh();
  const auto& bonds = topology.bonds();
  for (const auto& [call, broken] : state.broken) {
    for (const auto id : broken) {
      const auto bond = bonds.bond(id);
      if (bond.first_element >= mesh.n_owned_elements) continue;
      const auto [first, second] = global_ends(topology, bond);
      saved.broken.push_back({first, second, call});
    }
  }
  if (bonds.softens()) {
    bonds.for_each_bond([&](const bonds::Bond<dim>& bond) {
      if (bond.first_element >= mesh.n_owned_elements) return;
      const auto [accepted, largest] = bonds.softening(bond.id);
      const auto& law = bonds.materials().law(bond.first_element, bond.second_element);
      const bool is_known = bond.is_broken && accepted == static_cast<float>(law.critical_stretch());
      if (is_known || (!bond.is_broken && accepted == 0.F && largest == 0.F)) return;
      const auto [first, second] = global_ends(topology, bond);
      saved.softened.push_back({first, second, {accepted, largest}});
    });
  }
  for (const auto& [ends, slip] : topology.slips()) {
    if (ends.first_element >= mesh.n_owned_elements) continue;
    saved.slips.push_back({topology.points().global_id(ends.first_element, ends.first_end),
                           topology.points().global_id(ends.second_element, ends.second_end),
                           {}});
    std::copy_n(slip.distance.data(), dim, saved.slips.back().values.begin());
    std::copy_n(slip.friction.data(), dim, saved.slips.back().values.begin() + dim);
  }
  saved.displacement = of_elements(state.displacement, topology);
  if (!state.starts.empty()) saved.starts = of_elements(state.starts, topology);
  return saved;
}

template <int dim>
BrokenByCall find_broken(const base::Comm& comm, const SavedState<dim>& saved, const Topology<dim>& topology) {
  BrokenByCall found;
  GlobalId n_own = 0;
  visit_held(saved.broken, topology, [&](const BrokenBond& broken, const bonds::Bond<dim>& bond) {
    found[broken.call].push_back(bond.id);
    n_own += topology.bonds().counts_here(bond);
  });
  for (auto& [call, ascending] : found) std::sort(ascending.begin(), ascending.end());
  check_found(base::sum(comm, n_own), saved.counts.broken_bonds, "broken");
  return found;
}

template <int dim>
bonds::SofteningHistories find_softened(const base::Comm& comm, const SavedState<dim>& saved,
                                        const Topology<dim>& topology) {
  bonds::SofteningHistories found;
  GlobalId n_own = 0;
  visit_held(saved.softened, topology, [&](const SoftBond& softened, const bonds::Bond<dim>& bond) {
    const auto& [accepted, largest] = softened.largest_stretches;
    found.push_back({bond.id, {static_cast<float>(accepted), static_cast<float>(largest)}});
    n_own += bond.first_element < topology.mesh().n_owned_elements;
  });
  check_found(base::sum(comm, n_own), base::sum(comm, count_owned(saved.softened, topology.mesh())), "softened");
  return found;
}

template <int dim>
bonds::Slips<dim> find_slips(const SavedState<dim>& saved, const Topology<dim>& topology) {
  using Values = Eigen::Map<const base::Point<dim>>;
  bonds::Slips<dim> found;
  visit_local(saved.slips, topology.mesh(), [&](const SavedSlip<dim>& slip, const bonds::BondEnds& ends) {
    found[ends] = {Values(slip.values.data()), Values(slip.values.data() + dim)};
  });
  return found;
}

template <int dim>
std::vector<double> nodal_displacement(const std::vector<double>& saved, const Topology<dim>& topology) {
  const auto& dofs = topology.dofs();
  const int n_elements = topology.mesh().n_real_elements();
  PERIMORPH_ASSERT(saved.size() == n_elements * stride<dim>, "{} displacements of {} elements", saved.size(),
                   n_elements);
  std::vector<double> u(static_cast<std::size_t>(dofs.n_nodes()) * dim, 0.);
  for (int e = 0; e < n_elements; ++e) {
    const double* values = saved.data() + e * stride<dim>;
    for (int k = 0; k < topology.mesh().n_corners(e); ++k) {
      std::copy_n(values + k * dim, dim, u.data() + dofs.nodes_of(e)[k] * dim);
    }
  }
  dofs.complete_images(base::field(u));
  return u;
}

#define PERIMORPH_INSTANTIATE(dim)                                                                                   \
  template SavedState<dim> save(const State<dim>&, const Topology<dim>&);                                            \
  template BrokenByCall find_broken(const base::Comm&, const SavedState<dim>&, const Topology<dim>&);                \
  template bonds::SofteningHistories find_softened(const base::Comm&, const SavedState<dim>&, const Topology<dim>&); \
  template bonds::Slips<dim> find_slips(const SavedState<dim>&, const Topology<dim>&);                               \
  template std::vector<double> nodal_displacement(const std::vector<double>&, const Topology<dim>&);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::discretization
