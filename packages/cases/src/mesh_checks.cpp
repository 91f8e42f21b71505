#include "mesh_checks.hpp"

#include <Eigen/Geometry>
#include <Teuchos_DefaultSerialComm.hpp>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "body_parts.hpp"
#include "group_checks.hpp"
#include "part_checks.hpp"
#include "perimorph/base/errors.hpp"
#include "perimorph/base/text.hpp"
#include "perimorph/cases/geometry.hpp"
#include "perimorph/elements/locator.hpp"
#include "perimorph/mesh/distribute.hpp"
#include "perimorph/mesh/extent.hpp"
#include "perimorph/mesh/images.hpp"
#include "perimorph/mesh/parts.hpp"
#include "place_checks.hpp"
#include "support_advice.hpp"

namespace perimorph::cases {

namespace {

using base::Point;
using input::in_quotes;
using input::Mistakes;

/// Such that powers of its lengths are numbers. Collective.
template <int dim>
bool has_usual_size(const base::Comm& comm, const Case& input, const mesh::Mesh<dim>& mesh, Mistakes& mistakes) {
  constexpr double smallest = 1e-30, largest = 1e30;
  const double size = mesh::box_around(comm, mesh).diagonal().norm();
  if (size >= smallest && size <= largest) return true;
  mistakes.add(input::line_of(input.lines, "/Mesh/Scale"), "/Mesh/Scale",
               fmt::format("found {:.6g}, by which the body has the size {:.3g}; allowed are bodies from {} to {}",
                           input.mesh.scale, size, smallest, largest));
  return false;
}

/// Of a whole mesh, or of what each rank has of one: then a mistake on any rank says that there may be one, though
/// perhaps not in these words.
template <int dim>
class Checks {
 public:
  Checks(const base::Comm& comm, const Case& input, const mesh::Mesh<dim>& mesh, Mistakes& mistakes)
      : comm_(comm), input_(input), mesh_(mesh), mistakes_(mistakes) {}

  /// Collective.
  void run() {
    check_groups(input_.resolved, input_.lines, mesh_, mistakes_);
    const bool are_supports_known = mistakes_.none_in(displacements_path) && mistakes_.none_in(rigid_groups_path);
    check_contradictions();
    check_group_conflicts();
    const auto planes = mistakes_.none_in(symmetry_planes_path) ? checked_planes() : std::vector<mesh::SymmetryPlane>();
    if (are_supports_known && none_anywhere_in(symmetry_planes_path)) check_supports(planes);
    if (!mistakes_.none_in("/Mesh")) return;  // lengths may be wrong
    check_measured_points();
    check_probes();
    if (!mistakes_.none_in("/Peridynamics")) return;
    check_longest_horizon();
    check_shortest_horizon();
  }

 private:
  void add(const std::string& path, const std::string& what) {
    mistakes_.add(input::line_of(input_.lines, path), path, what);
  }

  /// Of what any rank alone may find.
  bool none_anywhere_in(const std::string& path) const {
    return base::max(comm_, static_cast<base::GlobalId>(!mistakes_.none_in(path))) == 0;
  }

  void check_supports(const std::vector<mesh::SymmetryPlane>& planes) {
    if (comm_.getSize() == 1) return check_free_motions(input_, mesh_, planes, mistakes_);
    if (!is_surely_held(comm_, input_, mesh_, planes)) add(displacements_path, "parts of the body may move");
  }

  // ---- points at which something is measured ----

  void check_probes() {
    for (const auto& probe : input_.output.probes) {
      check_inside("/Output/Probes/" + probe.name + "/Points", places_of<dim>(probe));
    }
  }

  /// Of as many numbers as they should have.
  void check_measured_points() {
    const auto& measure = input_.loading.measure;
    for (const auto& [name, x] : {std::pair("Point", &measure.point), std::pair("Other Point", &measure.other_point)}) {
      if (x->size() == dim) check_inside(std::string("/Loading/Measure/") + name, {point<dim>(*x)});
    }
  }

  /// One place of a line says enough.
  void check_inside(const std::string& path, const std::vector<Point<dim>>& places) {
    if (!locator_) locator_ = std::make_unique<elements::Locator<dim>>(mesh_);
    std::vector<double> n_finds;  // by place: on how many ranks it is
    for (const auto& x : places) n_finds.push_back(locator_->find(x) ? 1. : 0.);
    base::sum(comm_, n_finds);
    const auto first = std::find(n_finds.begin(), n_finds.end(), 0.) - n_finds.begin();
    if (first == static_cast<std::ptrdiff_t>(places.size())) return;
    const auto outside = places.begin() + first;
    const auto is_nearer = [&](const Point<dim>& a, const Point<dim>& b) {
      return (a - *outside).norm() < (b - *outside).norm();
    };
    const auto& nearest = *std::min_element(mesh_.coordinates.begin(), mesh_.coordinates.end(), is_nearer);
    add(path, fmt::format(
                  "({:.6g}) is outside the body; allowed are places in it, the nearest node of which is at ({:.6g})",
                  fmt::join(outside->begin(), outside->end(), ", "), fmt::join(nearest.begin(), nearest.end(), ", ")));
  }

  // ---- contradictions ----

  void check_contradictions() {
    auto conditions = normalized(input_.boundary_conditions.displacements);
    for (auto& one : conditions) {
      one.value.begin = begin_of(one.name, input_.loading.steps);
      one.value.end = end_of(one.name, input_.loading.steps);
    }
    std::map<std::pair<int, int>, std::vector<int>> nodes_of_pair;
    for (const auto& [first, second, node] :
         discretization::contradictions(mesh_, conditions, input_.boundary_conditions.rigid_groups)) {
      nodes_of_pair[{first, second}].push_back(node);
    }
    for (const auto& [pair, nodes] : nodes_of_pair) {
      const auto &a = conditions[pair.first], &b = conditions[pair.second];
      add(fmt::format("{}/{}", displacements_path, b.name),
          fmt::format("prescribes another {} than {}/{} on {} that both groups have, the first at "
                      "({:.6g}); allowed is one value per node",
                      discretization::name_of_displacement(b), displacements_path, a.name,
                      base::counted(nodes.size(), "node"),
                      fmt::join(mesh_.coordinates[nodes[0]].begin(), mesh_.coordinates[nodes[0]].end(), ", ")));
    }
  }

  void check_group_conflicts() {
    const auto& conditions = input_.boundary_conditions;
    for (const auto& [group, other, node] :
         discretization::group_conflicts(mesh_, conditions.rigid_groups, normalized(conditions.displacements))) {
      add(fmt::format("{}/{}", rigid_groups_path, group),
          fmt::format("has the node at ({:.6g}), and others perhaps, in common with the {}, which moves it otherwise; "
                      "allowed are nodes of its own",
                      fmt::join(mesh_.coordinates[node], ", "), other));
    }
  }

  // ---- planes of symmetry ----

  std::vector<mesh::SymmetryPlane> checked_planes() {
    std::vector<mesh::SymmetryPlane> planes;
    std::map<int, std::string> name_across;
    for (const auto& [name, group] : input_.boundary_conditions.symmetry_planes) {
      const auto path = fmt::format("{}/{}", symmetry_planes_path, name);
      try {
        planes.push_back(mesh::symmetry_plane(comm_, mesh_, group));
      } catch (const base::UserError& error) {
        add(path, error.what());
        continue;
      }
      const auto [first, is_new] = name_across.emplace(planes.back().axis, name);
      if (!is_new) add(path, fmt::format("is parallel to {}; allowed is one across each axis", first->second));
      check_that_nothing_moves(path, planes.back());
    }
    return planes;
  }

  /// By other conditions than the plane itself, across it.
  void check_that_nothing_moves(const std::string& path, const mesh::SymmetryPlane& plane) {
    const auto& conditions = input_.boundary_conditions;
    const auto refuse = [&](const std::string& node_set, const std::string& what) {
      const auto found = mesh_.node_sets.find(node_set);
      if (found == mesh_.node_sets.end()) return;
      const auto node = std::find_if(found->second.begin(), found->second.end(), [&](int n) {
        return std::binary_search(plane.nodes.begin(), plane.nodes.end(), n);
      });
      if (node == found->second.end()) return;
      add(path,
          fmt::format("has the node at ({:.6g}), and others perhaps, in common with {}, which moves it across the "
                      "plane; allowed is what leaves it there",
                      fmt::join(mesh_.coordinates[*node], ", "), what));
    };
    for (const auto& one : normalized(conditions.displacements)) {
      if (moved_by(one, conditions.rigid_groups) != nullptr) continue;
      const bool is_along = one.direction.empty() && one.component != plane.axis;
      if (!is_along) refuse(one.node_set, fmt::format("{}/{}", displacements_path, one.name));
    }
    for (const auto& one : conditions.rigid_groups) {
      const bool is_along = one.shared_component >= 0 && one.shared_component != plane.axis;
      if (!is_along) refuse(one.node_set, fmt::format("{}/{}", rigid_groups_path, one.name));
    }
  }

  // ---- the horizon ----

  /// There are no longer bonds than the body is.
  void check_longest_horizon() {
    const Eigen::AlignedBox<double, dim> box = mesh::box_around(comm_, mesh_);
    const double size = box.diagonal().norm();
    if (input_.morphing.seeds.empty() || input_.peridynamics.horizon <= size) return;
    add("/Peridynamics/Horizon",
        fmt::format(
            "found {:.6g}; allowed is up to {:.6g}, the longest distance in the body, which is from {} to {}. Is "
            "the unit that of the mesh?",
            input_.peridynamics.horizon, size, shown<dim>(box.min()), shown<dim>(box.max())));
  }

  /// With a horizon that ends inside the element hardly any bond leads out of it, and the zone is no solid body.
  void check_shortest_horizon() {
    for (const Seed& seed : input_.morphing.seeds) {
      if (seed.shape == SeedShape::automatic) continue;
      const auto zone = zone_of<dim>(seed);
      double largest = 0.;
      Point<dim> center = Point<dim>::Zero();
      for (int e = 0; e < mesh_.n_elements(); ++e) {
        const Point<dim> x = mesh::centroid(mesh_, e);
        const double reach = std::ldexp(mesh::radius(mesh_, e), -input_.numerical.refinement.levels);
        if (reach <= largest || zone.alpha(x, input_.numerical.blending_function) < 1.) continue;
        largest = reach;
        center = x;
      }
      if (largest <= input_.peridynamics.horizon) continue;
      add("/Peridynamics/Horizon",
          fmt::format("found {:.6g}, but in the seed {} the element at ({:.6g}) reaches {:.6g} from its centre to its "
                      "corners{}; allowed is no less than that (three element sizes are usual), or a finer mesh there",
                      input_.peridynamics.horizon, in_quotes(seed.name), fmt::join(center.begin(), center.end(), ", "),
                      largest, input_.numerical.refinement.levels > 0 ? " when it is refined" : ""));
    }
  }

  const base::Comm& comm_;
  const Case& input_;
  const mesh::Mesh<dim>& mesh_;
  Mistakes& mistakes_;
  std::unique_ptr<elements::Locator<dim>> locator_;  ///< made when it is needed
};

}  // namespace

template <int dim>
std::vector<std::string> open_and_check(const Case& input, mesh::Mesh<dim>& whole, input::Mistakes& mistakes) {
  const Teuchos::SerialComm<int> alone;
  if (!has_usual_size(alone, input, whole, mistakes)) return {};
  if (mistakes.none_in("/Mesh")) check_places(input, whole, mistakes);
  auto warnings = loose_connections(whole);
  if (!input.pre_cracks.empty()) mesh::open_along<dim>(whole, facets_of<dim>(input.pre_cracks));
  Checks<dim>(alone, input, whole, mistakes).run();
  if (!mistakes.empty()) return {};
  for (auto& line : warnings) line.insert(0, "/Mesh/File: ");
  for (const auto& line : advice_on_supports(input, whole)) warnings.push_back(line);
  return warnings;
}

template <int dim>
bool open_if_sound(const base::Comm& comm, const Case& input, mesh::Mesh<dim>& part) {
  const auto is_on_any_rank = [&](bool here) { return base::max(comm, static_cast<base::GlobalId>(here)) > 0; };
  input::Mistakes mistakes(input.file);  // in words that nobody reads
  if (!has_usual_size(comm, input, part, mistakes) || !are_surely_in_body(comm, input, part)) return false;
  const auto before = mesh::connections(comm, part);
  if (before.n_parts > 1 || before.n_hinges > 0 || is_on_any_rank(!mesh::coincident_nodes(part).empty())) return false;
  if (!input.pre_cracks.empty()) {
    mesh::open_along<dim>(comm, part, facets_of<dim>(input.pre_cracks));
    part = mesh::distribute(comm, part, 0.);
    if (mesh::connections(comm, part).n_parts > 1) return false;
  }
  Checks<dim>(comm, input, part, mistakes).run();
  return !is_on_any_rank(!mistakes.empty()) && !is_on_any_rank(!advice_on_supports(input, part).empty());
}

#define PERIMORPH_INSTANTIATE(dim)                                                                   \
  template std::vector<std::string> open_and_check(const Case&, mesh::Mesh<dim>&, input::Mistakes&); \
  template bool open_if_sound(const base::Comm&, const Case&, mesh::Mesh<dim>&);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::cases
