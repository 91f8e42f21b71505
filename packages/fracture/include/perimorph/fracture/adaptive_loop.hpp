#pragma once

#include "perimorph/fracture/body.hpp"
#include "perimorph/fracture/checkpoints.hpp"
#include "perimorph/fracture/results.hpp"

namespace perimorph::fracture {

/// What bounds the loop.
struct LoopLimits {
  int increments;
  int max_damage_iterations;  ///< solves within one increment
  int max_zone_growths;       ///< changes of topology within one increment
};

/// How far the loop has come within an increment.
struct LoopPosition {
  int growths = 0, damage_iterations = 0;
};

/// The adaptive algorithm of WHL19, Fig. 5: load increments; in each, bonds break and the peridynamic zone grows until
/// neither happens any more. Begins after the increment that the checkpoints have loaded. Returns whether all
/// increments are done; otherwise it is to be called again from its position, with the mesh parted anew. Collective.
/// @throws base::ComputationError if the solver fails, a limit is passed, a signal asks to stop or the disk is full;
/// the results of all accepted increments are then on disk.
template <int dim>
bool run_adaptive_loop(Body<dim>& body, Results<dim>& results, Checkpoints<dim>& checkpoints, const LoopLimits& limits,
                       LoopPosition& position);

}  // namespace perimorph::fracture
