#include "perimorph/fracture/case.hpp"

#include <Teuchos_Array.hpp>
#include <algorithm>
#include <filesystem>

#include "case_checks.hpp"
#include "case_file.hpp"
#include "choices.hpp"
#include "group_checks.hpp"
#include "literal.hpp"
#include "perimorph/base/errors.hpp"
#include "resolve.hpp"

namespace perimorph::fracture {

namespace {

using Numbers = Teuchos::Array<double>;
using Teuchos::ParameterList;

std::vector<double> numbers(const ParameterList& list, const std::string& name) {
  return list.isParameter(name) ? list.get<Numbers>(name).toVector() : std::vector<double>();
}

double number(const ParameterList& list, const std::string& name) {
  return list.isParameter(name) ? list.get<double>(name) : 0.;
}

std::optional<double> optional_number(const ParameterList& list, const std::string& name) {
  return list.isParameter(name) ? std::optional<double>(list.get<double>(name)) : std::nullopt;
}

std::string word(const ParameterList& list, const std::string& name) { return list.get<std::string>(name); }

void fill_with_zeros(ParameterList& load, int dimension) {
  for (const char* name : {"Rate", "Constant"}) {
    if (load.get<Numbers>(name).empty()) load.set(name, Numbers(dimension, 0.));
  }
}

/// The values that stand for something exact: 0.333 for 1/3, no numbers for zeros.
void complete(ParameterList& list) {
  const int dimension = list.get<int>("Dimension");
  ParameterList& material = list.sublist("Material");
  material.set("Poisson's Ratio", poissons_ratio_of(word(material, "Elastic Model")));
  ParameterList& conditions = list.sublist("Boundary Conditions");
  fill_with_zeros(conditions.sublist("Body Force"), dimension);
  ParameterList& tractions = conditions.sublist("Tractions");
  for (const auto& item : tractions) fill_with_zeros(tractions.sublist(item.first), dimension);
}

std::string folder_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path().string() : ".";
}

void take_names(Case& result, const std::string& file, const ParameterList& list) {
  result.file = file;
  result.directory = folder_of(file);
  result.name = std::filesystem::path(file).stem();
  if (result.name.find_first_not_of('.') == std::string::npos) {  // "..", and results/.. would be the folder above
    throw base::UserError(
        fmt::format("{}: its name without .xml names the results; found \"{}\", allowed are names with "
                    "other characters than dots",
                    file, result.name));
  }
  result.title = word(list, "Title");
  result.dimension = list.get<int>("Dimension");
  result.mesh_file = std::filesystem::path(result.directory) / word(list.sublist("Mesh"), "File");
  result.mesh_scale = list.sublist("Mesh").get<double>("Scale");
}

void take_material(Case& result, const ParameterList& list) {
  const ParameterList& material = list.sublist("Material");
  result.youngs_modulus = material.get<double>("Young's Modulus");
  result.poissons_ratio = material.get<double>("Poisson's Ratio");
  result.elastic_model = value_of(elastic_models, word(material, "Elastic Model"));
  result.critical_stretch = optional_number(material, "Critical Stretch");
  result.fracture_energy = optional_number(material, "Fracture Energy");
  result.calibration = value_of(calibrations, word(material, "Calibration"));
  const ParameterList& peridynamics = list.sublist("Peridynamics");
  result.horizon = peridynamics.get<double>("Horizon");
  result.characteristic_length = peridynamics.get<double>("Characteristic Length");
  result.points_per_direction = peridynamics.get<int>("Points per Direction");
}

constexpr double default_share = 0.8;  // of automatic seeds; the schema names it

Seed seed_from(const std::string& name, const ParameterList& list) {
  Seed seed;
  seed.name = name;
  seed.shape = value_of(seed_shapes, word(list, "Shape"));
  seed.center = numbers(list, "Center");
  seed.start = numbers(list, "Start");
  seed.end = numbers(list, "End");
  seed.inner_radius = number(list, "Inner Radius");
  seed.outer_radius = number(list, "Outer Radius");
  seed.lower_corner = numbers(list, "Lower Corner");
  seed.upper_corner = numbers(list, "Upper Corner");
  seed.rim = number(list, "Rim");
  seed.share = list.isParameter("Share") ? list.get<double>("Share") : default_share;
  return seed;
}

void take_zones(Case& result, const ParameterList& list) {
  const ParameterList& morphing = list.sublist("Morphing");
  result.profile = value_of(morphing_profiles, word(morphing, "Function"));
  result.discontinuous = value_of(discontinuous_elements, word(morphing, "Discontinuous Elements"));
  result.peridynamic_stiffness = value_of(peridynamic_stiffnesses, word(morphing, "Stiffness in Peridynamic Zone"));
  result.growth_inner_radius = morphing.get<double>("Growth Inner Radius") * result.horizon;
  result.growth_outer_radius = morphing.get<double>("Growth Outer Radius") * result.horizon;
  const ParameterList& seeds = morphing.sublist("Seeds");
  for (const auto& item : seeds) result.seeds.push_back(seed_from(item.first, seeds.sublist(item.first)));
  for (Seed& seed : result.seeds) {
    if (seed.shape != SeedShape::automatic) continue;
    if (seed.inner_radius == 0.) seed.inner_radius = result.growth_inner_radius;
    if (seed.outer_radius == 0.) seed.outer_radius = 2. * seed.inner_radius;
  }
  const ParameterList& cracks = list.sublist("Pre-Cracks");
  for (const auto& item : cracks) {
    const ParameterList& one = cracks.sublist(item.first);
    result.pre_cracks.push_back({item.first, value_of(pre_crack_shapes, word(one, "Shape")), numbers(one, "Points"),
                                 numbers(one, "Center"), numbers(one, "Normal"), number(one, "Radius")});
  }
}

void take_conditions(Case& result, const ParameterList& list) {
  const ParameterList& displacements = list.sublist("Displacements");
  for (const auto& item : displacements) {
    const ParameterList& one = displacements.sublist(item.first);
    result.displacements.push_back({item.first, word(one, "Group"), value_of(components, word(one, "Component")),
                                    one.get<double>("Rate"), one.get<double>("Constant")});
  }
  const ParameterList& tractions = list.sublist("Tractions");
  for (const auto& item : tractions) {
    const ParameterList& one = tractions.sublist(item.first);
    result.tractions.push_back({item.first, word(one, "Group"), numbers(one, "Rate"), numbers(one, "Constant")});
  }
  result.body_force_rate = numbers(list.sublist("Body Force"), "Rate");
  result.body_force_constant = numbers(list.sublist("Body Force"), "Constant");
}

void take_solution(Case& result, const ParameterList& list) {
  const ParameterList& loading = list.sublist("Loading");
  result.increments = loading.get<int>("Increments");
  result.max_damage_iterations = loading.get<int>("Maximum Damage Iterations");
  result.max_zone_growths = loading.get<int>("Maximum Zone Growths");
  result.breaking_fraction = loading.get<double>("Breaking Fraction");
  const ParameterList& solver = list.sublist("Solver");
  result.preconditioner_matrix = value_of(preconditioner_matrices, word(solver, "Preconditioner Matrix"));
  result.short_range_cut_off = solver.get<double>("Short-Range Cut-Off") * result.horizon;
  result.operator_form = value_of(operator_forms, word(solver, "Operator"));
  result.tolerance = solver.get<double>("Tolerance");
  result.damage_tolerance = solver.get<double>("Damage Tolerance");
  result.max_cg_iterations = solver.get<int>("Maximum Iterations");
  result.renewal_cost = solver.get<double>("Renewal Cost");
  result.largest_imbalance = solver.get<double>("Largest Imbalance");
  result.belos = solver.sublist("Belos");
  result.muelu = solver.sublist("MueLu");
}

/// Requires the displacements to be known.
void take_output(Case& result, const ParameterList& output) {
  result.output_every = output.get<int>("Every");
  result.spread_files = output.get<bool>("Spread Files");
  result.checkpoint_every = output.get<int>("Checkpoint Every");
  result.checkpoint_minutes = output.get<double>("Checkpoint Minutes");
  result.records_crack = output.get<bool>("Crack");
  result.bond_increments = output.get<Teuchos::Array<int>>("Bonds").toVector();
  const ParameterList& probes = output.sublist("Probes");
  for (const auto& item : probes) {
    const ParameterList& probe = probes.sublist(item.first);
    result.probes.push_back({item.first, numbers(probe, "Points"), probe.get<int>("Divisions")});
  }
  result.reactions = output.get<Teuchos::Array<std::string>>("Reactions").toVector();
  if (!result.reactions.empty()) return;
  for (const auto& displacement : result.displacements) {
    const auto end = result.reactions.end();
    if (std::find(result.reactions.begin(), end, displacement.group) == end) {
      result.reactions.push_back(displacement.group);
    }
  }
}

}  // namespace

std::string listing(const ParameterList& list, const std::string& path) {
  std::string text;
  for (const auto& item : list) {
    const std::string full = path + "/" + item.first;
    text += item.second.isList() ? listing(list.sublist(item.first), full)
                                 : fmt::format("{} = {}\n", full, to_literal(item.second));
  }
  return text;
}

Case read_case(const std::string& file, const std::vector<std::string>& overrides) {
  Mistakes mistakes(file);
  Node root = read_case_file(file, mistakes);
  for (const auto& text : overrides) apply_override(root, text, mistakes);
  Resolved resolved = resolve(root, case_schema(), mistakes);
  check_case(resolved, mistakes);
  if (!mistakes.empty()) check_groups(resolved, folder_of(file), mistakes);
  mistakes.report();
  complete(resolved.list);

  Case result;
  take_names(result, file, resolved.list);
  take_material(result, resolved.list);
  take_zones(result, resolved.list);
  take_conditions(result, resolved.list.sublist("Boundary Conditions"));
  take_solution(result, resolved.list);
  take_output(result, resolved.list.sublist("Output"));
  result.resolved = resolved.list;
  result.lines = resolved.lines;
  return result;
}

}  // namespace perimorph::fracture
