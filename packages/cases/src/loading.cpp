#include "perimorph/cases/loading.hpp"

#include <array>

#include "choices.hpp"

namespace perimorph::cases {

namespace {

constexpr std::array<Choice<Control>, 2> controls{{{"Load", Control::load}, {"Measure", Control::measure}}};

void check_softening(const input::Values& section, bool softens) {
  const double* fraction = section.number("Breaking Fraction");
  if (softens && fraction != nullptr && *fraction < 1.) {
    section.mistake("Breaking Fraction",
                    fmt::format("found {}; with bonds that soften allowed is 1: at the critical stretch they hold "
                                "nothing any more, and breaking some of them first would have no effect",
                                *fraction));
  }
  const double* tolerance = section.number("Softening Tolerance");
  if (softens || tolerance == nullptr || *tolerance == model::NumericalOptions().softening_tolerance) return;
  section.mistake("Softening Tolerance",
                  fmt::format("found {}, but no bonds soften; allowed is it with a \"Bond Law\" other than \"Brittle\"",
                              *tolerance));
}

}  // namespace

void declare(const input::Section& section, Loading& loading, model::NumericalOptions& numerical) {
  using namespace input;
  const Section changeable = section.changeable();
  changeable.required(
      "Increments", loading.increments, 100, count(),
      "Load steps k = 1, 2, ... up to this one. Before the first break they cost next to nothing. With few large ones "
      "the first break is known only to within a large step, and a crack that would grow slowly jumps.");
  section.entries(
      "Steps", loading.steps, declare,
      "Stages of the load, each a list with a name of your choice, in their order: the own weight first, then the "
      "load; pull, unload, pull again. Without steps all loads grow with the increment's number k; with "
      "them the value of a condition is Rate * a + Constant, a by the steps.",
      "One stage.");
  section.choice("Control", loading.control, controls,
                 "What increments prescribe. With Load the load factor, which is the increment's number k. With "
                 "Measure a displacement that grows with the crack, such as the opening of its mouth: the load "
                 "factor follows, up and down, so that a load past its peak and a snap-back are followed instead of "
                 "jumped over.");
  declare(section.section("Measure", "The displacement that increments prescribe with \"Control\" = \"Measure\"."),
          loading.measure);
  section.optional(
      "Largest Break per Increment", loading.largest_break, 100, count(),
      "Bonds. If given, an increment in which more break is taken back and repeated with half its load, up to "
      "eight times, and increments grow again where less than half as many break. Of a crack that jumps at "
      "its load no increment is small enough. history.csv and the files of fields then count accepted "
      "increments, of which there are more than \"Increments\", and the load factor says how far they have "
      "come.");
  changeable.parameter("Maximum Damage Iterations", loading.max_damage_iterations, count(),
                       "Solutions within one increment, after which the run ends with status 3. An unstable crack "
                       "takes hundreds to thousands.");
  section.parameter("Breaking Fraction", numerical.breaking_fraction, share(),
                    "Which share of the bonds past the critical stretch breaks before the body is solved for again, "
                    "the worst first [-]. 1 breaks all of them, as WHL19 does. With less, bonds that the others would "
                    "relieve are spared; an unstable crack takes as many times more solutions.");
  changeable.parameter("Maximum Zone Growths", loading.max_zone_growths, count(),
                       "Growths of the peridynamic zone within one increment, after which the run ends with status 3.");
  changeable.parameter(
      "Softening Tolerance", numerical.softening_tolerance, between(0., 1.),
      "Within one increment, softening is followed until what it takes from the forces is this small a "
      "share of the reactions [-]. Only for bonds that soften; the rest softens in the next increment.");
}

void check_loading(const input::Values& section, int dimension, bool softens, bool breaks) {
  check_measure_control(section, dimension);
  check_softening(section, softens);
  if (breaks || !section.given("Largest Break per Increment")) return;
  section.mistake("Largest Break per Increment",
                  "found, but nothing breaks; allowed is it with a \"Critical Stretch\" or a \"Fracture Energy\"");
}

}  // namespace perimorph::cases
