#include "perimorph/fracture/adaptive_loop.hpp"

#include <cmath>

#include "perimorph/base/errors.hpp"

namespace perimorph::fracture {

namespace {

void check_limit(int count, int limit, int increment, const char* what, const char* parameter) {
  if (count <= limit) return;
  throw UnfinishedIncrement(
      fmt::format("increment {}: more than {} {}; /Loading/{} sets this limit", increment, limit, what, parameter));
}

/// Of an increment, in which softening may still recover, so that it does not depend on how large the increment is;
/// after them it only grows, and so comes to an end.
constexpr int free_solves = 10;

/// Bonds.
template <int dim>
base::GlobalId broken_in_this(const Body<dim>& body, const LoopPosition& position) {
  return body.counts().broken_bonds - position.broken_before;
}

/// Solves and breaks bonds until nothing breaks any more.
template <int dim>
LoopEnd break_until_quiet(Body<dim>& body, const LoopLimits& limits, LoopObserver<dim>& observer,
                          LoopPosition& position) {
  for (;;) {
    if (!position.is_solved) {
      check_limit(position.damage_iterations++, limits.max_damage_iterations, position.increment + 1, "solves",
                  "Maximum Damage Iterations");
      body.solve(position.accuracy);
      observer.solved(position, body);
      position.is_solved = true;
    }
    if (observer.stop_requested(position, body)) return LoopEnd::stopped;
    const bool is_quiet = body.break_bonds(position.damage_iterations <= free_solves) == 0;
    const bool is_accurate = position.accuracy == Accuracy::accepted;
    position.is_solved = false;
    position.accuracy = is_quiet && !is_accurate ? Accuracy::accepted : Accuracy::breaking;
    if (is_quiet && is_accurate) return LoopEnd::done;
    if (position.may_be_cut && broken_in_this(body, position) > limits.largest_break) return LoopEnd::cut;
  }
}

void begin(base::GlobalId broken, const LoopLimits& limits, LoopPosition& position) {
  const bool is_limited = limits.largest_break < std::numeric_limits<base::GlobalId>::max();
  position.broken_before = broken;
  position.may_be_cut = is_limited && !position.step.is_smallest();
}

}  // namespace

template <int dim>
LoopEnd run_increment(Body<dim>& body, double prescribed, const LoopLimits& limits, LoopObserver<dim>& observer,
                      LoopPosition& position) {
  PERIMORPH_ASSERT(std::isfinite(prescribed), "prescribed {}", prescribed);
  PERIMORPH_ASSERT(limits.max_damage_iterations > 0 && limits.max_zone_growths > 0, "at most {} solves and {} growths",
                   limits.max_damage_iterations, limits.max_zone_growths);
  PERIMORPH_ASSERT(position.increment >= 0 && position.growths >= 0 && position.damage_iterations >= 0,
                   "after increment {}, {} growths, {} solves", position.increment, position.growths,
                   position.damage_iterations);
  const int increment = position.increment + 1;
  const bool has_begun = position.damage_iterations > 0;
  if (!has_begun) begin(body.counts().broken_bonds, limits, position);
  body.prescribe(prescribed, has_begun);
  do {
    if (!position.is_solved) {
      check_limit(position.growths, limits.max_zone_growths, increment, "growths of the zone", "Maximum Zone Growths");
      if (observer.refinement_wanted(body)) return LoopEnd::refine;
      body.update_topology();
      if (observer.rebalance_wanted(body)) return LoopEnd::rebalance;
      ++position.growths;
    }
    const auto end = break_until_quiet(body, limits, observer, position);
    if (end == LoopEnd::cut) position = {position.increment, position.step.halved()};
    if (end != LoopEnd::done) return end;
  } while (body.flag_damaged_elements() > 0);
  body.accept_history();
  const bool may_grow = 2 * broken_in_this(body, position) <= limits.largest_break;
  position = {increment, position.step.next(may_grow)};
  observer.accepted(position, body);
  return LoopEnd::done;
}

template <int dim>
LoopEnd run_adaptive_loop(Body<dim>& body, const LoopLimits& limits, LoopObserver<dim>& observer,
                          LoopPosition& position) {
  auto end = LoopEnd::done;
  while (end == LoopEnd::done && position.step.begin < limits.increments) {
    end = run_increment(body, body.problem().prescribed_in(position.step.end()), limits, observer, position);
  }
  return end;
}

#define PERIMORPH_INSTANTIATE(dim)                                                                               \
  template LoopEnd run_increment<dim>(Body<dim>&, double, const LoopLimits&, LoopObserver<dim>&, LoopPosition&); \
  template LoopEnd run_adaptive_loop<dim>(Body<dim>&, const LoopLimits&, LoopObserver<dim>&, LoopPosition&);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::fracture
