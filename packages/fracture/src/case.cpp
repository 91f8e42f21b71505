#include "perimorph/fracture/case.hpp"

#include <Teuchos_Array.hpp>
#include <algorithm>
#include <filesystem>

#include "case_checks.hpp"
#include "choices.hpp"
#include "mesh_checks.hpp"
#include "perimorph/base/errors.hpp"
#include "perimorph/fracture/geometry.hpp"
#include "perimorph/input/resolved.hpp"
#include "perimorph/operators/bond_selection.hpp"
#include "temporary_folder.hpp"

namespace perimorph::fracture {

namespace {

using input::Mistakes;
using input::Resolved;
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
  result.name = std::filesystem::path(file).stem();
  if (result.name.find_first_not_of('.') == std::string::npos) {  // "..", and results/.. would be the folder above
    throw base::UserError(
        fmt::format("{}: its name without .xml names the results; found \"{}\", allowed are names with "
                    "other characters than dots",
                    file, result.name));
  }
  result.title = word(list, "Title");
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

PreCrack pre_crack_from(const std::string& name, const ParameterList& list) {
  return {name,
          value_of(pre_crack_shapes, word(list, "Shape")),
          numbers(list, "Points"),
          numbers(list, "Center"),
          numbers(list, "Normal"),
          number(list, "Radius")};
}

PrescribedDisplacement displacement_from(const std::string& name, const ParameterList& list) {
  return {name, word(list, "Group"), value_of(components, word(list, "Component")), list.get<double>("Rate"),
          list.get<double>("Constant")};
}

Probe probe_from(const std::string& name, const ParameterList& list) {
  return {name, numbers(list, "Points"), list.get<int>("Divisions")};
}

/// The entries of a section in which there are no mistakes.
template <class Entry>
std::vector<Entry> sound_entries(const ParameterList& section, const std::string& path, const Mistakes& mistakes,
                                 Entry (*from)(const std::string&, const ParameterList&)) {
  std::vector<Entry> entries;
  for (const auto& item : section) {
    if (mistakes.none_in(path + "/" + item.first)) entries.push_back(from(item.first, section.sublist(item.first)));
  }
  return entries;
}

/// What is held against the mesh; of a case with mistakes, the part that has none.
Case sound_part(const std::string& file, const Resolved& resolved, const Mistakes& mistakes) {
  Case part{};
  part.file = file;
  part.directory = folder_of(file);
  part.resolved = resolved.list;
  part.lines = resolved.lines;
  const ParameterList& list = part.resolved;
  if (list.isParameter("Dimension")) part.dimension = list.get<int>("Dimension");
  const ParameterList& mesh = list.sublist("Mesh");
  if (mesh.isParameter("File")) part.mesh_file = std::filesystem::path(part.directory) / word(mesh, "File");
  part.mesh_scale = optional_number(mesh, "Scale").value_or(1.);
  part.horizon = number(list.sublist("Peridynamics"), "Horizon");
  part.seeds = sound_entries(list.sublist("Morphing").sublist("Seeds"), "/Morphing/Seeds", mistakes, seed_from);
  part.pre_cracks = sound_entries(list.sublist("Pre-Cracks"), "/Pre-Cracks", mistakes, pre_crack_from);
  part.displacements = sound_entries(list.sublist("Boundary Conditions").sublist("Displacements"),
                                     "/Boundary Conditions/Displacements", mistakes, displacement_from);
  part.probes = sound_entries(list.sublist("Output").sublist("Probes"), "/Output/Probes", mistakes, probe_from);
  return part;
}

/// Of a case with mistakes: that its mesh cannot be read, or what of the sound part does not fit it.
template <int dim>
void check_against_mesh_of(const Case& part, Mistakes& mistakes) {
  const TemporaryFolder folder;
  mesh::Mesh<dim> whole;
  try {
    whole = read_opened_mesh<dim>(part, folder.path());
  } catch (const base::UserError& error) {
    mistakes.add(input::line_of(part.lines, "/Mesh/File"), "/Mesh/File", error.what());
    return;
  }
  check_against_mesh(part, whole, mistakes);
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
  result.characteristic_length = peridynamics.get<double>("Characteristic Length");
  result.points_per_direction = peridynamics.get<int>("Points per Direction");
}

void take_zones(Case& result, const ParameterList& list) {
  const ParameterList& morphing = list.sublist("Morphing");
  result.blending_function = value_of(blending_functions, word(morphing, "Function"));
  result.discontinuous = value_of(discontinuous_elements, word(morphing, "Discontinuous Elements"));
  result.peridynamic_stiffness = value_of(peridynamic_stiffnesses, word(morphing, "Stiffness in Peridynamic Zone"));
  result.growth_inner_radius = morphing.get<double>("Growth Inner Radius") * result.horizon;
  result.growth_outer_radius = morphing.get<double>("Growth Outer Radius") * result.horizon;
  for (Seed& seed : result.seeds) {
    if (seed.shape != SeedShape::automatic) continue;
    if (seed.inner_radius == 0.) seed.inner_radius = result.growth_inner_radius;
    if (seed.outer_radius == 0.) seed.outer_radius = 2. * seed.inner_radius;
  }
}

void take_forces(Case& result, const ParameterList& list) {
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
  result.short_range_cut_off =
      result.horizon *
      optional_number(solver, "Short-Range Cut-Off").value_or(operators::default_short_range_cut_off(result.dimension));
  result.operator_form = value_of(operator_forms, word(solver, "Operator"));
  result.tolerance = solver.get<double>("Tolerance");
  result.damage_tolerance = solver.get<double>("Damage Tolerance");
  result.max_cg_iterations = solver.get<int>("Maximum Iterations");
  result.renewal_cost = solver.get<double>("Renewal Cost");
  result.largest_imbalance = solver.get<double>("Largest Imbalance");
  result.belos = solver.sublist("Belos");
  result.muelu = solver.sublist("MueLu");
}

void take_output(Case& result, const ParameterList& output) {
  result.output_every = output.get<int>("Every");
  result.spread_files = output.get<bool>("Spread Files");
  result.checkpoint_every = output.get<int>("Checkpoint Every");
  result.checkpoint_minutes = output.get<double>("Checkpoint Minutes");
  result.records_crack = output.get<bool>("Crack");
  result.bond_increments = output.get<Teuchos::Array<int>>("Bonds").toVector();
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

Case read_case(const std::string& file, const std::vector<std::string>& overrides) {
  Mistakes mistakes(file);
  Resolved resolved = input::read(file, overrides, case_schema(), mistakes);
  check_case(resolved, mistakes);
  Case result = sound_part(file, resolved, mistakes);
  if (!mistakes.empty() && !result.mesh_file.empty() && result.dimension != 0) {
    (result.dimension == 2 ? check_against_mesh_of<2> : check_against_mesh_of<3>)(result, mistakes);
  }
  mistakes.report();

  complete(resolved.list);
  take_names(result, file, resolved.list);
  take_material(result, resolved.list);
  take_zones(result, resolved.list);
  take_forces(result, resolved.list.sublist("Boundary Conditions"));
  take_solution(result, resolved.list);
  take_output(result, resolved.list.sublist("Output"));
  result.resolved = resolved.list;
  return result;
}

}  // namespace perimorph::fracture
