#include "perimorph/operators/free_parts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Tpetra_Import.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "perimorph/base/disjoint_sets.hpp"
#include "perimorph/base/parallel.hpp"

namespace perimorph::operators {

namespace {

using base::GlobalId;

/// A part of the body that loads act on and nothing holds.
template <int dim>
struct FreePart {
  GlobalId n_nodes;         ///< of the present numbering
  base::Point<dim> center;  ///< mean of its nodes in the reference mesh, [length]
  base::Point<dim> load;    ///< resultant, in the directions in which no node is held, [force]
};

/// What holds nodes together beside elements: all unbroken bonds but some, contacts, and groups that move as one.
template <int dim>
struct Ties {
  const std::vector<ContactSpring<dim>>& contacts;
  std::vector<std::vector<int>> groups;  ///< local nodes of each
  std::vector<bonds::BondId> failing;    ///< ascending
};

/// Local nodes that are held together, as far as this rank sees.
template <int dim>
base::DisjointSets joined_nodes(const CoupledModel<dim>& model, const Ties<dim>& ties) {
  base::DisjointSets joined(model.dofs.n_nodes());
  for (int e = 0; e < model.mesh.n_elements(); ++e) {
    for (int k = 1; k < model.mesh.n_corners(e); ++k) joined.join(model.dofs.nodes_of(e)[k], model.dofs.nodes_of(e)[0]);
  }
  for (int n = model.dofs.n_real_nodes(); n < model.dofs.n_nodes(); ++n) joined.join(n, model.dofs.image(n).node);
  const auto join = [&](const bonds::Bond<dim>& bond) {
    joined.join(model.dofs.nodes_of(bond.first_element)[0], model.dofs.nodes_of(bond.second_element)[0]);
  };
  model.bonds.for_each_bond([&](const bonds::Bond<dim>& bond) {
    if (!bond.is_broken && !std::binary_search(ties.failing.begin(), ties.failing.end(), bond.id)) join(bond);
  });
  for (const auto& contact : ties.contacts) join(contact.bond);
  for (const auto& group : ties.groups) {
    for (const int node : group) joined.join(node, group[0]);
  }
  return joined;
}

/// Gives all nodes of a group the lowest number that any of them has; returns whether that changes one here.
/// Collective.
bool join_groups(const base::Comm& comm, const std::vector<std::vector<int>>& groups, std::vector<GlobalId>& part) {
  bool has_changed = false;
  for (const auto& group : groups) {
    GlobalId low = std::numeric_limits<GlobalId>::max();
    for (const int node : group) low = std::min(low, part[node]);
    low = -base::max(comm, -low);
    for (const int node : group) has_changed |= std::exchange(part[node], low) != low;
  }
  return has_changed;
}

/// For each local node the lowest global node of its part. Collective.
template <int dim>
std::vector<GlobalId> parts_of_nodes(const base::Comm& comm, const CoupledModel<dim>& model, const Ties<dim>& ties) {
  const auto& dofs = model.dofs;
  base::DisjointSets joined = joined_nodes(model, ties);
  std::vector<GlobalId> part(dofs.n_nodes());
  for (int n = 0; n < dofs.n_nodes(); ++n) part[n] = dofs.global_node(n);
  Tpetra::Vector<double> owned(dofs.owned_dofs()), all(dofs.all_dofs());
  for (GlobalId has_changed = 1; has_changed != 0;) {
    std::vector<GlobalId> lowest = part;
    for (int n = 0; n < dofs.n_nodes(); ++n) {
      GlobalId& low = lowest[joined.lowest(n)];
      low = std::min(low, part[n]);
    }
    for (int n = 0; n < dofs.n_owned_nodes(); ++n) {
      owned.replaceLocalValue(n * dim, static_cast<double>(lowest[joined.lowest(n)]));
    }
    all.doImport(owned, *dofs.import(), Tpetra::INSERT);
    const auto values = all.getLocalViewHost(Tpetra::Access::ReadOnly);
    has_changed = 0;
    for (int n = 0; n < dofs.n_real_nodes(); ++n) {
      const auto now = std::min(lowest[joined.lowest(n)], static_cast<GlobalId>(values(n * dim, 0)));
      if (now != part[n]) has_changed = 1;
      part[n] = now;
    }
    if (join_groups(comm, ties.groups, part)) has_changed = 1;
    has_changed = base::max(comm, has_changed);
  }
  return part;
}

/// What a rank knows of a part. Trivially copyable, so that it can travel.
template <int dim>
struct Share {
  GlobalId part = 0, n_nodes = 0;
  std::array<double, dim> coordinates{}, load{};
  std::array<int, dim> held{};

  void add(const Share& other) {
    n_nodes += other.n_nodes;
    for (int c = 0; c < dim; ++c) {
      coordinates[c] += other.coordinates[c];
      load[c] += other.load[c];
      held[c] += other.held[c];
    }
  }
};

template <int dim>
Share<dim> share_of(const CoupledModel<dim>& model, const discretization::Space<dim>& space,
                    const std::vector<double>& loads, int node) {
  Share<dim> share;
  share.n_nodes = 1;
  for (int c = 0; c < dim; ++c) {
    share.coordinates[c] = model.mesh.coordinates[model.dofs.reference_node(node)][c];
    share.load[c] = loads[node * dim + c];
    share.held[c] = space.is_held(node, c) ? 1 : 0;
  }
  return share;
}

template <int dim>
std::map<GlobalId, Share<dim>> by_part(const std::vector<Share<dim>>& shares) {
  std::map<GlobalId, Share<dim>> parts;
  for (const auto& share : shares) parts[share.part].add(share);
  for (auto& [part, sum] : parts) sum.part = part;
  return parts;
}

/// By ascending number of their first node.
template <int dim>
std::vector<FreePart<dim>> free_parts(const base::Comm& comm, const CoupledModel<dim>& model,
                                      const discretization::Space<dim>& space, const std::vector<double>& loads,
                                      const Ties<dim>& ties) {
  PERIMORPH_ASSERT(loads.size() == space.n_owned(), "{} loads for {} degrees of freedom", loads.size(),
                   space.n_owned());
  constexpr double felt = 1e-6;  // share of all loads; less is rounding
  const auto part = parts_of_nodes(comm, model, ties);
  std::vector<Share<dim>> own;
  for (int n = 0; n < model.dofs.n_owned_nodes(); ++n) {
    own.push_back(share_of(model, space, loads, n));
    own.back().part = part[n];
  }
  std::vector<Share<dim>> sums;
  for (const auto& [label, sum] : by_part(own)) sums.push_back(sum);
  const double all_loads = base::sum(
      comm, std::accumulate(loads.begin(), loads.end(), 0., [](double sum, double f) { return sum + std::abs(f); }));

  std::vector<FreePart<dim>> free;
  for (const auto& [label, sum] : by_part(base::gather_on_all(comm, sums))) {
    FreePart<dim> one{sum.n_nodes, base::Point<dim>::Zero(), base::Point<dim>::Zero()};
    for (int c = 0; c < dim; ++c) {
      one.center[c] = sum.coordinates[c] / static_cast<double>(sum.n_nodes);
      if (sum.held[c] == 0) one.load[c] = sum.load[c];
    }
    if (one.load.norm() > felt * all_loads) free.push_back(one);
  }
  return free;
}

}  // namespace

template <int dim>
std::string what_is_free(const base::Comm& comm, const CoupledModel<dim>& model,
                         const discretization::Space<dim>& space, const std::vector<double>& loads,
                         const std::vector<ContactSpring<dim>>& contacts, const std::vector<bonds::BondId>& failing) {
  const auto description_of = [&](const FreePart<dim>& part) {
    return fmt::format("the part of {} of {} nodes around ({:.6g})", part.n_nodes, model.dofs.n_global_nodes(),
                       fmt::join(part.center, ", "));
  };
  if (const auto free = free_parts<dim>(comm, model, space, loads, {contacts, space.groups().nodes(), {}});
      !free.empty()) {
    return fmt::format("no equilibrium exists: {} is free, and a load of ({:.6g}) acts on it", description_of(free[0]),
                       fmt::join(free[0].load, ", "));
  }
  const auto free = free_parts<dim>(comm, model, space, loads, {contacts, space.groups().nodes(), failing});
  if (free.empty()) return "";
  return fmt::format(
      "no equilibrium was found: only bonds beyond the critical stretch hold {} against a load of ({:.6g})",
      description_of(free[0]), fmt::join(free[0].load, ", "));
}

template std::string what_is_free(const base::Comm&, const CoupledModel<2>&, const discretization::Space<2>&,
                                  const std::vector<double>&, const std::vector<ContactSpring<2>>&,
                                  const std::vector<bonds::BondId>&);
template std::string what_is_free(const base::Comm&, const CoupledModel<3>&, const discretization::Space<3>&,
                                  const std::vector<double>&, const std::vector<ContactSpring<3>>&,
                                  const std::vector<bonds::BondId>&);

}  // namespace perimorph::operators
