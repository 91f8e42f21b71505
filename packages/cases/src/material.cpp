#include "perimorph/cases/material.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "choices.hpp"
#include "perimorph/cases/peridynamics.hpp"

namespace perimorph::cases {

namespace {

using materials::ElasticModel;
using materials::Softening;
using model::Calibration;

constexpr std::array<Choice<ElasticModel>, 3> elastic_models{
    {{"Plane Stress", ElasticModel::plane_stress, 2},
     {"Plane Strain", ElasticModel::plane_strain, 2},
     {"Three-Dimensional", ElasticModel::three_dimensional, 3}}};
constexpr std::array<Choice<Calibration>, 2> calibrations{
    {{"Analytic", Calibration::analytic}, {"Mesh-Consistent", Calibration::mesh_consistent}}};
constexpr std::array<Choice<Softening>, 3> bond_laws{
    {{"Brittle", Softening::none}, {"Bilinear", Softening::bilinear}, {"Exponential", Softening::exponential}}};

/// The ratio that bonds alone have, for one within 0.1 % of it; another as it is.
double exact_ratio(ElasticModel model, double ratio) {
  // 1e-3 relative, and a little, since 0.333 is exactly 1e-3 off 1/3.
  const double of_bonds = materials::bond_based_poissons_ratio(model);
  return std::abs(ratio - of_bonds) <= 1.0001e-3 * of_bonds ? of_bonds : ratio;
}

std::optional<ElasticModel> elastic_model_of(const input::Values& root) {
  const std::string* word = root.sub("Material").text("Elastic Model");
  if (word == nullptr) return std::nullopt;
  return input::value_of(elastic_models, *word);
}

/// Of all materials.
std::vector<input::Values> solids(const input::Values& root) {
  std::vector<input::Values> all = {root.sub("Material")};
  for (const auto& other : root.subs("Materials")) all.push_back(other);
  return all;
}

void check_poissons_ratio(const input::Values& solid, ElasticModel model) {
  constexpr double largest = 0.45;
  const double* ratio = solid.number("Poisson's Ratio");
  if (ratio == nullptr) return;
  if (*ratio <= -1. || *ratio >= 0.5) {
    solid.mistake("Poisson's Ratio",
                  fmt::format("found {}; allowed are ratios above -1 and below 0.5: beyond, a solid would not resist "
                              "shear or a change of its volume",
                              *ratio));
  } else if (model != ElasticModel::plane_stress && *ratio > largest) {
    solid.mistake("Poisson's Ratio",
                  fmt::format("found {}; allowed are ratios up to {} for \"{}\": closer to 0.5 the volume hardly "
                              "changes, and elements and conjugate gradients lock",
                              *ratio, largest, input::word_of(elastic_models, model)));
  }
}

bool is_soft(const input::Values& section) {
  const std::string* word = section.text("Bond Law");
  return word != nullptr && input::value_of(bond_laws, *word) != Softening::none;
}

void check_softening(const input::Values& section) {
  for (const char* needed : {"Tensile Strength", "Fracture Energy"}) {
    if (section.given(needed)) continue;
    section.mistake(needed,
                    fmt::format("missing; \"Bond Law\" = {} needs it: bonds soften from the one, and how slowly "
                                "follows from the other",
                                input::in_quotes(*section.text("Bond Law"))));
  }
  if (!section.given("Critical Stretch")) return;
  section.mistake("Critical Stretch", fmt::format("found beside \"Bond Law\" = {}; allowed is it with \"Brittle\": of "
                                                  "softening bonds it follows from strength and energy",
                                                  input::in_quotes(*section.text("Bond Law"))));
}

void check_fracture(const input::Values& section) {
  if (is_soft(section)) return check_softening(section);
  if (section.given("Tensile Strength")) {
    section.mistake(
        "Tensile Strength",
        "found with \"Bond Law\" = \"Brittle\"; allowed is it with \"Bilinear\" or \"Exponential\": brittle "
        "bonds have a fracture energy alone");
  }
  if (!section.given("Critical Stretch") || !section.given("Fracture Energy")) return;
  section.mistake("Fracture Energy",
                  "found beside \"Critical Stretch\"; allowed is one of the two: each follows from the other");
}

/// Only where bonds break at once, and compression stretches them.
void check_compression(const input::Values& solid) {
  const double *strength = solid.number("Compressive Strength"), *ratio = solid.number("Poisson's Ratio");
  if (strength == nullptr) return;
  const auto refuse = [&](const std::string& why) {
    solid.mistake("Compressive Strength", fmt::format("found {:.6g}; allowed is none {}", *strength, why));
  };
  if (is_soft(solid)) {
    refuse(fmt::format("with \"Bond Law\" = {}: what a bond dissipates as it softens follows from its stretch alone",
                       input::in_quotes(*solid.text("Bond Law"))));
  } else if (!solid.given("Critical Stretch") && !solid.given("Fracture Energy")) {
    refuse("without \"Critical Stretch\" or \"Fracture Energy\": nothing breaks");
  } else if (ratio != nullptr && *ratio <= 0.) {
    refuse(fmt::format("with \"Poisson's Ratio\" = {:.6g}: compression stretches nothing across it, and breaks no bond",
                       *ratio));
  }
}

void check_length(const input::Values& solid, const input::Values& peridynamics) {
  const double *length = solid.number("Characteristic Length"), *horizon = peridynamics.number("Horizon");
  if (length == nullptr || horizon == nullptr || (*length < *horizon && *horizon <= longest_horizon * *length)) return;
  solid.mistake(
      "Characteristic Length",
      fmt::format("found {:.6g}; allowed is below the horizon, which is {:.6g}, and from its {:.0f}th part on", *length,
                  *horizon, longest_horizon));
}

/// Each block has one material.
void check_blocks(const std::vector<input::Values>& materials) {
  std::map<std::string, std::string> filled;
  for (const auto& material : materials) {
    const auto* blocks = material.texts("Blocks");
    if (blocks == nullptr) continue;
    if (blocks->empty()) material.mistake("Blocks", "found none; allowed are the names of one block or more");
    for (const auto& block : *blocks) {
      const auto [first, is_new] = filled.emplace(block, material.path());
      if (is_new) continue;
      material.mistake("Blocks",
                       fmt::format("found {}, which {} fills already", input::in_quotes(block), first->second));
    }
  }
}

std::string last_part(const std::string& path) { return path.substr(path.rfind('/') + 1); }

std::set<std::string> names_of_materials(const input::Values& root) {
  std::set<std::string> names;
  if (const auto* name = root.sub("Material").text("Name")) names.insert(*name);
  for (const auto& material : root.subs("Materials")) {
    if (names.insert(last_part(material.path())).second) continue;
    root.sub("Material")
        .mistake("Name", fmt::format("found {}, which is the name of {} too",
                                     input::in_quotes(last_part(material.path())), material.path()));
  }
  return names;
}

void check_interface(const input::Values& interface, const std::set<std::string>& known,
                     std::map<std::set<std::string>, std::string>& seen) {
  check_fracture(interface);
  if (!is_soft(interface) && !interface.given("Critical Stretch") && !interface.given("Fracture Energy")) {
    interface.mistake("Fracture Energy", "missing, and so is \"Critical Stretch\"; allowed is one of the two");
  }
  const auto* names = interface.texts("Materials");
  if (names == nullptr) return;
  const std::set<std::string> pair(names->begin(), names->end());
  if (names->size() != 2 || pair.size() != 2) {
    interface.mistake("Materials", fmt::format("found {}; allowed are the names of two different materials",
                                               interface.shown("Materials")));
    return;
  }
  for (const auto& name : pair) {
    if (known.count(name) != 0) continue;
    interface.mistake("Materials",
                      fmt::format("found {}; the materials are {}", input::in_quotes(name),
                                  base::quoted_list(std::vector<std::string>(known.begin(), known.end()))));
    return;
  }
  const auto [first, is_new] = seen.emplace(pair, interface.path());
  if (!is_new) interface.mistake("Materials", fmt::format("found a pair that {} has already", first->second));
}

bool is_weighed(const input::Values& self_weight) {
  const auto is_some = [&](const char* name) {
    const auto* values = self_weight.numbers(name);
    return values != nullptr && std::any_of(values->begin(), values->end(), [](double value) { return value != 0.; });
  };
  return is_some("Rate") || is_some("Constant");
}

/// Weight needs a density of every material.
void check_density(const input::Values& solid, const input::Values& self_weight) {
  const double* density = solid.number("Density");
  if (density == nullptr || *density > 0. || !is_weighed(self_weight)) return;
  solid.mistake("Density", "found 0; /Boundary Conditions/Self-Weight needs a density above 0 of every material");
}

void declare_stiffness(const input::Section& section, Solid& solid) {
  using namespace input;
  section.required("Young's Modulus", solid.youngs_modulus, 30000., above(0.),
                   "E [stress]. Its unit fixes the others: with lengths in mm and E in MPa, forces are in N and the "
                   "fracture energy is in N/mm. Ten times E gives ten times the forces, and a fracture energy then "
                   "belongs to a critical stretch smaller by the root of ten.");
  section.required("Poisson's Ratio", solid.poissons_ratio, 1. / 3., any_number(),
                   "nu [-], above -1 and below 0.5, up to 0.45 in plane strain and three dimensions. Bonds alone have "
                   "1/3 in plane stress and 1/4 otherwise: that costs least, and a value within 0.1 % of it (0.333) is "
                   "taken as exactly that. With any other one the bonds carry the shear modulus, and the dilatation of "
                   "their points what is left (state-based peridynamics): each iteration of conjugate gradients then "
                   "costs about twice as much, and the Operator cannot be \"CRS\".");
}

void declare_fracture(const input::Section& section, Fracture& fracture) {
  using namespace input;
  section.choice(
      "Bond Law", fracture.bond_law, bond_laws,
      "How bonds fail: \"Brittle\" ones at once, as those of glass, ceramics and acrylic [WHL19]. Bonds of "
      "concrete, mortar and rock soften: \"Bilinear\" (Petersson's curve with a kink at a third) or "
      "\"Exponential\", from the tensile strength and the fracture energy. The characteristic length is then "
      "one of the material, like the size of its grains, and stays as it is on other meshes.");
  section.optional("Tensile Strength", fracture.tensile_strength, 3., above(0.),
                   "f_t [stress] of bonds that soften: the largest stress that a bar bears under tension. Not for "
                   "\"Brittle\", where it follows from the fracture energy and the size of the flaws.");
  section.optional(
      "Critical Stretch", fracture.critical_stretch, 0.05, above(0.),
      "s_crit [-]: a bond whose stretch |xi + u(p) - u(x)|/|xi| - 1 reaches it breaks for good [WHL19, eq. 6, 7]. "
      "Given the horizon and the characteristic length it follows from the fracture energy, so give one of the two; "
      "with neither, nothing breaks. Forces at failure are proportional to it. The strain at a crack's tip grows as "
      "elements get smaller, so with a fixed stretch a finer mesh breaks earlier.");
  section.optional(
      "Fracture Energy", fracture.fracture_energy, 0.1, above(0.),
      "G_c [force/length]: the energy per area of new crack. The critical stretch is derived from it, in "
      "two dimensions by G_c = s_crit^2 times the integral of c0(r) r^6 over r from 0 to the horizon, in "
      "three by pi/2 s_crit^2 times that of c0(r) r^7, and what the dilatation stores beside, so that it "
      "stays the same when the horizon or the "
      "characteristic length is changed. Data sheets give toughness K_c = sqrt(G_c E) in plane stress; "
      "K_c taken for G_c is wrong by orders of magnitude. Of bonds that soften: G_f (G_F in codes), the work of "
      "fracture per area, such as 0.05 to 0.15 N/mm for concrete.");
}

void declare_compression(const input::Section& section, Solid& solid) {
  section.optional(
      "Compressive Strength", solid.compressive_strength, 40., input::above(0.),
      "f_c [stress] of brittle bonds: the uniaxial compression that a solid without cracks bears, above E s_crit / nu. "
      "If it is not given bonds break by their stretch alone; then it is that, three or four times the tensile "
      "strength "
      "E s_crit (`perimorph check` prints it), since compression stretches bonds across it by nu times its strain. "
      "Rock and "
      "concrete bear ten times as much. Of the stretch by compression across a bond then only a share counts, so that "
      "stresses sigma along it and -p across break it at sigma / f_t + p / f_c = 1 (Mohr-Coulomb's line between both "
      "strengths).");
}

void declare_density(const input::Section& section, Solid& solid) {
  section.parameter("Density", solid.density, input::at_least(0.),
                    "[mass/volume], for Boundary Conditions/Self-Weight: with mm, N and MPa in t/mm^3, 2.4e-9 for "
                    "concrete and 7.85e-9 for steel.");
}

void declare_expansion(const input::Section& section, Solid& solid) {
  section.parameter(
      "Thermal Expansion", solid.thermal_expansion, input::any_number(),
      "alpha_T [1/temperature], for Boundary Conditions/Temperatures: the strain that a degree makes where "
      "nothing is held, such as 1e-5/K for concrete and 1.2e-5/K for steel. With a change of moisture in "
      "place of temperature, the shrinkage of drying. Bonds break by what they are stretched beyond it.");
}

}  // namespace

void declare(const input::Section& section, Material& material) {
  using namespace input;
  declare_stiffness(section, material);
  section.required_choice("Elastic Model", material.elastic_model, elastic_models,
                          "In two dimensions what is assumed across the thickness: thin plates are in plane stress, "
                          "long bodies in plane strain. In three dimensions nothing is: \"Three-Dimensional\".");
  declare_fracture(section, material);
  declare_compression(section, material);
  section.choice(
      "Calibration", material.calibration, calibrations,
      "How fracture energy and critical stretch belong together. \"Analytic\": by that integral. \"Mesh-Consistent\": "
      "the stretch is lowered by what the mesh itself holds a crack up, so that a crack runs at K = sqrt(G_c E) also "
      "with a characteristic length of a fifth to a half of an element; the factor depends on that length over the "
      "mean edge of the elements in the seeds, and on the two choices in Morphing. A given critical stretch stays as "
      "it is: then the fracture energy that is printed is greater. In three dimensions, where cracks are hardly held "
      "up, and with three points per direction it is as \"Analytic\".");
  declare_density(section, material);
  declare_expansion(section, material);
  section.changeable().parameter("Name", material.name, text("a name"),
                                 "How Interfaces and results call the material.");
}

void declare(const input::Section& section, Solid& solid) {
  using namespace input;
  section.required("Blocks", solid.blocks, {"particle"}, names("a list of blocks such as {particle}"),
                   "The blocks of the mesh that it fills: physical groups of elements.");
  declare_stiffness(section, solid);
  declare_fracture(section, solid);
  declare_compression(section, solid);
  section.optional("Characteristic Length", solid.characteristic_length, 0.1, above(0.),
                   "l [length] of its own in the micromodulus; that of Peridynamics if not given.");
  declare_density(section, solid);
  declare_expansion(section, solid);
}

void declare(const input::Section& section, Interface& interface) {
  using namespace input;
  section.required("Materials", interface.materials, {"body", "particle"}, names("two names such as {body, particle}"),
                   "The two materials between which it is: names in Materials, or the Name in Material.");
  declare_fracture(section, interface);
}

void check_materials(const input::Values& root, int dimension) {
  check_choice(root.sub("Material"), "Elastic Model", elastic_models, dimension);
  const auto model = elastic_model_of(root);
  const auto self_weight = root.sub("Boundary Conditions").sub("Self-Weight");
  for (const auto& solid : solids(root)) {
    if (model) check_poissons_ratio(solid, *model);
    check_fracture(solid);
    check_compression(solid);
    check_length(solid, root.sub("Peridynamics"));
    check_density(solid, self_weight);
  }
  check_blocks(root.subs("Materials"));
  const auto names = names_of_materials(root);
  std::map<std::set<std::string>, std::string> seen;
  for (const auto& interface : root.subs("Interfaces")) check_interface(interface, names, seen);
}

void complete_materials(Teuchos::ParameterList& root) {
  auto& main = root.sublist("Material");
  const auto model = input::value_of(elastic_models, main.get<std::string>("Elastic Model"));
  const auto complete = [&](Teuchos::ParameterList& solid) {
    solid.set("Poisson's Ratio", exact_ratio(model, solid.get<double>("Poisson's Ratio")));
  };
  complete(main);
  auto& others = root.sublist("Materials");
  for (const auto& item : others) complete(others.sublist(item.first));
}

bool softens(const input::Values& root) {
  const auto all = solids(root), between = root.subs("Interfaces");
  return std::any_of(all.begin(), all.end(), is_soft) || std::any_of(between.begin(), between.end(), is_soft);
}

bool breaks(const input::Values& root) {
  const auto can_break = [](const auto& one) { return one.given("Critical Stretch") || one.given("Fracture Energy"); };
  const auto all = solids(root), between = root.subs("Interfaces");
  return std::any_of(all.begin(), all.end(), can_break) || std::any_of(between.begin(), between.end(), can_break);
}

bool has_dilatation(const input::Values& root) {
  const auto model = elastic_model_of(root);
  if (!model) return false;
  const auto all = solids(root);
  return std::any_of(all.begin(), all.end(), [&](const auto& solid) {
    const double* ratio = solid.number("Poisson's Ratio");
    return ratio != nullptr && exact_ratio(*model, *ratio) != materials::bond_based_poissons_ratio(*model);
  });
}

}  // namespace perimorph::cases
