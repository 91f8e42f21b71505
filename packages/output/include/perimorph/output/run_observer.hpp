#pragma once

#include "perimorph/fracture/adaptive_loop.hpp"
#include "perimorph/output/checkpoints.hpp"
#include "perimorph/output/rebalancing.hpp"
#include "perimorph/output/stop_requests.hpp"

namespace perimorph::output {

/// What a run does beside computing: results, progress, checkpoints, stop requests and new partitions. The arguments
/// must outlive this.
template <int dim>
class RunObserver : public fracture::LoopObserver<dim> {
 public:
  RunObserver(const Teuchos::RCP<const base::Comm>& comm, Results<dim>& results, Checkpoints<dim>& checkpoints,
              Rebalancing<dim>& rebalancing, StopRequests& requests)
      : comm_(comm), results_(results), checkpoints_(checkpoints), rebalancing_(rebalancing), requests_(requests) {}

  /// @throws base::ComputationError if the disk is full.
  void accepted(int increment, fracture::Body<dim>& body) override {
    results_.accept(increment, body);
    checkpoints_.accept(increment, body, results_.state(), rebalancing_.element_costs(),
                        requests_.take_checkpoint_request());
  }
  void solved(int increment, const fracture::Body<dim>& body) override { results_.show_progress(increment, body); }
  bool stop_requested() override { return requests_.stop_requested(*comm_); }
  bool rebalance_wanted(const fracture::Body<dim>& body) override { return rebalancing_.is_wanted(body); }

 private:
  Teuchos::RCP<const base::Comm> comm_;
  Results<dim>& results_;
  Checkpoints<dim>& checkpoints_;
  Rebalancing<dim>& rebalancing_;
  StopRequests& requests_;
};

}  // namespace perimorph::output
