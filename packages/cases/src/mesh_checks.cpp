#include "mesh_checks.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numeric>

#include "group_checks.hpp"
#include "perimorph/base/errors.hpp"
#include "perimorph/cases/geometry.hpp"
#include "perimorph/elements/locator.hpp"

namespace perimorph::cases {

namespace {

using base::Point;
using input::in_quotes;
using input::Mistakes;

constexpr double negligible = 1e-6;  // motion of the supports, relative to that of the part
constexpr int most_listed = 10;      // parts in a message

const std::string displacements_path = "/Boundary Conditions/Displacements";

/// The rigid motions of one part that its supports leave free.
template <int dim>
class RigidMotions {
 public:
  static constexpr int n_rotations = dim == 2 ? 1 : 3, n_motions = dim + n_rotations;
  using Row = Eigen::Matrix<double, 1, n_motions>;

  RigidMotions(const Point<dim>& center, double size) : center_(center), size_(size) {}

  /// A support: the component of each rigid motion at the point, rotations by angles of 1 / size.
  void hold(const Point<dim>& point, int component) {
    Row row = Row::Zero();
    row[component] = 1.;
    const Point<dim> arm = (point - center_) / size_;
    if constexpr (dim == 2) {
      row[dim] = component == 0 ? -arm[1] : arm[0];
    } else {
      const int next = (component + 1) % 3, last = (component + 2) % 3;
      row[dim + next] = arm[last];
      row[dim + last] = -arm[next];
    }
    sum_ += row.transpose() * row;
    ++n_held_;
  }

  /// What is free, in words ("translation in x, rotation"), or "".
  std::string free() const {
    std::vector<std::string> names;
    for (int motion = 0; motion < n_motions; ++motion) {
      if (sum_(motion, motion) > threshold()) continue;
      names.push_back(motion < dim ? fmt::format("translation in {}", "xyz"[motion])
                      : dim == 2   ? "rotation"
                                   : fmt::format("rotation about {}", "xyz"[motion - dim]));
    }
    const int n_others = n_motions - rank() - static_cast<int>(names.size());
    if (n_others > 0) names.emplace_back(n_others == 1 ? "rotation" : fmt::format("{} rotations", n_others));
    return fmt::format("{}", fmt::join(names, ", "));
  }

 private:
  double threshold() const { return negligible * negligible * static_cast<double>(n_held_); }

  int rank() const {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, n_motions, n_motions>> solver(sum_);
    return static_cast<int>((solver.eigenvalues().array() > threshold()).count());
  }

  Point<dim> center_;
  double size_;
  Eigen::Matrix<double, n_motions, n_motions> sum_ = Eigen::Matrix<double, n_motions, n_motions>::Zero();
  long n_held_ = 0;
};

/// The part of the body that each node is in, from 0: elements that share a node are of one part.
template <int dim>
std::vector<int> part_of_nodes(const mesh::Mesh<dim>& mesh) {
  std::vector<int> lower(mesh.n_nodes());  // a node of the same part, itself for the lowest
  std::iota(lower.begin(), lower.end(), 0);
  const auto lowest = [&](int node) {
    while (lower[node] != node) node = lower[node] = lower[lower[node]];
    return node;
  };
  for (int e = 0; e < mesh.n_elements(); ++e) {
    for (int c = 1; c < mesh.n_corners(e); ++c) {
      const int a = lowest(mesh.corners_of(e)[c - 1]), b = lowest(mesh.corners_of(e)[c]);
      lower[std::max(a, b)] = std::min(a, b);
    }
  }
  std::vector<int> part(lower.size());
  int n_parts = 0;
  for (int node = 0; node < mesh.n_nodes(); ++node) part[node] = lower[node] == node ? n_parts++ : part[lowest(node)];
  return part;
}

/// One connected part of the body.
template <int dim>
struct Part {
  int n_elements = 0;
  Eigen::AlignedBox<double, dim> box;
};

template <int dim>
class Checks {
 public:
  Checks(const Case& input, const mesh::Mesh<dim>& whole, Mistakes& mistakes)
      : input_(input), mesh_(whole), mistakes_(mistakes) {}

  void run() {
    check_groups(input_.resolved, input_.lines, mesh_, mistakes_);
    const bool are_supports_known = mistakes_.none_in(displacements_path);
    check_contradictions();
    if (are_supports_known) check_free_motions();
    if (!mistakes_.none_in("/Mesh")) return;  // lengths may be wrong
    check_probes();
    if (mistakes_.none_in("/Peridynamics")) check_horizon();
  }

 private:
  void add(const std::string& path, const std::string& what) {
    mistakes_.add(input::line_of(input_.lines, path), path, what);
  }

  // ---- probes ----

  void check_probes() {
    const elements::Locator<dim> locator(mesh_);
    for (const auto& probe : input_.output.probes) {
      for (const auto& x : places_of<dim>(probe)) {
        if (locator.find(x)) continue;
        const auto is_nearer = [&](const Point<dim>& a, const Point<dim>& b) {
          return (a - x).norm() < (b - x).norm();
        };
        const auto& nearest = *std::min_element(mesh_.coordinates.begin(), mesh_.coordinates.end(), is_nearer);
        add("/Output/Probes/" + probe.name + "/Points",
            fmt::format(
                "({:.6g}) is outside the body; allowed are places in it, the nearest node of which is at ({:.6g})",
                fmt::join(x.begin(), x.end(), ", "), fmt::join(nearest.begin(), nearest.end(), ", ")));
        break;  // one place of a line says enough
      }
    }
  }

  // ---- contradictions ----

  void check_contradictions() {
    const auto& conditions = input_.boundary_conditions.displacements;
    std::map<std::pair<int, int>, std::vector<int>> nodes_of_pair;
    for (const auto& [first, second, node] : discretization::contradictions(mesh_, conditions)) {
      nodes_of_pair[{first, second}].push_back(node);
    }
    for (const auto& [pair, nodes] : nodes_of_pair) {
      const auto &a = conditions[pair.first], &b = conditions[pair.second];
      add(displacements_path + "/" + b.name,
          fmt::format("prescribes another {} displacement than {}/{} on {} node{} that both groups have, the first at "
                      "({:.6g}); allowed is one value per node",
                      "xyz"[b.component], displacements_path, a.name, nodes.size(), nodes.size() == 1 ? "" : "s",
                      fmt::join(mesh_.coordinates[nodes[0]].begin(), mesh_.coordinates[nodes[0]].end(), ", ")));
    }
  }

  // ---- parts of the body that are not held ----

  void check_free_motions() {
    const std::vector<int> part = part_of_nodes(mesh_);
    const std::vector<Part<dim>> parts = describe_parts(part);
    std::vector<RigidMotions<dim>> motions;
    for (const auto& one : parts) motions.emplace_back(one.box.center(), one.box.diagonal().norm());
    for (const auto& d : input_.boundary_conditions.displacements) {
      for (const int node : mesh_.node_sets.at(d.node_set)) {
        motions[part[node]].hold(mesh_.coordinates[node], d.component);
      }
    }
    int n_free = 0;
    for (std::size_t p = 0; p < parts.size(); ++p) {
      const std::string names = motions[p].free();
      if (names.empty() || ++n_free > most_listed) continue;
      add(displacements_path,
          fmt::format("{} can move as a whole: {}; prescribe displacements against it", name_of(parts, p), names));
    }
    if (n_free > most_listed) add(displacements_path, fmt::format("and {} other parts", n_free - most_listed));
  }

  std::vector<Part<dim>> describe_parts(const std::vector<int>& part) const {
    std::vector<Part<dim>> parts(1 + static_cast<std::size_t>(*std::max_element(part.begin(), part.end())));
    for (int e = 0; e < mesh_.n_elements(); ++e) ++parts[part[mesh_.corners_of(e)[0]]].n_elements;
    for (int node = 0; node < mesh_.n_nodes(); ++node) parts[part[node]].box.extend(mesh_.coordinates[node]);
    return parts;
  }

  static std::string name_of(const std::vector<Part<dim>>& parts, std::size_t p) {
    if (parts.size() == 1) return "the body";
    const Point<dim> low = parts[p].box.min(), high = parts[p].box.max();
    return fmt::format("part {} of {} of the body ({} element{}, from ({:.6g}) to ({:.6g}))", p + 1, parts.size(),
                       parts[p].n_elements, parts[p].n_elements == 1 ? "" : "s",
                       fmt::join(low.begin(), low.end(), ", "), fmt::join(high.begin(), high.end(), ", "));
  }

  // ---- the horizon ----

  /// With a horizon that ends inside the element hardly any bond leads out of it, and the zone is no solid body.
  void check_horizon() {
    for (const Seed& seed : input_.morphing.seeds) {
      if (seed.shape == SeedShape::automatic) continue;
      const auto zone = zone_of<dim>(seed);
      double largest = 0.;
      Point<dim> center = Point<dim>::Zero();
      for (int e = 0; e < mesh_.n_elements(); ++e) {
        const Point<dim> x = mesh::centroid(mesh_, e);
        const double reach = mesh::radius(mesh_, e);
        if (reach <= largest || zone.alpha(x, input_.numerical.blending_function) < 1.) continue;
        largest = reach;
        center = x;
      }
      if (largest <= input_.peridynamics.horizon) continue;
      add("/Peridynamics/Horizon",
          fmt::format("found {:.6g}, but in the seed {} the element at ({:.6g}) reaches {:.6g} from its centre to its "
                      "corners; allowed is no less than that (three element sizes are usual), or a finer mesh there",
                      input_.peridynamics.horizon, in_quotes(seed.name), fmt::join(center.begin(), center.end(), ", "),
                      largest));
    }
  }

  const Case& input_;
  const mesh::Mesh<dim>& mesh_;
  Mistakes& mistakes_;
};

}  // namespace

template <int dim>
void check_against_mesh(const Case& input, const mesh::Mesh<dim>& whole, input::Mistakes& mistakes) {
  Checks<dim>(input, whole, mistakes).run();
}

template void check_against_mesh(const Case&, const mesh::Mesh<2>&, input::Mistakes&);
template void check_against_mesh(const Case&, const mesh::Mesh<3>&, input::Mistakes&);

}  // namespace perimorph::cases
