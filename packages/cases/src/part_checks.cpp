#include "part_checks.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Teuchos_DefaultSerialComm.hpp>
#include <algorithm>
#include <map>
#include <set>

#include "body_parts.hpp"
#include "perimorph/base/disjoint_sets.hpp"
#include "perimorph/base/point_tree.hpp"
#include "perimorph/base/text.hpp"
#include "perimorph/elements/reference_element.hpp"
#include "perimorph/mesh/extent.hpp"
#include "perimorph/mesh/parts.hpp"
#include "perimorph/mesh/sorted_sides.hpp"

namespace perimorph::cases {

namespace {

using base::Point;

constexpr double negligible = 1e-6;  // motion of the supports, relative to that of the part
constexpr int most_listed = 10;      // parts in a message
constexpr int most_joined = 300;     // by hinges, for which it is found out what can move

/// The rigid motions of some parts, and what holds them. The parts hang on each other by hinges.
template <int dim>
class RigidMotions {
 public:
  static constexpr int n_rotations = dim == 2 ? 1 : 3, n_motions = dim + n_rotations;

  /// @param boxes around the parts
  explicit RigidMotions(std::vector<Eigen::AlignedBox<double, dim>> boxes)
      : boxes_(std::move(boxes)), sum_(Eigen::MatrixXd::Zero(n(), n())) {}

  /// A support holds a part's displacement along a direction at the point.
  void hold(int part, const Point<dim>& point, const Point<dim>& direction) {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(n());
    for (int component = 0; component < dim; ++component) add(row, direction[component], part, point, component);
    is_oblique_ |= (direction.array() != 0.).count() > 1;
    take(row);
  }

  /// Something holds a part's rotation, about the axis of that number in three dimensions.
  void hold_rotation(int part, int axis) {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(n());
    row[part * n_motions + dim + (dim == 2 ? 0 : axis)] = 1.;
    take(row);
  }

  /// Both parts move alike in a component, each at its point.
  void join(int part, const Point<dim>& point, int other, const Point<dim>& other_point, int component) {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(n());
    add(row, 1., part, point, component);
    add(row, -1., other, other_point, component);
    take(row);
  }

  /// A hinge: both parts move alike there.
  void join(int part, int other, const Point<dim>& point) {
    for (int component = 0; component < dim; ++component) join(part, point, other, point, component);
  }

  /// Holds what any rank's motions hold. Collective.
  void unite(const base::Comm& comm) {
    std::vector<double> sums(sum_.data(), sum_.data() + sum_.size());
    sums.push_back(static_cast<double>(n_held_));
    base::sum(comm, sums);
    std::copy_n(sums.begin(), sum_.size(), sum_.data());
    n_held_ = static_cast<long>(sums.back());
  }

  /// What is free, in words ("translation in x, rotation"), or "". Of a single part.
  std::string free() const {
    std::vector<std::string> names;
    for (int motion = 0; motion < n_motions; ++motion) {
      if (sum_(motion, motion) > threshold()) continue;
      names.push_back(motion < dim ? fmt::format("translation in {}", "xyz"[motion])
                      : dim == 2   ? "rotation"
                                   : fmt::format("rotation about {}", "xyz"[motion - dim]));
    }
    const auto values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(sum_).eigenvalues();
    const int rank = static_cast<int>((values.array() > threshold()).count());
    const int n_others = n_motions - rank - static_cast<int>(names.size());
    const char* other = is_oblique_ ? "other motion" : "rotation";
    if (n_others > 0) names.emplace_back(n_others == 1 ? other : fmt::format("{} {}s", n_others, other));
    return fmt::format("{}", fmt::join(names, ", "));
  }

  /// The parts that can move, ascending.
  std::vector<int> moving() const {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(sum_);
    std::set<int> parts;
    for (int mode = 0; mode < n() && solver.eigenvalues()[mode] <= threshold(); ++mode) {
      const auto motion = solver.eigenvectors().col(mode);
      for (int part = 0; part < static_cast<int>(boxes_.size()); ++part) {
        if (motion.segment(part * n_motions, n_motions).norm() > 1e-3) parts.insert(part);
      }
    }
    return {parts.begin(), parts.end()};
  }

 private:
  int n() const { return static_cast<int>(boxes_.size()) * n_motions; }
  double threshold() const { return negligible * negligible * static_cast<double>(n_held_); }

  /// The component of each rigid motion at the point, rotations by angles of 1 / size.
  void add(Eigen::VectorXd& row, double sign, int part, const Point<dim>& point, int component) const {
    const int first = part * n_motions;
    row[first + component] += sign;
    const Point<dim> arm = (point - boxes_[part].center()) / boxes_[part].diagonal().norm();
    if constexpr (dim == 2) {
      row[first + dim] += sign * (component == 0 ? -arm[1] : arm[0]);
    } else {
      const int next = (component + 1) % 3, last = (component + 2) % 3;
      row[first + dim + next] += sign * arm[last];
      row[first + dim + last] -= sign * arm[next];
    }
  }

  void take(const Eigen::VectorXd& row) {
    sum_ += row * row.transpose();
    ++n_held_;
  }

  std::vector<Eigen::AlignedBox<double, dim>> boxes_;
  Eigen::MatrixXd sum_;
  long n_held_ = 0;
  bool is_oblique_ = false;
};

/// The parts of a body, those that hinges or rigid groups join in one cluster, and what holds them.
template <int dim>
class FreeMotions {
 public:
  using Displacements = std::vector<discretization::PrescribedComponent>;
  using RigidGroups = std::vector<discretization::RigidGroup>;

  FreeMotions(const mesh::Mesh<dim>& mesh, const RigidGroups& groups)
      : mesh_(mesh),
        groups_(groups),
        hinges_(mesh::hinges(mesh)),
        parts_(mesh, mesh::parts_of_elements(mesh, hinges_)),
        part_at_(parts_at_nodes()),
        cluster_of_(parts_.count()) {
    base::DisjointSets joined(parts_.count());
    for (const auto& hinge : hinges_) {
      for (const auto& group : hinge.groups) joined.join(part_at_[hinge.node], parts_.of_element(group[0]));
    }
    for (const auto& group : groups_) {
      const auto& nodes = mesh_.node_sets.at(group.node_set);
      for (const int node : nodes) joined.join(part_at_[nodes[0]], part_at_[node]);
    }
    for (int part = 0; part < parts_.count(); ++part) {
      cluster_of_[part] = joined.lowest(part);
      members_[cluster_of_[part]].push_back(part);
    }
  }

  /// A line for each part, or each cluster, that can move.
  std::vector<std::string> describe(const Displacements& displacements,
                                    const std::vector<mesh::SymmetryPlane>& planes) const {
    auto motions = held_by(displacements, planes);
    std::vector<std::string> lines;
    for (const auto& [cluster, members] : members_) {
      const auto found = motions.find(cluster);
      if (found == motions.end()) continue;
      if (members.size() == 1) {
        const std::string names = found->second.free();
        if (names.empty()) continue;
        lines.push_back(fmt::format("{} can move as a whole: {}; prescribe displacements against it",
                                    parts_.name(members[0]), names));
      } else {
        for (const int member : found->second.moving()) lines.push_back(describe_joined(members[member]));
      }
    }
    return lines;
  }

 private:
  const mesh::Mesh<dim>& mesh_;
  const RigidGroups& groups_;
  std::vector<mesh::Hinge> hinges_;
  BodyParts<dim> parts_;
  std::vector<int> part_at_;  ///< one of the parts that have a node
  std::vector<int> cluster_of_;
  std::map<int, std::vector<int>> members_;

  std::string describe_joined(int part) const {
    const auto hinge = std::find_if(hinges_.begin(), hinges_.end(), [&](const mesh::Hinge& one) {
      return std::any_of(one.groups.begin(), one.groups.end(),
                         [&](const auto& group) { return parts_.of_element(group[0]) == part; });
    });
    if (hinge == hinges_.end()) {
      return fmt::format("{} can move, with what a rigid group joins it to; prescribe displacements against it",
                         parts_.name(part));
    }
    return fmt::format(
        "{} can move: it hangs on the rest by a hinge, the node at {}, where elements share no {}; prescribe "
        "displacements against it, or connect the parts by elements",
        parts_.name(part), shown<dim>(mesh_.coordinates[hinge->node]), dim == 2 ? "edge" : "face");
  }

  int place_in_cluster(int part) const {
    const auto& members = members_.at(cluster_of_[part]);
    return static_cast<int>(std::lower_bound(members.begin(), members.end(), part) - members.begin());
  }

  using Motions = std::map<int, RigidMotions<dim>>;  ///< by cluster

  template <class Action>
  void apply(Motions& motions, int part, Action action) const {
    if (const auto found = motions.find(cluster_of_[part]); found != motions.end()) action(found->second);
  }

  Motions held_by(const Displacements& displacements, const std::vector<mesh::SymmetryPlane>& planes) const {
    Motions motions;
    for (const auto& [cluster, members] : members_) {
      if (members.size() > most_joined) continue;
      std::vector<Eigen::AlignedBox<double, dim>> boxes;
      for (const int part : members) boxes.push_back(parts_[part].box);
      motions.emplace(cluster, RigidMotions<dim>(std::move(boxes)));
    }
    for (const auto& d : displacements) {
      const auto* group = moved_by(d, groups_);
      if (group != nullptr && group->shared_component < 0) {
        hold_group(motions, *group, d.component);
        continue;
      }
      hold_nodes(motions, mesh_.node_sets.at(d.node_set), discretization::direction_of<dim>(d));
    }
    for (const auto& plane : planes) hold_nodes(motions, plane.nodes, Point<dim>::Unit(plane.axis));
    for (const auto& group : groups_) join_group(motions, group);
    for (const auto& hinge : hinges_) {
      const int part = part_at_[hinge.node];
      for (const auto& group : hinge.groups) {
        const int other = parts_.of_element(group[0]);
        if (other == part) continue;
        apply(motions, part, [&](auto& some) {
          some.join(place_in_cluster(part), place_in_cluster(other), mesh_.coordinates[hinge.node]);
        });
      }
    }
    return motions;
  }

  void hold_nodes(Motions& motions, const std::vector<int>& nodes, const Point<dim>& direction) const {
    for (const int node : nodes) {
      const int part = part_at_[node];
      apply(motions, part, [&](auto& some) { some.hold(place_in_cluster(part), mesh_.coordinates[node], direction); });
    }
  }

  /// One of its motions is prescribed: that of the part which its first node is in.
  void hold_group(Motions& motions, const discretization::RigidGroup& group, int component) const {
    const auto& nodes = mesh_.node_sets.at(group.node_set);
    const int part = part_at_[nodes[0]];
    const Point<dim> center = discretization::center_of(Teuchos::SerialComm<int>(), mesh_, group);
    apply(motions, part, [&](auto& some) {
      if (component < dim) {
        some.hold(place_in_cluster(part), center, Point<dim>::Unit(component));
      } else {
        some.hold_rotation(place_in_cluster(part), component - discretization::PrescribedComponent::first_rotation);
      }
    });
  }

  /// All parts that it has nodes in move with its first one; those that share a component at each node alike.
  void join_group(Motions& motions, const discretization::RigidGroup& group) const {
    const auto& nodes = mesh_.node_sets.at(group.node_set);
    const int part = part_at_[nodes[0]];
    const auto& first = mesh_.coordinates[nodes[0]];
    for (const int node : nodes) {
      const auto& x = mesh_.coordinates[node];
      apply(motions, part, [&](auto& some) {
        const int one = place_in_cluster(part), other = place_in_cluster(part_at_[node]);
        if (group.shared_component >= 0) {
          some.join(one, first, other, x, group.shared_component);
        } else if (other != one) {
          some.join(one, other, x);
        }
      });
    }
  }

  std::vector<int> parts_at_nodes() const {
    std::vector<int> part_at(mesh_.n_nodes(), 0);
    for (int e = mesh_.n_elements() - 1; e >= 0; --e) {
      for (int c = 0; c < mesh_.n_corners(e); ++c) part_at[mesh_.corners_of(e)[c]] = parts_.of_element(e);
    }
    return part_at;
  }
};

/// Where nodes of one part lie in elements of another.
template <int dim>
class Contacts {
 public:
  struct Contact {
    int n_nodes = 0, first_node = -1;
    bool is_overlap = false;
  };

  Contacts(const mesh::Mesh<dim>& mesh, const BodyParts<dim>& parts) : mesh_(mesh), parts_(parts) {
    std::vector<Point<dim>> centroids;
    for (int e = 0; e < mesh.n_elements(); ++e) {
      centroids.push_back(mesh::centroid(mesh, e));
      largest_radius_ = std::max(largest_radius_, mesh::radius(mesh, e));
    }
    tree_ = std::make_unique<base::PointTree<dim>>(std::move(centroids));
  }

  /// By pairs of parts, the lower one first.
  std::map<std::pair<int, int>, Contact> find() const {
    std::map<std::pair<int, int>, Contact> contacts;
    for (const auto& [node, part] : surface()) {
      if (!may_touch(part, mesh_.coordinates[node])) continue;
      std::map<int, bool> others;  // and whether the node is deep inside
      for (const int e : tree_->within(mesh_.coordinates[node], more * largest_radius_)) {
        if (parts_.of_element(e) == part) continue;
        if (const auto depth = depth_in(e, mesh_.coordinates[node])) others[parts_.of_element(e)] |= *depth > deep;
      }
      for (const auto& [other, is_deep] : others) {
        auto& contact = contacts[std::minmax(part, other)];
        if (contact.n_nodes++ == 0) contact.first_node = node;
        contact.is_overlap |= is_deep;
      }
    }
    return contacts;
  }

 private:
  static constexpr double more = 1. + 1e-5, deep = 1e-3;
  const mesh::Mesh<dim>& mesh_;
  const BodyParts<dim>& parts_;
  double largest_radius_ = 0.;
  std::unique_ptr<base::PointTree<dim>> tree_;

  /// The nodes of the boundary and their parts.
  std::map<int, int> surface() const {
    std::map<int, int> nodes;
    for (const auto& side : mesh_.boundary) {
      for (const int node : mesh::side_nodes(mesh_, side)) nodes[node] = parts_.of_element(side.element);
    }
    return nodes;
  }

  /// By boxes, where there are few parts; it saves a search.
  bool may_touch(int part, const Point<dim>& x) const {
    if (parts_.count() > most_listed) return true;
    const double reach = more * largest_radius_ - largest_radius_;
    for (int other = 0; other < parts_.count(); ++other) {
      if (other != part && parts_[other].box.squaredExteriorDistance(x) <= reach * reach) return true;
    }
    return false;
  }

  /// The smallest shape function there, if the place is in the element.
  std::optional<double> depth_in(int e, const Point<dim>& x) const {
    if ((mesh::centroid(mesh_, e) - x).norm() > more * mesh::radius(mesh_, e)) return std::nullopt;
    std::vector<Point<dim>> corners;
    for (int k = 0; k < mesh_.n_corners(e); ++k) corners.push_back(mesh_.coordinates[mesh_.corners_of(e)[k]]);
    const auto shape = elements::shape_at<dim>(mesh_.types[e], corners, x);
    if (!shape) return std::nullopt;
    return shape->minCoeff();
  }
};

/// Parts that touch or overlap; coincident nodes of two parts are among the contacts.
template <int dim>
void describe_contacts(const mesh::Mesh<dim>& mesh, const BodyParts<dim>& parts, std::vector<std::string>& lines) {
  if (parts.count() == 1) return;
  for (const auto& [pair, contact] : Contacts<dim>(mesh, parts).find()) {
    if (lines.size() == most_listed) return;
    lines.push_back(fmt::format(
        "{} and {} {} at {}, the first at {}, but share none: no force passes from one to the other. Are nodes to be "
        "merged (Coherence in gmsh)?",
        parts.name(pair.first), parts.name(pair.second), contact.is_overlap ? "overlap" : "touch",
        base::counted(contact.n_nodes, "node"), shown<dim>(mesh.coordinates[contact.first_node])));
  }
}

/// Coincident nodes of one part.
template <int dim>
void describe_coincident_nodes(const mesh::Mesh<dim>& mesh, const BodyParts<dim>& parts,
                               std::vector<std::string>& lines) {
  const auto pairs = mesh::coincident_nodes(mesh);
  if (pairs.empty()) return;
  std::map<int, int> part_at;
  for (const auto& side : mesh.boundary) {
    for (const int node : mesh::side_nodes(mesh, side)) part_at[node] = parts.of_element(side.element);
  }
  std::vector<int> inside;
  for (const auto& [node, other] : pairs) {
    if (part_at.at(node) == part_at.at(other)) inside.push_back(node);
  }
  if (inside.empty()) return;
  lines.push_back(
      fmt::format("{} of nodes lie at the same place, the first at {}: the body is open there, and no force passes. Is "
                  "that a crack of the mesh, or are nodes to be merged (Coherence in gmsh)?",
                  base::counted(inside.size(), "pair"), shown<dim>(mesh.coordinates[inside[0]])));
}

template <int dim>
void describe_hinges(const mesh::Mesh<dim>& mesh, std::vector<std::string>& lines) {
  const auto hinges = mesh::hinges(mesh);
  if (hinges.empty()) return;
  lines.push_back(fmt::format(
      "the body has hinges: at {}, the first at {}, elements meet that share no {}, and can turn there",
      base::counted(hinges.size(), "node"), shown<dim>(mesh.coordinates[hinges[0].node]), dim == 2 ? "edge" : "face"));
}

std::vector<discretization::PrescribedComponent> supports_from_the_start(const Case& input) {
  auto displacements = normalized(input.boundary_conditions.displacements);
  const auto is_later = [&](const auto& one) { return std::isfinite(begin_of(one.name, input.loading.steps)); };
  displacements.erase(std::remove_if(displacements.begin(), displacements.end(), is_later), displacements.end());
  return displacements;
}

}  // namespace

template <int dim>
void check_free_motions(const Case& input, const mesh::Mesh<dim>& whole, const std::vector<mesh::SymmetryPlane>& planes,
                        input::Mistakes& mistakes) {
  const auto& conditions = input.boundary_conditions;
  const auto lines = FreeMotions<dim>(whole, conditions.rigid_groups).describe(supports_from_the_start(input), planes);
  const auto add = [&](const std::string& what) {
    mistakes.add(input::line_of(input.lines, displacements_path), displacements_path, what);
  };
  for (std::size_t i = 0; i < std::min<std::size_t>(most_listed, lines.size()); ++i) add(lines[i]);
  if (lines.size() > most_listed) add(fmt::format("and {} other parts", lines.size() - most_listed));
}

template <int dim>
bool is_surely_held(const base::Comm& comm, const Case& input, const mesh::Mesh<dim>& part,
                    const std::vector<mesh::SymmetryPlane>& planes) {
  const auto& groups = input.boundary_conditions.rigid_groups;
  RigidMotions<dim> motions({mesh::box_around(comm, part)});
  const auto hold = [&](const std::vector<int>& nodes, const Point<dim>& direction) {
    for (const int node : nodes) {
      if (node < part.n_owned_nodes) motions.hold(0, part.coordinates[node], direction);
    }
  };
  for (const auto& d : supports_from_the_start(input)) {
    const auto* group = moved_by(d, groups);
    if (group == nullptr || group->shared_component >= 0) {
      hold(part.node_sets.at(d.node_set), discretization::direction_of<dim>(d));
    } else if (const Point<dim> center = discretization::center_of(comm, part, *group); d.component >= dim) {
      motions.hold_rotation(0, d.component - discretization::PrescribedComponent::first_rotation);
    } else {
      motions.hold(0, center, Point<dim>::Unit(d.component));
    }
  }
  for (const auto& plane : planes) hold(plane.nodes, Point<dim>::Unit(plane.axis));
  motions.unite(comm);
  return motions.free().empty();
}

template <int dim>
std::vector<std::string> loose_connections(const mesh::Mesh<dim>& whole) {
  std::vector<std::string> lines;
  const BodyParts<dim> parts(whole, mesh::parts_of_elements(whole));
  describe_contacts(whole, parts, lines);
  describe_coincident_nodes(whole, parts, lines);
  describe_hinges(whole, lines);
  return lines;
}

#define PERIMORPH_INSTANTIATE(dim)                                                                               \
  template void check_free_motions(const Case&, const mesh::Mesh<dim>&, const std::vector<mesh::SymmetryPlane>&, \
                                   input::Mistakes&);                                                            \
  template bool is_surely_held(const base::Comm&, const Case&, const mesh::Mesh<dim>&,                           \
                               const std::vector<mesh::SymmetryPlane>&);                                         \
  template std::vector<std::string> loose_connections(const mesh::Mesh<dim>&);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::cases
