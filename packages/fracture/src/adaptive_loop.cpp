#include "perimorph/fracture/adaptive_loop.hpp"

#include <cmath>

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
LoopEnd run_increment(Body<dim>& body, double load_factor, const LoopLimits& limits, LoopObserver<dim>& observer,
                      LoopPosition& position) {
  PERIMORPH_ASSERT(std::isfinite(load_factor), "load factor {}", load_factor);
  PERIMORPH_ASSERT(limits.max_damage_iterations > 0 && limits.max_zone_growths > 0, "at most {} solves and {} growths",
                   limits.max_damage_iterations, limits.max_zone_growths);
  PERIMORPH_ASSERT(position.increment >= 0 && position.growths >= 0 && position.damage_iterations >= 0,
                   "after increment {}, {} growths, {} solves", position.increment, position.growths,
                   position.damage_iterations);
  const int increment = position.increment + 1;
  if (position.damage_iterations == 0) body.apply_load(load_factor);
  do {
    body.update_topology();
    if (observer.rebalance_wanted(body)) return LoopEnd::rebalance;
    check_limit(position.growths++, limits.max_zone_growths, increment, "growths of the zone", "Maximum Zone Growths");
    bool stopped = false;
    const auto breaks = [&](Accuracy accuracy) {
      check_limit(position.damage_iterations++, limits.max_damage_iterations, increment, "solves",
                  "Maximum Damage Iterations");
      body.solve(accuracy);
      observer.solved(increment, body);
      stopped = observer.stop_requested();
      return !stopped && body.break_bonds() > 0;
    };
    while (breaks(Accuracy::breaking) || (!stopped && breaks(Accuracy::accepted))) {
    }
    if (stopped) return LoopEnd::stopped;
  } while (body.flag_damaged_elements() > 0);
  position = {increment};
  observer.accepted(increment, body);
  return LoopEnd::done;
}

template <int dim>
LoopEnd run_adaptive_loop(Body<dim>& body, const LoopLimits& limits, LoopObserver<dim>& observer,
                          LoopPosition& position) {
  auto end = LoopEnd::done;
  while (end == LoopEnd::done && position.increment < limits.increments) {
    end = run_increment(body, position.increment + 1, limits, observer, position);
  }
  return end;
}

#define PERIMORPH_INSTANTIATE(dim)                                                                               \
  template LoopEnd run_increment<dim>(Body<dim>&, double, const LoopLimits&, LoopObserver<dim>&, LoopPosition&); \
  template LoopEnd run_adaptive_loop<dim>(Body<dim>&, const LoopLimits&, LoopObserver<dim>&, LoopPosition&);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::fracture
