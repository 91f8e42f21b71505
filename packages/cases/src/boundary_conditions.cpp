#include "perimorph/cases/boundary_conditions.hpp"

#include <array>
#include <map>

#include "choices.hpp"
#include "shapes.hpp"

namespace perimorph::cases {

namespace {

using discretization::PrescribedComponent;
using Teuchos::ParameterList;

constexpr std::array<Choice<int>, 3> components{{{"x", 0}, {"y", 1}, {"z", 2, 3}}};
constexpr const char* load_names[] = {"Rate", "Constant"};

void declare_displacement(const input::Section& section, PrescribedComponent& one) {
  using namespace input;
  section.required("Group", one.node_set, "left", text("the name of a group"), "A physical group of the mesh.");
  section.required_choice("Component", one.component, components,
                          "The direction held or moved; the others stay free. z in three dimensions only.");
  section.parameter("Rate", one.value.rate, any_number(),
                    "[length per increment]: what loads the body; 0 holds it. Its sign is that of the axis.");
  section.parameter("Constant", one.value.constant, any_number(), "[length], there from the first increment on.");
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

void check_displacements(const input::Values& conditions, int dimension) {
  std::map<std::pair<std::string, std::string>, std::string> seen;
  for (const auto& one : conditions.subs("Displacements")) {
    const std::string *group = one.text("Group"), *component = one.text("Component");
    check_choice(one, "Component", components, dimension);
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
                  "Prescribed displacements, each a list with a name of your choice: one component of one group. In "
                  "increment k it is Rate * k + Constant.",
                  "One component of one group.");
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
