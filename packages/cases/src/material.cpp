#include "perimorph/cases/material.hpp"

#include <array>
#include <cmath>

#include "choices.hpp"

namespace perimorph::cases {

namespace {

using materials::ElasticModel;
using model::Calibration;

constexpr std::array<Choice<ElasticModel>, 3> elastic_models{
    {{"Plane Stress", ElasticModel::plane_stress, 2},
     {"Plane Strain", ElasticModel::plane_strain, 2},
     {"Three-Dimensional", ElasticModel::three_dimensional, 3}}};
constexpr std::array<Choice<Calibration>, 2> calibrations{
    {{"Analytic", Calibration::analytic}, {"Mesh-Consistent", Calibration::mesh_consistent}}};

/// The one Poisson's ratio of bond-based peridynamics for an "Elastic Model": pair-wise central forces leave no other.
double poissons_ratio_of(const std::string& elastic_model) {
  return materials::bond_based_poissons_ratio(input::value_of(elastic_models, elastic_model));
}

void check_poissons_ratio(const input::Values& material) {
  const double* ratio = material.number("Poisson's Ratio");
  const std::string* model = material.text("Elastic Model");
  if (ratio == nullptr || model == nullptr) return;
  // 1e-3 relative, and a little, since 0.333 is exactly 1e-3 off 1/3.
  const double needed = poissons_ratio_of(*model);
  if (std::abs(*ratio - needed) <= 1.0001e-3 * needed) return;
  material.mistake(
      "Poisson's Ratio",
      fmt::format("found {}; allowed is {} for \"{}\": bond-based peridynamics, with central forces between "
                  "pairs of points, has this one ratio",
                  *ratio, needed == 0.25 ? "0.25 (1/4)" : "0.3333 (1/3)", *model));
}

}  // namespace

void declare(const input::Section& section, Material& material) {
  using namespace input;
  section.required("Young's Modulus", material.youngs_modulus, 30000., above(0.),
                   "E [stress]. Its unit fixes the others: with lengths in mm and E in MPa, forces are in N and the "
                   "fracture energy is in N/mm. Ten times E gives ten times the forces, and a fracture energy then "
                   "belongs to a critical stretch smaller by the root of ten.");
  section.required("Poisson's Ratio", material.poissons_ratio, 1. / 3., any_number(),
                   "nu [-]. Bond-based peridynamics, with central forces between pairs of points, has one ratio only: "
                   "1/3 in plane stress, 1/4 in plane strain and in three dimensions. A value within 0.1 % of it "
                   "(0.333) is taken as exactly that.");
  section.required_choice(
      "Elastic Model", material.elastic_model, elastic_models,
      "In two dimensions what is assumed across the thickness, which is 1 [length]: thin plates are in plane stress, "
      "long bodies in plane strain. In three dimensions nothing is: \"Three-Dimensional\".");
  section.optional(
      "Critical Stretch", material.critical_stretch, 0.05, above(0.),
      "s_crit [-]: a bond whose stretch |xi + u(p) - u(x)|/|xi| - 1 reaches it breaks for good [WHL19, eq. 6, 7]. "
      "Given the horizon and the characteristic length it follows from the fracture energy, so give one of the two; "
      "with neither, nothing breaks. Forces at failure are proportional to it. The strain at a crack's tip grows as "
      "elements get smaller, so with a fixed stretch a finer mesh breaks earlier.");
  section.optional("Fracture Energy", material.fracture_energy, 0.1, above(0.),
                   "G_c [force/length]: the energy per area of new crack. The critical stretch is derived from it, in "
                   "two dimensions by G_c = s_crit^2 times the integral of c0(r) r^6 over r from 0 to the horizon, in "
                   "three by pi/2 s_crit^2 times that of c0(r) r^7, so that it stays the same when the horizon or the "
                   "characteristic length is changed. Data sheets give toughness K_c = sqrt(G_c E) in plane stress; "
                   "K_c taken for G_c is wrong by orders of magnitude.");
  section.choice(
      "Calibration", material.calibration, calibrations,
      "How fracture energy and critical stretch belong together. \"Analytic\": by that integral. \"Mesh-Consistent\": "
      "the stretch is lowered by what the mesh itself holds a crack up, so that a crack runs at K = sqrt(G_c E) also "
      "with a characteristic length of a fifth to a half of an element; the factor depends on that length over the "
      "mean edge of the elements in the seeds, and on the two choices in Morphing. A given critical stretch stays as "
      "it is: then the fracture energy that is printed is greater. In three dimensions, where cracks are hardly held "
      "up, and with three points per direction it is as \"Analytic\".");
}

void check_material(const input::Values& section, int dimension) {
  check_choice(section, "Elastic Model", elastic_models, dimension);
  check_poissons_ratio(section);
  if (section.given("Critical Stretch") && section.given("Fracture Energy")) {
    section.mistake("Fracture Energy",
                    "found beside \"Critical Stretch\"; allowed is one of the two: each follows from the other");
  }
}

void complete_material(Teuchos::ParameterList& values) {
  values.set("Poisson's Ratio", poissons_ratio_of(values.get<std::string>("Elastic Model")));
}

}  // namespace perimorph::cases
