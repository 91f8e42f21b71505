#include "perimorph/discretization/rigid_groups.hpp"

#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "perimorph/base/errors.hpp"
#include "perimorph/discretization/boundary_conditions.hpp"

namespace perimorph::discretization {

using base::Point;

const RigidGroup* moved_by(const PrescribedComponent& condition, const std::vector<RigidGroup>& groups) {
  const auto found = std::find_if(groups.begin(), groups.end(), [&](const RigidGroup& group) {
    return group.node_set == condition.node_set &&
           (group.shared_component < 0 || (condition.component == group.shared_component));
  });
  return found == groups.end() ? nullptr : &*found;
}

template <>
Point<2> rigid_displacement(int motion, const Point<2>& arm) {
  PERIMORPH_DEBUG_ASSERT(motion >= 0 && motion < GroupMotion<2>::n_motions, "motion {}", motion);
  return motion < 2 ? Point<2>(Point<2>::Unit(motion)) : Point<2>(-arm[1], arm[0]);
}

template <>
Point<3> rigid_displacement(int motion, const Point<3>& arm) {
  PERIMORPH_DEBUG_ASSERT(motion >= 0 && motion < GroupMotion<3>::n_motions, "motion {}", motion);
  return motion < 3 ? Point<3>(Point<3>::Unit(motion)) : Point<3>(Point<3>::Unit(motion - 3).cross(arm));
}

namespace {

/// Whether the two decide on one degree of freedom of a node that they have in common.
bool are_rivals(const RigidGroup& group, const RigidGroup& other) {
  const int a = group.shared_component, b = other.shared_component;
  return a < 0 || b < 0 || a == b;
}

bool are_rivals(const RigidGroup& group, const PrescribedComponent& condition) {
  if (group.shared_component < 0) return true;
  if (condition.direction.empty()) return condition.component == group.shared_component;
  return condition.direction[group.shared_component] != 0.;
}

const std::vector<int> no_nodes;

template <int dim>
const std::vector<int>& nodes_of(const mesh::Mesh<dim>& mesh, const std::string& node_set) {
  const auto found = mesh.node_sets.find(node_set);
  return found == mesh.node_sets.end() ? no_nodes : found->second;
}

template <int dim>
std::vector<int> common_nodes(const mesh::Mesh<dim>& mesh, const std::string& one, const std::string& other) {
  const auto &a = nodes_of(mesh, one), &b = nodes_of(mesh, other);
  std::vector<int> common;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
  return common;
}

/// By its place in PrescribedComponent's order.
template <int dim>
int motion_of(int component) {
  if (component < dim) return component;
  return dim == 2 ? 2 : component;
}

}  // namespace

template <int dim>
Point<dim> center_of(const base::Comm& comm, const mesh::Mesh<dim>& mesh, const RigidGroup& group) {
  PERIMORPH_ASSERT(group.center.empty() || group.center.size() == dim, "a center of {} numbers", group.center.size());
  std::vector<double> sums(dim + 1, 0.);
  for (const int node : nodes_of(mesh, group.node_set)) {
    if (node >= mesh.n_owned_nodes) continue;
    for (int c = 0; c < dim; ++c) sums[c] += mesh.coordinates[node][c];
    sums[dim] += 1.;
  }
  base::sum(comm, sums);
  if (sums[dim] == 0.) throw base::UserError(fmt::format("the rigid group \"{}\" has no nodes", group.name));
  if (!group.center.empty()) return Eigen::Map<const Point<dim>>(group.center.data());
  return Eigen::Map<const Point<dim>>(sums.data()) / sums[dim];
}

template <int dim>
std::vector<GroupConflict> group_conflicts(const mesh::Mesh<dim>& mesh, const std::vector<RigidGroup>& groups,
                                           const std::vector<PrescribedComponent>& conditions) {
  std::vector<GroupConflict> all;
  for (auto group = groups.begin(); group != groups.end(); ++group) {
    const auto note = [&](const auto& other, const char* kind) {
      const auto common = common_nodes(mesh, group->node_set, other.node_set);
      if (common.empty() || !are_rivals(*group, other)) return;
      all.push_back({group->name, fmt::format("{} \"{}\"", kind, other.name), common[0]});
    };
    std::for_each(groups.begin(), group, [&](const RigidGroup& other) { note(other, "rigid group"); });
    for (const auto& condition : conditions) {
      if (moved_by(condition, groups) == nullptr) note(condition, "displacement");
    }
  }
  return all;
}

template <int dim>
std::vector<GroupMotion<dim>> group_motions(const base::Comm& comm, const mesh::Mesh<dim>& mesh,
                                            const std::vector<RigidGroup>& groups,
                                            const std::vector<PrescribedComponent>& conditions) {
  base::on_all_ranks(comm, [&] {
    for (const auto& [group, other, node] : group_conflicts(mesh, groups, conditions)) {
      throw base::UserError(fmt::format("the rigid group \"{}\" and the {} have the node at ({}) in common", group,
                                        other, fmt::join(mesh.coordinates[node], ", ")));
    }
  });
  std::vector<GroupMotion<dim>> motions;
  for (const auto& group : groups) {
    const Point<dim> center = center_of(comm, mesh, group);
    motions.push_back({group.shared_component, nodes_of(mesh, group.node_set), {}});
    for (const int node : motions.back().nodes) motions.back().arms.push_back(mesh.coordinates[node] - center);
    for (const auto& condition : conditions) {
      if (moved_by(condition, groups) != &group) continue;
      motions.back().prescribed.push_back({motion_of<dim>(condition.component), condition.value});
    }
  }
  return motions;
}

#define PERIMORPH_INSTANTIATE(dim)                                                                            \
  template Point<dim> center_of(const base::Comm&, const mesh::Mesh<dim>&, const RigidGroup&);                \
  template std::vector<GroupConflict> group_conflicts(const mesh::Mesh<dim>&, const std::vector<RigidGroup>&, \
                                                      const std::vector<PrescribedComponent>&);               \
  template std::vector<GroupMotion<dim>> group_motions(const base::Comm&, const mesh::Mesh<dim>&,             \
                                                       const std::vector<RigidGroup>&,                        \
                                                       const std::vector<PrescribedComponent>&);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::discretization
