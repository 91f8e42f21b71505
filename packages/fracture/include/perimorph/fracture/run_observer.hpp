#pragma once

#include "perimorph/fracture/adaptive_loop.hpp"
#include "perimorph/fracture/checkpoints.hpp"
#include "perimorph/fracture/results.hpp"

namespace perimorph::fracture {

/// What a run does beside computing: results, progress, checkpoints, stop requests and new partitions. The arguments
/// must outlive this.
template <int dim>
class RunObserver : public LoopObserver<dim> {
 public:
  RunObserver(Results<dim>& results, Checkpoints<dim>& checkpoints) : results_(results), checkpoints_(checkpoints) {}

  /// @throws base::ComputationError if the disk is full.
  void accepted(int increment, Body<dim>& body) override {
    results_.accept(increment, body);
    checkpoints_.accept(increment, body, results_);
  }
  void solved(int increment, const Body<dim>& body) override { results_.show_progress(increment, body); }
  bool stop_requested() override { return checkpoints_.stop_requested(); }
  bool rebalance_wanted(const Body<dim>& body) override { return checkpoints_.rebalance_wanted(body); }

 private:
  Results<dim>& results_;
  Checkpoints<dim>& checkpoints_;
};

}  // namespace perimorph::fracture
