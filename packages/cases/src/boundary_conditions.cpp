#include "perimorph/cases/boundary_conditions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "choices.hpp"
#include "perimorph/base/text.hpp"
#include "shapes.hpp"

namespace perimorph::cases {

namespace {

using discretization::PrescribedComponent;
using discretization::RigidGroup;
using Teuchos::ParameterList;

constexpr int first_rotation = PrescribedComponent::first_rotation;
constexpr std::array<Choice<int>, 6> components{{{"x", 0},
                                                 {"y", 1},
                                                 {"z", 2, 3},
                                                 {"rotation x", first_rotation, 3},
                                                 {"rotation y", first_rotation + 1, 3},
                                                 {"rotation z", first_rotation + 2}}};
constexpr std::array<Choice<int>, 4> shared{{{"Rigid Motion", -1}, {"x", 0}, {"y", 1}, {"z", 2, 3}}};
constexpr const char* load_names[] = {"Rate", "Constant"};

void declare_displacement(const input::Section& section, PrescribedComponent& one) {
  using namespace input;
  section.required("Group", one.node_set, "left", text("the name of a group"), "A physical group of the mesh.");
  section.optional_choice("Component", one.component, components,
                          "What is held or moved; all else stays free. z in three dimensions only. Of a rigid group "
                          "(Rigid Groups) it is that of its centre, or a small rotation about an axis through it, "
                          "[rad]; in two dimensions about z.");
  section.optional(
      "Direction", one.direction, {0.6, 0.8}, numbers("{x, y} or {x, y, z}"),
      "Instead of a component: the direction along which the displacement is held or moved, one number "
      "per dimension; its length does not matter. Across it the nodes stay free, as on an inclined roller.");
  section.parameter("Rate", one.value.rate, any_number(),
                    "[length per increment]: what loads the body; 0 holds it. Its sign is that of the axis.");
  section.parameter("Constant", one.value.constant, any_number(), "[length], there from the first increment on.");
}

void declare_rigid_group(const input::Section& section, RigidGroup& one) {
  using namespace input;
  section.required("Group", one.node_set, "hole", text("the name of a group"), "A physical group of the mesh.");
  section.choice("Shared", one.shared_component, shared,
                 "What its nodes have in common: the motion of a rigid body, by small rotations (a pin in a hole, a "
                 "platen); or one component of their displacement, which then is the same for all (a platen without "
                 "friction that does not tilt), and they are free across it.");
  section.optional("Center", one.center, {0., 0.}, numbers("{x, y} or {x, y, z}"),
                   "The point about which it turns [length], one number per dimension. Without it the mean of its "
                   "nodes.");
}

void declare_symmetry_plane(const input::Section& section, SymmetryPlane& one) {
  using namespace input;
  section.required("Group", one.group, "left", text("the name of a group"),
                   "A physical group of the mesh: all of the plane that is in the body. What of it is left out is a "
                   "free surface, such as a crack along the plane.");
}

void declare_traction(const input::Section& section, Traction& one) {
  using namespace input;
  const auto vector = numbers("{x, y} or {x, y, z}");
  section.required("Group", one.group, "right", text("the name of a group"),
                   "A physical group of the mesh: part of its boundary.");
  section.parameter("Rate", one.rate, vector, "[stress per increment], one number per dimension; {} is zero.");
  section.parameter("Constant", one.constant, vector, "[stress], one number per dimension; {} is zero.");
}

void declare_pressure(const input::Section& section, Pressure& one) {
  using namespace input;
  section.required("Group", one.group, "hole", text("the name of a group"),
                   "A physical group of the mesh: part of its boundary.");
  section.parameter("Rate", one.rate, any_number(),
                    "[stress per increment]; what is positive presses on the body, what is negative pulls.");
  section.parameter("Constant", one.constant, any_number(), "[stress].");
}

/// What the rigid groups share, by their group of the mesh.
using Shared = std::map<std::string, std::string>;

void check_along(const input::Values& displacement, const Shared& rigid, int dimension) {
  check_direction(displacement, "Direction", dimension);
  const std::string* group = displacement.text("Group");
  if (!displacement.given("Direction") || group == nullptr || rigid.count(*group) == 0) return;
  displacement.mistake(
      "Direction",
      fmt::format("found with the rigid group {}; allowed is a \"Component\" of its motion", input::in_quotes(*group)));
}

/// Only rigid bodies turn, and what a group shares need not be prescribed for each node.
void check_component(const input::Values& displacement, const Shared& rigid) {
  const std::string *group = displacement.text("Group"), *component = displacement.text("Component");
  if (group == nullptr || component == nullptr) return;
  const auto found = rigid.find(*group);
  const bool is_rigid_body = found != rigid.end() && found->second == shared[0].word;
  if (input::value_of(components, *component) < first_rotation || is_rigid_body) return;
  displacement.mistake("Component",
                       fmt::format("found {} of the group {}, which is no rigid body; allowed is it for "
                                   "groups of /Boundary Conditions/Rigid Groups with \"Shared\" = \"{}\"",
                                   input::in_quotes(*component), input::in_quotes(*group), shared[0].word));
}

Shared check_rigid_groups(const input::Values& conditions, int dimension) {
  Shared seen;
  for (const auto& one : conditions.subs("Rigid Groups")) {
    const std::string *group = one.text("Group"), *what = one.text("Shared");
    check_choice(one, "Shared", shared, dimension);
    check_size(one, "Center", dimension);
    if (group == nullptr || what == nullptr) continue;
    if (one.given("Center") && *what != shared[0].word) {
      one.mistake("Center", fmt::format("found with \"Shared\" = {}, where it has no effect; allowed is it with \"{}\"",
                                        input::in_quotes(*what), shared[0].word));
    }
    if (seen.emplace(*group, *what).second) continue;
    one.mistake("Group", fmt::format("found {} again; allowed is each group once", input::in_quotes(*group)));
  }
  return seen;
}

void check_displacements(const input::Values& conditions, int dimension) {
  const Shared rigid = check_rigid_groups(conditions, dimension);
  std::map<std::pair<std::string, std::string>, std::string> seen;
  for (const auto& one : conditions.subs("Displacements")) {
    const std::string *group = one.text("Group"), *component = one.text("Component");
    check_choice(one, "Component", components, dimension);
    check_component(one, rigid);
    check_along(one, rigid, dimension);
    if (!one.given("Component") && !one.given("Direction")) {
      one.mistake("Component", "missing; needed is either it or a \"Direction\"");
    }
    if (one.given("Component") && one.given("Direction")) {
      one.mistake("Direction", "found beside \"Component\"; allowed is one of the two");
    }
    if (group == nullptr || component == nullptr) continue;
    const auto [first, is_new] = seen.emplace(std::make_pair(*group, *component), one.path());
    if (is_new) continue;
    one.mistake("Component",
                fmt::format("found the group {} with \"{}\" again; {} prescribes that displacement already",
                            input::in_quotes(*group), *component, first->second));
  }
}

/// No numbers at all stand for zeros.
void check_load(const input::Values& load, int dimension) {
  for (const char* name : load_names) {
    const auto* values = load.numbers(name);
    if (values != nullptr && !values->empty()) check_size(load, name, dimension);
  }
}

void fill_with_zeros(ParameterList& load, int dimension) {
  using Numbers = Teuchos::Array<double>;
  for (const char* name : load_names) {
    if (load.get<Numbers>(name).empty()) load.set(name, Numbers(dimension, 0.));
  }
}

}  // namespace

void declare(const input::Section& section, BoundaryConditions& conditions) {
  using namespace input;
  section.entries("Displacements", conditions.displacements, declare_displacement,
                  "Prescribed displacements, each a list with a name of your choice: one component of one group, or "
                  "that along a direction. In increment k it is Rate * k + Constant.",
                  "One component of one group.");
  section.entries("Rigid Groups", conditions.rigid_groups, declare_rigid_group,
                  "Groups that move as one, each a list with a name of your choice. What displacements do not "
                  "prescribe of their motion is free: it follows from the forces on them.",
                  "One group.");
  section.entries("Symmetry Planes", conditions.symmetry_planes, declare_symmetry_plane,
                  "Planes across an axis, each a list with a name of your choice, beyond which the body goes on as its "
                  "mirror image: a half, a quarter or an eighth of it is computed, bonds across the planes included. "
                  "Nothing moves across them, but where a crack runs on them. Forces, energies and bonds are those of "
                  "the part that is computed.",
                  "One plane.");
  section.entries("Tractions", conditions.tractions, declare_traction,
                  "Forces on parts of the boundary, each a list with a name of your choice. In increment k the "
                  "traction is Rate * k + Constant.",
                  "The traction on one group.");
  section.entries("Pressures", conditions.pressures, declare_pressure,
                  "Pressures on parts of the boundary, along their normals in the undeformed body, each a list with a "
                  "name of your choice. In increment k the pressure is Rate * k + Constant.",
                  "The pressure on one group.");
  section.entries("Temperatures", conditions.temperatures, declare,
                  "Changes of temperature from the state without stress, or of moisture in a body that shrinks as it "
                  "dries, each a list with a name of your choice. In increment k the change is Rate * k + Constant; "
                  "changes in the same place add up. They strain the body by the Thermal Expansion of its materials.",
                  "One change of temperature.");
  const auto body = section.section("Body Force", "Force per volume: Rate * k + Constant in increment k.");
  const auto vector = numbers("{x, y} or {x, y, z}");
  body.parameter("Rate", conditions.body_force_rate, vector,
                 "[force/volume per increment], one number per dimension; {} is zero.");
  body.parameter("Constant", conditions.body_force_constant, vector,
                 "[force/volume], one number per dimension; {} is zero.");
  const auto weight = section.section("Self-Weight",
                                      "Acceleration that each material's density turns into a force per volume: Rate * "
                                      "k + Constant in increment k.");
  weight.parameter("Rate", conditions.self_weight_rate, vector,
                   "[length/time^2 per increment], one number per dimension; {} is zero.");
  weight.parameter("Constant", conditions.self_weight_constant, vector,
                   "[length/time^2], one number per dimension, such as {0, -9810} with mm and t/mm^3; {} is zero.");
}

void check_boundary_conditions(const input::Values& section, int dimension) {
  check_displacements(section, dimension);
  for (const auto& traction : section.subs("Tractions")) check_load(traction, dimension);
  for (const char* name : {"Body Force", "Self-Weight"}) check_load(section.sub(name), dimension);
}

void complete_boundary_conditions(ParameterList& values, int dimension) {
  for (const char* name : {"Body Force", "Self-Weight"}) fill_with_zeros(values.sublist(name), dimension);
  ParameterList& tractions = values.sublist("Tractions");
  for (const auto& item : tractions) fill_with_zeros(tractions.sublist(item.first), dimension);
}

std::string shared_by(const RigidGroup& group) { return input::word_of(shared, group.shared_component); }

PrescribedComponent normalized(PrescribedComponent condition) {
  constexpr double parallel = 1e-12;
  if (condition.direction.empty()) return condition;
  double length = 0.;
  for (const double c : condition.direction) length = std::hypot(length, c);
  for (double& c : condition.direction) c /= length;
  const auto is_along = [](double cosine) { return std::abs(cosine) >= 1. - parallel; };
  const auto axis = std::find_if(condition.direction.begin(), condition.direction.end(), is_along);
  if (axis == condition.direction.end()) return condition;
  if (*axis < 0.) condition.value = -condition.value;
  condition.component = static_cast<int>(axis - condition.direction.begin());
  condition.direction.clear();
  return condition;
}

std::vector<PrescribedComponent> normalized(std::vector<PrescribedComponent> conditions) {
  for (auto& one : conditions) one = normalized(std::move(one));
  return conditions;
}

bool BoundaryConditions::are_proportional() const {
  const auto is_zero = [](double value) { return value == 0.; };
  const auto all_zero = [&](const std::vector<double>& v) { return std::all_of(v.begin(), v.end(), is_zero); };
  return std::all_of(displacements.begin(), displacements.end(),
                     [&](const auto& d) { return is_zero(d.value.constant); }) &&
         std::all_of(tractions.begin(), tractions.end(), [&](const auto& t) { return all_zero(t.constant); }) &&
         std::all_of(pressures.begin(), pressures.end(), [&](const auto& p) { return is_zero(p.constant); }) &&
         std::all_of(temperatures.begin(), temperatures.end(), [&](const auto& t) { return is_zero(t.constant); }) &&
         all_zero(body_force_constant) && all_zero(self_weight_constant);
}

}  // namespace perimorph::cases
