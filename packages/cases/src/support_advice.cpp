#include "support_advice.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "body_parts.hpp"
#include "part_checks.hpp"
#include "perimorph/cases/geometry.hpp"
#include "perimorph/mesh/sorted_sides.hpp"

namespace perimorph::cases {

namespace {

constexpr double flatness = 1e-6;  // of an element's radius

using discretization::PrescribedComponent;

/// One support against one component.
template <int dim>
class Support {
 public:
  using Box = Eigen::AlignedBox<double, dim>;

  Support(const Case& input, const mesh::Mesh<dim>& whole, const PrescribedComponent& support)
      : input_(input), mesh_(whole), support_(support), has_node_(whole.n_nodes(), 0) {
    for (const int node : whole.node_sets.at(support.node_set)) has_node_[node] = 1;
    for (const Seed& seed : input.morphing.seeds) {
      if (seed.shape != SeedShape::automatic) zones_.push_back(zone_of<dim>(seed));
    }
  }

  /// The stretch of a straight side of the body that is held, only across it, in a zone; empty if there is none.
  Box stretch() const {
    Box box;
    if (support_.value.rate != 0. || support_.value.constant != 0. || zones_.empty()) return box;
    for (const auto& side : mesh_.boundary) {
      if (!is_held(side) || !is_across(side) || !is_in_a_zone(side)) continue;
      const auto corners = mesh::corner_points(mesh_, side);
      if (!box.isEmpty() &&
          std::abs(corners[0][support_.component] - box.min()[support_.component]) > tolerance(side)) {
        return Box();  // several sides
      }
      if (!is_free_along(side)) return Box();
      for (const auto& corner : corners) box.extend(corner);
    }
    return box;
  }

 private:
  const Case& input_;
  const mesh::Mesh<dim>& mesh_;
  const PrescribedComponent& support_;
  std::vector<char> has_node_;
  std::vector<morphing::Zone<dim>> zones_;

  double tolerance(const mesh::Side& side) const { return flatness * mesh::radius(mesh_, side.element); }

  bool is_in_a_zone(const mesh::Side& side) const {
    const auto center = mesh::centroid(mesh_, side.element);
    return std::any_of(zones_.begin(), zones_.end(),
                       [&](const auto& zone) { return zone.alpha(center, input_.numerical.blending_function) > 0.; });
  }

  /// Whether the side is a piece of a plane across the component.
  bool is_across(const mesh::Side& side) const {
    const auto corners = mesh::corner_points(mesh_, side);
    return std::all_of(corners.begin(), corners.end(), [&](const auto& x) {
      return std::abs(x[support_.component] - corners[0][support_.component]) <= tolerance(side);
    });
  }

  bool is_held(const mesh::Side& side) const {
    const auto nodes = mesh::side_nodes(mesh_, side);
    return std::all_of(nodes.begin(), nodes.end(), [&](int node) { return has_node_[node] != 0; });
  }

  /// Whether no other displacement holds that side's nodes along it, as a clamp does.
  bool is_free_along(const mesh::Side& side) const {
    const auto nodes = mesh::side_nodes(mesh_, side);
    const auto& all = input_.boundary_conditions.displacements;
    return std::none_of(all.begin(), all.end(), [&](const PrescribedComponent& other) {
      const auto& set = mesh_.node_sets.at(other.node_set);
      return other.component != support_.component && std::all_of(nodes.begin(), nodes.end(), [&](int node) {
               return std::binary_search(set.begin(), set.end(), node);
             });
    });
  }
};

}  // namespace

template <int dim>
std::vector<std::string> advice_on_supports(const Case& input, const mesh::Mesh<dim>& whole) {
  std::vector<std::string> lines;
  if (!can_break(input)) return lines;
  for (const auto& one : normalized(input.boundary_conditions.displacements)) {
    const bool is_along_axis = one.direction.empty() && one.component < dim;
    if (!is_along_axis || moved_by(one, input.boundary_conditions.rigid_groups) != nullptr) continue;
    const auto stretch = Support<dim>(input, whole, one).stretch();
    if (stretch.isEmpty() || stretch.diagonal().norm() < input.peridynamics.horizon) continue;
    lines.push_back(fmt::format(
        "{}/{}: holds a straight side of the body across it, inside a peridynamic zone (from {} to {}). If it "
        "is a plane of symmetry, the bonds across it are missing, and a crack on it runs at a load that is "
        "a fifth too low: make it one of /Boundary Conditions/Symmetry Planes instead",
        displacements_path, one.name, shown<dim>(stretch.min()), shown<dim>(stretch.max())));
  }
  return lines;
}

template std::vector<std::string> advice_on_supports(const Case&, const mesh::Mesh<2>&);
template std::vector<std::string> advice_on_supports(const Case&, const mesh::Mesh<3>&);

}  // namespace perimorph::cases
