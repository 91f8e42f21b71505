#include "perimorph/fracture/adaptive_loop.hpp"

#include "perimorph/base/errors.hpp"

namespace perimorph::fracture {

namespace {

void check_limit(int count, int limit, int increment, const char* what, const char* parameter) {
  if (count <= limit) return;
  throw base::ComputationError(
      fmt::format("increment {}: more than {} {}; /Loading/{} sets this limit", increment, limit, what, parameter));
}

}  // namespace

template <int dim>
bool run_adaptive_loop(Body<dim>& body, Results<dim>& results, Checkpoints<dim>& checkpoints, const LoopLimits& limits,
                       LoopPosition& position) {
  for (int increment = checkpoints.increment() + 1; increment <= limits.increments; ++increment) {
    if (position.damage_iterations == 0) body.apply_load(increment);
    do {
      body.update_topology();
      if (checkpoints.parts_anew(body)) return false;
      check_limit(position.growths++, limits.max_zone_growths, increment, "growths of the zone",
                  "Maximum Zone Growths");
      const auto breaks = [&](Accuracy accuracy) {
        check_limit(position.damage_iterations++, limits.max_damage_iterations, increment, "solves",
                    "Maximum Damage Iterations");
        body.solve(accuracy);
        results.show_progress(increment, body);
        checkpoints.heed_signals();
        return body.break_bonds() > 0;
      };
      while (breaks(Accuracy::breaking) || breaks(Accuracy::accepted)) {
      }
    } while (body.flag_damaged_elements() > 0);
    position = {};
    results.accept(increment, body);
    checkpoints.accept(increment, body, results);
  }
  return true;
}

template bool run_adaptive_loop<2>(Body<2>&, Results<2>&, Checkpoints<2>&, const LoopLimits&, LoopPosition&);
template bool run_adaptive_loop<3>(Body<3>&, Results<3>&, Checkpoints<3>&, const LoopLimits&, LoopPosition&);

}  // namespace perimorph::fracture
