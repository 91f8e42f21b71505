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

/// The ratio that bonds alone have, for one within 0.1 % of it; another as it is.
double exact_ratio(ElasticModel model, double ratio) {
  // 1e-3 relative, and a little, since 0.333 is exactly 1e-3 off 1/3.
  const double of_bonds = materials::bond_based_poissons_ratio(model);
  return std::abs(ratio - of_bonds) <= 1.0001e-3 * of_bonds ? of_bonds : ratio;
}

void check_poissons_ratio(const input::Values& material) {
  constexpr double largest = 0.45;
  const double* ratio = material.number("Poisson's Ratio");
  const std::string* word = material.text("Elastic Model");
  if (ratio == nullptr || word == nullptr) return;
  const bool is_plane_stress = input::value_of(elastic_models, *word) == ElasticModel::plane_stress;
  if (*ratio > -1. && (is_plane_stress ? *ratio < 0.5 : *ratio <= largest)) return;
  material.mistake(
      "Poisson's Ratio",
      *ratio <= -1. || *ratio >= 0.5
          ? fmt::format(
                "found {}; allowed are ratios above -1 and below 0.5: beyond, a solid would not resist shear or "
                "a change of its volume",
                *ratio)
          : fmt::format("found {}; allowed are ratios up to {} for \"{}\": closer to 0.5 the volume hardly changes, "
                        "and elements and conjugate gradients lock",
                        *ratio, largest, *word));
}

}  // namespace

void declare(const input::Section& section, Material& material) {
  using namespace input;
  section.required("Young's Modulus", material.youngs_modulus, 30000., above(0.),
                   "E [stress]. Its unit fixes the others: with lengths in mm and E in MPa, forces are in N and the "
                   "fracture energy is in N/mm. Ten times E gives ten times the forces, and a fracture energy then "
                   "belongs to a critical stretch smaller by the root of ten.");
  section.required("Poisson's Ratio", material.poissons_ratio, 1. / 3., any_number(),
                   "nu [-], above -1 and below 0.5, up to 0.45 in plane strain and three dimensions. Bonds alone have "
                   "1/3 in plane stress and 1/4 otherwise: that costs least, and a value within 0.1 % of it (0.333) is "
                   "taken as exactly that. With any other one the bonds carry the shear modulus, and the dilatation of "
                   "their points what is left (state-based peridynamics): each iteration of conjugate gradients then "
                   "costs about twice as much, and the Operator cannot be \"CRS\".");
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
                   "three by pi/2 s_crit^2 times that of c0(r) r^7, and what the dilatation stores beside, so that it "
                   "stays the same when the horizon or the "
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
  const auto model = input::value_of(elastic_models, values.get<std::string>("Elastic Model"));
  values.set("Poisson's Ratio", exact_ratio(model, values.get<double>("Poisson's Ratio")));
}

bool has_dilatation(const input::Values& material) {
  const double* ratio = material.number("Poisson's Ratio");
  const std::string* word = material.text("Elastic Model");
  if (ratio == nullptr || word == nullptr) return false;
  const auto model = input::value_of(elastic_models, *word);
  return exact_ratio(model, *ratio) != materials::bond_based_poissons_ratio(model);
}

}  // namespace perimorph::cases
