#pragma once

#include <limits>

#include "perimorph/fracture/body.hpp"
#include "perimorph/model/load_step.hpp"

namespace perimorph::fracture {

/// What bounds the loop.
struct LoopLimits {
  int increments;             ///< of the load
  int max_damage_iterations;  ///< solves within one increment
  int max_zone_growths;       ///< changes of topology within one increment
  /// Bonds that break in one increment, or it is cut: to be repeated with half its step, unless that is the smallest.
  base::GlobalId largest_break = std::numeric_limits<base::GlobalId>::max();
};

/// How far the loop has come: the last accepted increment, and what the next one has taken already.
struct LoopPosition {
  int increment = 0;
  model::LoadStep step;              ///< of the next one
  base::GlobalId broken_before = 0;  ///< bonds, when the next one began
  bool may_be_cut = false;           ///< the next one: what it has come to may not last
  int growths = 0, damage_iterations = 0;
  bool is_solved = false;  ///< to this accuracy, and nothing has broken since; otherwise that is what comes next
  Accuracy accuracy = Accuracy::breaking;
};

/// Why the loop returns: all is done; it was asked to stop; the mesh is to be refined, or repartitioned; or an
/// increment was cut. In the three cases before the last it can go on from its position with a body restored from the
/// state of this one, in the last with one restored from the state after the last accepted increment.
enum class LoopEnd { done, stopped, refine, rebalance, cut };

/// Is called on what happens in the loop, and may interrupt it. All calls are collective, and all ranks answer alike.
template <int dim>
class LoopObserver {
 public:
  virtual ~LoopObserver() = default;

  /// An increment is accepted: nothing breaks any more.
  virtual void accepted(const LoopPosition& /*position*/, Body<dim>& /*body*/) {}

  /// The forces balance; what is overstretched has not broken yet.
  virtual void solved(const LoopPosition& /*position*/, const Body<dim>& /*body*/) {}

  /// Whether the loop is to return now, after a solve. From this position it can go on with a body restored from the
  /// state of this one, too.
  virtual bool stop_requested(const LoopPosition& /*position*/, Body<dim>& /*body*/) { return false; }

  /// Whether the loop is to return for a finer mesh, before a change of topology.
  virtual bool refinement_wanted(const Body<dim>& /*body*/) { return false; }

  /// Whether the loop is to return for a new partition, after a change of topology.
  virtual bool rebalance_wanted(const Body<dim>& /*body*/) { return false; }
};

/// One increment of the adaptive algorithm of WHL19, Fig. 5, the one after the position's: bonds break and the
/// peridynamic zone grows until neither happens any more, or too many have broken. Collective.
/// @param prescribed by the increment, as Body::prescribe() takes it
/// @throws UnfinishedIncrement if there is no solution or a limit is passed, ComputationError if the solver fails
template <int dim>
LoopEnd run_increment(Body<dim>& body, double prescribed, const LoopLimits& limits, LoopObserver<dim>& observer,
                      LoopPosition& position);

/// The adaptive algorithm of WHL19, Fig. 5: the increments of the body's problem, from the position on.
/// Collective. @throws as run_increment; all accepted increments have been observed.
template <int dim>
LoopEnd run_adaptive_loop(Body<dim>& body, const LoopLimits& limits, LoopObserver<dim>& observer,
                          LoopPosition& position);

}  // namespace perimorph::fracture
