#include "perimorph/discretization/measure.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "perimorph/base/errors.hpp"

namespace perimorph::discretization {

using base::GlobalId;
using base::Point;

template <int dim>
std::vector<Sampled> sampled_here(const base::Comm& comm, const mesh::Mesh<dim>& mesh,
                                  const std::vector<Point<dim>>& places) {
  struct Candidate {
    int place;
    GlobalId element;
  };
  const elements::Locator<dim> locator(mesh);
  std::vector<Sampled> here;
  std::vector<Candidate> candidates;
  for (int i = 0; i < static_cast<int>(places.size()); ++i) {
    const auto found = locator.find(places[i]);
    if (!found) continue;
    here.push_back({i, *found});
    candidates.push_back({i, mesh.element_ids[found->element]});
  }
  std::vector<GlobalId> lowest(places.size(), mesh.n_global_elements);
  for (const auto& candidate : base::gather_on_all(comm, candidates)) {
    lowest[candidate.place] = std::min(lowest[candidate.place], candidate.element);
  }
  const auto is_others = [&](const Sampled& s) { return mesh.element_ids[s.location.element] != lowest[s.place]; };
  here.erase(std::remove_if(here.begin(), here.end(), is_others), here.end());
  return here;
}

template <int dim>
Measure<dim>::Measure(const base::Comm& comm, const mesh::Mesh<dim>& mesh, const MeasuredDisplacement<dim>& measured) {
  PERIMORPH_ASSERT(std::abs(measured.direction.norm() - 1.) < 1e-6, "a direction of length {}",
                   measured.direction.norm());
  const auto add = [&](const MeasuredPlace<dim>& place, const Point<dim>& direction) {
    place.point ? add_point(comm, mesh, *place.point, direction) : add_group(comm, mesh, place.group, direction);
  };
  add(measured.place, measured.direction);
  if (measured.other) add(*measured.other, -measured.direction);
}

template <int dim>
void Measure<dim>::add_point(const base::Comm& comm, const mesh::Mesh<dim>& mesh, const Point<dim>& x,
                             const Point<dim>& direction) {
  const auto here = sampled_here<dim>(comm, mesh, {x});
  if (base::sum(comm, static_cast<GlobalId>(here.size())) == 0) {
    throw base::UserError(fmt::format("a measure's point, ({:.6g}), is outside the body", fmt::join(x, ", ")));
  }
  for (const auto& [place, at] : here) {
    for (int k = 0; k < static_cast<int>(at.shape.size()); ++k) {
      shares_.push_back({at.element, k, at.shape[k] * direction});
    }
  }
}

/// A node counts on its owner, which holds all elements around it.
template <int dim>
void Measure<dim>::add_group(const base::Comm& comm, const mesh::Mesh<dim>& mesh, const std::string& group,
                             const Point<dim>& direction) {
  std::vector<int> n_around(mesh.n_owned_nodes, 0);
  for (int c = 0; c < mesh.first_corner[mesh.n_real_elements()]; ++c) {
    if (mesh.corners[c] < mesh.n_owned_nodes) ++n_around[mesh.corners[c]];
  }
  std::vector<char> is_member(mesh.n_owned_nodes, 0);
  const auto found = mesh.node_sets.find(group);
  PERIMORPH_ASSERT(found != mesh.node_sets.end(), "the mesh has no group {}", group);
  for (const int node : found->second) {
    if (node < mesh.n_owned_nodes) is_member[node] = 1;
  }
  const auto n_members = base::sum(comm, static_cast<GlobalId>(std::count(is_member.begin(), is_member.end(), 1)));
  if (n_members == 0) throw base::UserError(fmt::format("a measure's group, \"{}\", has no nodes", group));
  for (int e = 0; e < mesh.n_real_elements(); ++e) {
    for (int k = 0; k < mesh.n_corners(e); ++k) {
      const int node = mesh.corners_of(e)[k];
      if (node >= mesh.n_owned_nodes || !is_member[node]) continue;
      shares_.push_back({e, k, direction / (static_cast<double>(n_members) * n_around[node])});
    }
  }
}

template <int dim>
double Measure<dim>::of(const base::Comm& comm, const DofMap<dim>& dofs, base::ConstField u) const {
  PERIMORPH_ASSERT(static_cast<int>(u.size()) == dofs.n_nodes() * dim, "{} displacements for {} nodes", u.size(),
                   dofs.n_nodes());
  double sum = 0.;
  for (const auto& [element, corner, weight] : shares_) {
    sum += weight.dot(base::at_node<dim>(u, dofs.nodes_of(element)[corner]));
  }
  return base::sum(comm, sum);
}

#define PERIMORPH_INSTANTIATE(dim)                                                           \
  template std::vector<Sampled> sampled_here<dim>(const base::Comm&, const mesh::Mesh<dim>&, \
                                                  const std::vector<Point<dim>>&);           \
  template class Measure<dim>;

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::discretization
