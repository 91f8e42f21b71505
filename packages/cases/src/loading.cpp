#include "perimorph/cases/loading.hpp"

namespace perimorph::cases {

void declare(const input::Section& section, Loading& loading, model::NumericalOptions& numerical) {
  using namespace input;
  const Section changeable = section.changeable();
  changeable.required(
      "Increments", loading.increments, 100, count(),
      "Load steps k = 1, 2, ... up to this one. Before the first break they cost next to nothing. With few large ones "
      "the first break is known only to within a large step, and a crack that would grow slowly jumps.");
  changeable.parameter("Maximum Damage Iterations", loading.max_damage_iterations, count(),
                       "Solutions within one increment, after which the run ends with status 3. An unstable crack "
                       "takes hundreds to thousands.");
  section.parameter("Breaking Fraction", numerical.breaking_fraction, share(),
                    "Which share of the bonds past the critical stretch breaks before the body is solved for again, "
                    "the worst first [-]. 1 breaks all of them, as WHL19 does. With less, bonds that the others would "
                    "relieve are spared; an unstable crack takes as many times more solutions.");
  changeable.parameter("Maximum Zone Growths", loading.max_zone_growths, count(),
                       "Growths of the peridynamic zone within one increment, after which the run ends with status 3.");
}

}  // namespace perimorph::cases
