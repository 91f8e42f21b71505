#include "perimorph/cases/case.hpp"

#include <algorithm>
#include <filesystem>

#include "mesh_checks.hpp"
#include "perimorph/base/errors.hpp"
#include "perimorph/base/temporary_folder.hpp"
#include "perimorph/cases/geometry.hpp"
#include "perimorph/input/resolved.hpp"
#include "perimorph/input/section.hpp"
#include "perimorph/input/values.hpp"
#include "perimorph/operators/bond_selection.hpp"

namespace perimorph::cases {

namespace {

using input::Mistakes;
using input::Resolved;
using input::Section;

/// Every section, in the order of the reference.
void declare_case(const Section& root, Case& input) {
  root.changeable().parameter("Title", input.title, input::any_text(), "A line about the case, for people.");
  root.parameter("Dimension", input.dimension, input::either(2, 3),
                 "Dimensions of space. It decides how many numbers a point has, which elements the mesh needs, and "
                 "which elastic models and shapes of seeds and pre-cracks are allowed.");
  declare(root.section("Mesh", "Where the body comes from."), input.mesh, input.numerical);
  declare(root.section("Material",
                       "The homogeneous, isotropic, linearly elastic, brittle material of the body; with Materials, of "
                       "all blocks that none of these fills."),
          input.material);
  root.entries("Materials", input.materials, declare,
               "Further materials, each a list with a name of your choice. Elastic Model and Calibration are those of "
               "Material. Without a fracture energy or a critical stretch it never breaks (steel platens).",
               "One material, and the blocks of the mesh that it fills.");
  root.entries("Interfaces", input.interfaces, declare,
               "How tough it is where two materials meet, each a list with a name of your choice. Between others the "
               "fracture energy is that of the less tough one: a perfect bond.",
               "The interface between two materials.");
  declare(root.section("Peridynamics", "The nonlocal model inside the peridynamic zone."), input.peridynamics,
          input.numerical);
  declare(root.section("Morphing", "Where the body is peridynamic, and how that zone grows."), input.morphing,
          input.numerical);
  root.entries("Pre-Cracks", input.pre_cracks, declare,
               "Cracks without width that are there from the start, each a list with a name of your choice. No bond "
               "crosses one, and elements part along it.",
               "One crack.");
  declare(root.section("Boundary Conditions", "What holds the body and what loads it."), input.boundary_conditions);
  declare(root.section("Loading", "How far to go, and when to give up."), input.loading, input.numerical);
  declare(root.section("Solver", "Conjugate gradients with an algebraic multigrid preconditioner."), input.solver,
          input.numerical);
  declare(root.section("Output", "What is written, into the folder given by --output."), input.output);
}

/// What several parameters must agree on. Checks that lack a value they need say nothing: that mistake is already
/// listed.
void check(const Resolved& resolved, const std::string& folder, Mistakes& mistakes) {
  const input::Values root(resolved, mistakes);
  const int* dimension = root.count("Dimension");
  if (dimension == nullptr) return;  // what is wrong depends on it
  check_mesh_source(root.sub("Mesh"), *dimension);
  check_materials(root, *dimension);
  check_peridynamics(root);
  check_morphing(root.sub("Morphing"), *dimension);
  for (const auto& crack : root.subs("Pre-Cracks")) check_pre_crack(crack, *dimension);
  check_boundary_conditions(root.sub("Boundary Conditions"), *dimension);
  check_temperatures(root, *dimension);
  check_solver(root.sub("Solver"), has_dilatation(root), softens(root),
               !root.sub("Boundary Conditions").subs("Rigid Groups").empty());
  check_loading(root.sub("Loading"), *dimension, softens(root), breaks(root));
  check_steps(root, folder);
  check_output(root.sub("Output"), *dimension);
}

/// The values that stand for something exact: 0.333 for 1/3, no numbers for zeros.
void complete(Teuchos::ParameterList& values) {
  complete_materials(values);
  complete_boundary_conditions(values.sublist("Boundary Conditions"), values.get<int>("Dimension"));
}

std::string folder_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path().string() : ".";
}

/// The case as its file has it; of one with mistakes, what is right.
Case take(const std::string& file, const Resolved& resolved, const Mistakes& mistakes) {
  Case input;
  declare_case(Section::of_values(resolved.list, mistakes), input);
  input.file = file;
  input.directory = folder_of(file);
  if (!input.mesh.file.empty()) input.mesh.file = std::filesystem::path(input.directory) / input.mesh.file;
  input.resolved = resolved.list;
  input.lines = resolved.lines;
  return input;
}

/// Of a case with mistakes: that its mesh cannot be read, or what of the rest does not fit it.
template <int dim>
void check_mesh_of(const Case& input, Mistakes& mistakes) {
  const base::TemporaryFolder folder;
  mesh::Mesh<dim> whole;
  try {
    whole = read_closed_mesh<dim>(input, folder.path());
  } catch (const base::UserError& error) {
    mistakes.add(input::line_of(input.lines, "/Mesh/File"), "/Mesh/File", error.what());
    return;
  }
  open_and_check(input, whole, mistakes);
}

void name_results(Case& input) {
  input.name = std::filesystem::path(input.file).stem();
  if (input.name.find_first_not_of('.') != std::string::npos) return;
  // "..", and results/.. would be the folder above
  throw base::UserError(
      fmt::format("{}: its name without .xml names the results; found \"{}\", allowed are names with "
                  "other characters than dots",
                  input.file, input.name));
}

/// Lengths that are given in horizons, or follow from others.
void complete_lengths(Case& input) {
  const double horizon = input.peridynamics.horizon;
  model::NumericalOptions& numerical = input.numerical;
  numerical.growth_inner_radius = input.morphing.growth_inner_radius * horizon;
  numerical.growth_outer_radius = input.morphing.growth_outer_radius * horizon;
  numerical.short_range_cut_off =
      horizon * input.solver.short_range_cut_off.value_or(operators::default_short_range_cut_off(input.dimension));
  if (input.solver.windows) {
    numerical.window.radius = horizon * input.solver.window_radius.value_or(default_window_radius(input.dimension));
  }
  for (Seed& seed : input.morphing.seeds) {
    if (seed.shape != SeedShape::automatic) continue;
    if (seed.inner_radius == 0.) seed.inner_radius = numerical.growth_inner_radius;
    if (seed.outer_radius == 0.) seed.outer_radius = 2. * seed.inner_radius;
  }
}

/// By default those of all groups with prescribed displacements, and that move as one.
void complete_reactions(Case& input) {
  auto& reactions = input.output.reactions;
  if (!reactions.empty()) return;
  const auto add = [&](const auto& conditions) {
    for (const auto& one : conditions) {
      if (std::find(reactions.begin(), reactions.end(), one.node_set) == reactions.end()) {
        reactions.push_back(one.node_set);
      }
    }
  };
  add(input.boundary_conditions.displacements);
  add(input.boundary_conditions.rigid_groups);
}

}  // namespace

std::vector<Solid> solids_of(const Case& input) {
  std::vector<Solid> all = {input.material};
  all.insert(all.end(), input.materials.begin(), input.materials.end());
  return all;
}

bool can_break(const Case& input) {
  const auto solids = solids_of(input);
  return std::any_of(solids.begin(), solids.end(), [](const Solid& solid) { return solid.breaks(); });
}

Teuchos::ParameterList case_schema() {
  Teuchos::ParameterList schema("perimorph");
  Case defaults;
  declare_case(Section::of_schema(schema), defaults);
  return schema;
}

Case read_case(const std::string& file, const std::vector<std::string>& overrides,
               mesh_files::SideEffects side_effects) {
  Mistakes mistakes(file);
  Resolved resolved = input::read(file, overrides, case_schema(), mistakes);
  check(resolved, folder_of(file), mistakes);
  if (!mistakes.empty()) {
    Case input = take(file, resolved, mistakes);
    input.mesh.meshing.side_effects = side_effects;
    if (!input.mesh.file.empty() && resolved.list.isParameter("Dimension")) {
      (input.dimension == 2 ? check_mesh_of<2> : check_mesh_of<3>)(input, mistakes);
    }
    mistakes.report();
  }
  complete(resolved.list);
  Case input = take(file, resolved, mistakes);
  input.mesh.meshing.side_effects = side_effects;
  name_results(input);
  read_tables(input.directory, input.loading.steps);
  complete_lengths(input);
  complete_reactions(input);
  input.numerical.damage_tolerance = std::max(input.numerical.damage_tolerance, input.numerical.tolerance);
  return input;
}

std::string deciding_lines(const Case& input) {
  return input::deciding_listing(input.resolved, case_schema()) + listing_of_tables(input.loading.steps);
}

}  // namespace perimorph::cases
