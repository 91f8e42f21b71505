#include "perimorph/cases/morphing.hpp"

#include <array>

#include "choices.hpp"
#include "shapes.hpp"

namespace perimorph::cases {

namespace {

using discretization::DiscontinuousElements;
using morphing::BlendingFunction;
using operators::PeridynamicStiffness;

constexpr std::array<Choice<BlendingFunction>, 2> blending_functions{
    {{"Linear", BlendingFunction::linear}, {"Cubic", BlendingFunction::cubic}}};
constexpr std::array<Choice<DiscontinuousElements>, 3> discontinuous_elements{
    {{"On Damage", DiscontinuousElements::on_damage},
     {"Whole Zone", DiscontinuousElements::whole_zone},
     {"Never", DiscontinuousElements::never}}};
constexpr std::array<Choice<PeridynamicStiffness>, 2> peridynamic_stiffnesses{
    {{"Dropped", PeridynamicStiffness::dropped}, {"Kept", PeridynamicStiffness::kept}}};

constexpr std::array<Choice<SeedShape>, 6> seed_shapes{{{"Circle", SeedShape::ball, 2},
                                                        {"Sphere", SeedShape::ball, 3},
                                                        {"Cylinder", SeedShape::cylinder, 3},
                                                        {"Box", SeedShape::box},
                                                        {"Everything", SeedShape::everything},
                                                        {"Automatic", SeedShape::automatic}}};
constexpr std::array<ShapeParameter<SeedShape>, 13> seed_parameters{{{SeedShape::ball, "Center"},
                                                                     {SeedShape::ball, "Inner Radius"},
                                                                     {SeedShape::ball, "Outer Radius"},
                                                                     {SeedShape::cylinder, "Start"},
                                                                     {SeedShape::cylinder, "End"},
                                                                     {SeedShape::cylinder, "Inner Radius"},
                                                                     {SeedShape::cylinder, "Outer Radius"},
                                                                     {SeedShape::box, "Lower Corner"},
                                                                     {SeedShape::box, "Upper Corner"},
                                                                     {SeedShape::box, "Rim"},
                                                                     {SeedShape::automatic, "Inner Radius", false},
                                                                     {SeedShape::automatic, "Outer Radius", false},
                                                                     {SeedShape::automatic, "Share", false}}};

void declare_seed(const input::Section& section, Seed& seed) {
  using namespace input;
  const auto point = numbers("a point such as {1.5, 2}"), point_in_3d = numbers("a point such as {1.5, 2, 0}");
  section.choice("Shape", seed.shape, seed_shapes,
                 "\"Circle\" (two dimensions) and \"Sphere\" (three) take the center and the two radii, \"Cylinder\" "
                 "(three) the ends of its axis and the two radii, \"Box\" the corners and the rim, \"Everything\" "
                 "nothing. \"Automatic\" needs nothing, and takes the radii and the share: circles or spheres are put "
                 "where the elastic body is stretched most (largest principal strain at the last increment's load) "
                 "[WHL19, section 3.1]; the log says where.");
  section.optional("Center", seed.center, {0., 0.}, point, "Of a circle or sphere: x_0 [length].");
  section.optional("Start", seed.start, {0., 0., 0.}, point_in_3d,
                   "Of a cylinder: one end of its axis [length]. Radii count from the axis, so that the ends are "
                   "round, and reach a radius further.");
  section.optional("End", seed.end, {0., 0., 10.}, point_in_3d, "Of a cylinder: the other end of its axis [length].");
  section.optional("Inner Radius", seed.inner_radius, 4., above(0.),
                   "Of a circle, sphere or cylinder: r_1 [length], up to which the morphing function is 1. Bonds break "
                   "only where it is 1 all around, up to a horizon away: take at least two horizons, or hardly any "
                   "bond can break. Of an automatic seed the Growth Inner Radius if not given.");
  section.optional(
      "Outer Radius", seed.outer_radius, 6., above(0.),
      "Of a circle, sphere or cylinder: r_2 [length], from which the morphing function is 0. A ring thinner than the "
      "horizon gives spurious forces where the models meet. Of an automatic seed twice the inner radius if not given.");
  section.optional("Lower Corner", seed.lower_corner, {-4., -4.}, point,
                   "Of a box: its smallest coordinates [length].");
  section.optional("Upper Corner", seed.upper_corner, {4., 4.}, point, "Of a box: its largest coordinates [length].");
  section.optional(
      "Share", seed.share, seed.share, between(0., 1.),
      "Of an automatic seed [-]: each place that reaches this share of the largest strain, and where it is the largest "
      "up to the inner radius around, gets a circle, too. 0.8 if not given; less gives more zones, which cost bonds.");
  section.optional("Rim", seed.rim, 2., above(0.),
                   "Of a box: the width around it over which the morphing function falls from 1 to 0 [length].");
}

void check_corners(const input::Values& seed, int dimension) {
  const auto *lower = seed.numbers("Lower Corner"), *upper = seed.numbers("Upper Corner");
  if (lower == nullptr || upper == nullptr || lower->size() != dimension || upper->size() != dimension) return;
  for (int i = 0; i < dimension; ++i) {
    if ((*upper)[i] > (*lower)[i]) continue;
    seed.mistake("Upper Corner",
                 fmt::format("found {}; allowed is a corner above and to the right of \"Lower Corner\", which is {}",
                             seed.shown("Upper Corner"), seed.shown("Lower Corner")));
    return;
  }
}

void check_seed(const input::Values& seed, int dimension) {
  check_shape(seed, "a seed", seed_shapes, seed_parameters, dimension);
  const std::string* shape = seed.text("Shape");
  const bool is_automatic = shape != nullptr && input::value_of(seed_shapes, *shape) == SeedShape::automatic;
  if (is_automatic && seed.given("Outer Radius") && !seed.given("Inner Radius")) {
    seed.mistake("Inner Radius", "missing; an automatic seed with \"Outer Radius\" needs it");
  }
  input::check_order(seed, "Inner Radius", "Outer Radius");
  for (const char* name : {"Center", "Start", "End", "Lower Corner", "Upper Corner"}) check_size(seed, name, dimension);
  check_corners(seed, dimension);
  const auto *start = seed.numbers("Start"), *end = seed.numbers("End");
  if (start != nullptr && end != nullptr && *start == *end) {
    seed.mistake("End", fmt::format("found {}, which is \"Start\" too; allowed is an axis that has a length",
                                    seed.shown("End")));
  }
}

}  // namespace

void declare(const input::Section& section, Morphing& morphing, model::NumericalOptions& numerical) {
  using namespace input;
  section.choice("Function", numerical.blending_function, blending_functions,
                 "How the morphing function alpha falls from 1 to 0 across a zone's rim, with t from 0 to 1: 1 - t, or "
                 "\"Cubic\" 1 - t^2 (3 - 2 t), smooth at both ends.");
  section.choice("Discontinuous Elements", numerical.discontinuous, discontinuous_elements,
                 "Which peridynamic elements get nodes of their own: all of the zone (\"Whole Zone\", as WHL19 does), "
                 "or only those with a broken bond or beside a pre-crack (\"On Damage\": fewer unknowns, and more "
                 "accurate before fracture). \"Never\": only those that a pre-crack passes through, to compare with "
                 "codes whose elements never part: what has broken holds its neighbours together, cracks run late or "
                 "not at all, and Calibration is as \"Analytic\".");
  section.choice("Stiffness in Peridynamic Zone", numerical.peridynamic_stiffness, peridynamic_stiffnesses,
                 "What becomes of the classical stiffness E(x) [WHL19, eq. 16] where all bonds are peridynamic: "
                 "\"Dropped\", as WHL19 does, or \"Kept\" where bonds are missing at free surfaces, which are too soft "
                 "otherwise: several times more accurate where nothing breaks, but cracks then start late and jump.");
  section.parameter("Growth Inner Radius", morphing.growth_inner_radius, above(0.),
                    "r_i [horizons]: around the centroid of an element with a broken bond the zone grows to this "
                    "radius [WHL19, eq. 23]. Below 1 a crack can reach the rim of its zone, where nothing breaks.");
  section.parameter("Growth Outer Radius", morphing.growth_outer_radius, above(0.),
                    "r_o [horizons]: where the morphing function of such a new zone reaches 0. Too close to the inner "
                    "radius, and the steep rim gives spurious forces; larger costs bonds.");
  section.entries("Seeds", morphing.seeds, declare_seed,
                  "The first peridynamic zones, each a list with a name of your choice. Put one wherever a crack may "
                  "start: nothing breaks outside. Without any the body is classical throughout.",
                  "One zone. The morphing function is 1 inside and falls to 0 around it.");
}

void check_morphing(const input::Values& section, int dimension) {
  input::check_order(section, "Growth Inner Radius", "Growth Outer Radius");
  for (const auto& seed : section.subs("Seeds")) check_seed(seed, dimension);
}

}  // namespace perimorph::cases
