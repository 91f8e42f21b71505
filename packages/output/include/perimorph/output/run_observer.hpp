#pragma once

#include "perimorph/fracture/adaptive_loop.hpp"
#include "perimorph/io/folder_lock.hpp"
#include "perimorph/model/refinement.hpp"
#include "perimorph/output/checkpoints.hpp"
#include "perimorph/output/rebalancing.hpp"
#include "perimorph/output/stop_requests.hpp"

namespace perimorph::output {

/// What a run does beside computing: results, progress, checkpoints, stop requests, finer meshes and new partitions.
/// The arguments must outlive this.
template <int dim>
class RunObserver : public fracture::LoopObserver<dim> {
 public:
  /// @param lock of the folder of the results, on rank 0; null on others
  RunObserver(const Teuchos::RCP<const base::Comm>& comm, const io::FolderLock* lock, Results<dim>& results,
              Checkpoints<dim>& checkpoints, model::Refinement<dim>& refinement, Rebalancing<dim>& rebalancing,
              StopRequests& requests)
      : comm_(comm),
        lock_(lock),
        results_(results),
        checkpoints_(checkpoints),
        refinement_(refinement),
        rebalancing_(rebalancing),
        requests_(requests) {}

  /// @throws base::ComputationError if the disk is full, or somebody has emptied the folder.
  void accepted(const fracture::LoopPosition& position, fracture::Body<dim>& body) override {
    base::on_all_ranks(*comm_, [&] {
      if (lock_ != nullptr) lock_->check();
    });
    results_.accept(position, body);
    checkpoints_.accept(position, body, results_, rebalancing_.element_costs(), requests_.take_checkpoint_request());
  }
  void solved(const fracture::LoopPosition& position, const fracture::Body<dim>& body) override {
    results_.show_progress(position, body);
  }

  /// @throws base::ComputationError if the disk is full.
  bool stop_requested(const fracture::LoopPosition& position, fracture::Body<dim>& body) override {
    const bool stops = requests_.stop_requested(*comm_);
    checkpoints_.solved(position, body, results_, rebalancing_.element_costs(), stops,
                        requests_.take_checkpoint_request());
    return stops;
  }
  bool refinement_wanted(const fracture::Body<dim>& body) override {
    return !refinement_.serves(body.state().flag_points);
  }
  bool rebalance_wanted(const fracture::Body<dim>& body) override { return rebalancing_.is_wanted(body); }

 private:
  Teuchos::RCP<const base::Comm> comm_;
  const io::FolderLock* lock_;
  Results<dim>& results_;
  Checkpoints<dim>& checkpoints_;
  model::Refinement<dim>& refinement_;
  Rebalancing<dim>& rebalancing_;
  StopRequests& requests_;
};

}  // namespace perimorph::output
