#include "perimorph/output/reactions.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>

#include "component_names.hpp"
#include "own_nodes.hpp"
#include "perimorph/base/errors.hpp"
#include "perimorph/base/sums.hpp"

namespace perimorph::output {

using base::Point;

namespace {

constexpr int first_rotation = discretization::PrescribedComponent::first_rotation;

template <class Groups>
const discretization::RigidGroup* rigid_body(const Groups& groups, const std::string& node_set) {
  const auto found = std::find_if(groups.begin(), groups.end(), [&](const auto& group) {
    return group.node_set == node_set && group.shared_component < 0;
  });
  return found == groups.end() ? nullptr : &*found;
}

/// In three dimensions, also of vectors in a plane.
template <int dim>
Point<3> in_space(const Point<dim>& x) {
  Point<3> result = Point<3>::Zero();
  result.template head<dim>() = x;
  return result;
}

/// What the nodes of a group sum up to, places and moments about the origin.
struct Sums {
  Point<3> force = Point<3>::Zero(), moment = Point<3>::Zero();
  Point<3> place = Point<3>::Zero(), displacement = Point<3>::Zero();
  Point<3> turned = Point<3>::Zero();                ///< place x displacement
  Eigen::Matrix3d places = Eigen::Matrix3d::Zero();  ///< place place^T
  double n_nodes = 0.;

  void add(const Point<3>& x, const Point<3>& u, const Point<3>& f) {
    force += f;
    moment += x.cross(f);
    place += x;
    displacement += u;
    turned += x.cross(u);
    places += x * x.transpose();
    n_nodes += 1.;
  }

  void append_to(std::vector<double*>& values) {
    for (auto* vector : {&force, &moment, &place, &displacement, &turned}) {
      for (double& value : *vector) values.push_back(&value);
    }
    for (double& value : places.reshaped()) values.push_back(&value);
    values.push_back(&n_nodes);
  }

  Point<3> mean(const Point<3>& sum) const { return sum / std::max(n_nodes, 1.); }

  /// The small rotation that comes closest to the displacements; none about an axis that all nodes lie on.
  Point<3> rotation() const {
    const Point<3> center = mean(place);
    const Eigen::Matrix3d spread = places - n_nodes * center * center.transpose();
    const Eigen::Matrix3d inertia = spread.trace() * Eigen::Matrix3d::Identity() - spread;
    return inertia.fullPivLu().solve(turned - center.cross(displacement));
  }
};

}  // namespace

template <int dim>
std::vector<Reaction> reactions_of(const std::vector<std::string>& groups,
                                   const std::vector<discretization::RigidGroup>& rigid_groups) {
  std::vector<Reaction> reactions;
  for (const auto& group : groups) {
    for (int c = 0; c < dim; ++c) reactions.push_back({group + "_" + axis_names[c], group, c});
    for (int c = dim == 2 ? 2 : 0; c < 3 && rigid_body(rigid_groups, group) != nullptr; ++c) {
      reactions.push_back({group + "_rotation_" + axis_names[c], group, first_rotation + c});
    }
  }
  return reactions;
}

const Reaction* largest_force(const std::vector<Reaction>& reactions) {
  const Reaction* largest = nullptr;
  for (const auto& one : reactions) {
    if (one.component >= first_rotation) continue;
    if (largest == nullptr || std::abs(one.force) > std::abs(largest->force)) largest = &one;
  }
  return largest;
}

template <int dim>
void measure(const base::Comm& comm, int increment, const fracture::Body<dim>& body, std::vector<Reaction>& reactions) {
  PERIMORPH_ASSERT(increment > 0, "increment {}", increment);
  std::map<std::string, Sums> groups;
  std::vector<double*> values;
  for (const auto& reaction : reactions) {
    const auto [group, is_new] = groups.try_emplace(reaction.group);
    if (!is_new) continue;
    for (const int n : own_nodes_in(body, body.mesh().node_sets.at(reaction.group))) {
      const auto& x = body.mesh().coordinates[body.topology().dofs().reference_node(n)];
      group->second.add(in_space<dim>(x), in_space<dim>(base::at_node<dim>(body.displacement(), n)),
                        in_space<dim>(body.reaction(n)));
    }
    group->second.append_to(values);
  }
  base::sum(comm, values);
  for (auto& reaction : reactions) {
    const auto& sums = groups.at(reaction.group);
    if (reaction.component < first_rotation) {
      reaction.force = sums.force[reaction.component];
      reaction.displacement = sums.mean(sums.displacement)[reaction.component];
    } else {
      const auto& group = *rigid_body(body.problem().rigid_groups, reaction.group);
      const Point<3> center = in_space<dim>(discretization::center_of(comm, body.mesh(), group));
      reaction.force = (sums.moment - center.cross(sums.force))[reaction.component - first_rotation];
      reaction.displacement = sums.rotation()[reaction.component - first_rotation];
    }
    if (std::abs(reaction.force) <= std::abs(reaction.peak)) continue;
    reaction.peak = reaction.force;
    reaction.peak_increment = increment;
  }
}

#define PERIMORPH_INSTANTIATE(dim)                                                                  \
  template std::vector<Reaction> reactions_of<dim>(const std::vector<std::string>&,                 \
                                                   const std::vector<discretization::RigidGroup>&); \
  template void measure(const base::Comm&, int, const fracture::Body<dim>&, std::vector<Reaction>&);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::output
