#pragma once

#include <memory>
#include <optional>
#include <string>

#include "perimorph/base/log.hpp"
#include "perimorph/base/signals.hpp"
#include "perimorph/cases/case.hpp"
#include "perimorph/fracture/body.hpp"
#include "perimorph/fracture/results.hpp"
#include "perimorph/io/checkpoint.hpp"

namespace perimorph::fracture {

using discretization::SavedState;

/// A run's checkpoints: the state after the last accepted increment, kept in memory, and brought to disk when it is
/// due, asked for or about to be lost. They do not depend on the number of ranks.
template <int dim>
class Checkpoints {
 public:
  Checkpoints(const Teuchos::RCP<const base::Comm>& comm, const cases::Case& input, const std::string& folder,
              base::Log log);

  /// Reads the newest sound checkpoint, if there is any. Collective.
  /// @throws UserError if all are damaged, or if it belongs to another case: names what differs.
  void load();

  /// Which mesh this run has. The mesh is whole on rank 0. Collective.
  /// @throws UserError if the checkpoint that was loaded belongs to another.
  void identify(const mesh::Mesh<dim>& whole);

  /// The cost of each element by which the mesh is to be parted among the ranks: as when the checkpoint was written, or
  /// as expected. On rank 0. Local.
  const std::vector<double>& costs() const { return costs_; }
  void expect_costs(std::vector<double> costs) {
    if (costs_.empty()) costs_ = std::move(costs);
  }

  /// The increment that was loaded, 0 if none was, and what the results had come to. Local.
  int increment() const { return increment_; }
  const std::optional<ResultsState>& results() const { return results_; }

  /// The body goes on from what was loaded, or from where rebalance_wanted() left the last one; checkpoints after the
  /// last accepted increment are removed. Collective.
  void restore(Body<dim>& body);

  /// Remembers an accepted increment, and writes it if it is due. At every /Output/Checkpoint Every increments, the run
  /// itself goes on as one that starts from there would, to the last bit. Collective.
  /// @throws ComputationError if it is due and cannot be written.
  void accept(int increment, Body<dim>& body, const Results<dim>& results);

  /// If the ranks share the work so unevenly that another partition of the mesh is worth its price: remembers where the
  /// body stands, for another one to go on from there, and returns true. To be called when the topology has just been
  /// updated. Collective.
  bool rebalance_wanted(const Body<dim>& body);

  /// Whether a signal has asked the run to stop. Collective.
  bool stop_requested();
  const std::string& stop_signal() const { return stop_signal_; }  ///< its name; "" if there was none

  /// Writes what is remembered, if that is not on disk already. Collective. @throws ComputationError if it cannot be.
  void write();

 private:
  Teuchos::RCP<const base::Comm> comm_;
  base::Log log_;
  io::CheckpointFolder folder_;
  std::string case_lines_;
  int every_, last_increment_;
  double seconds_;  ///< between two of them
  double largest_imbalance_;
  std::vector<base::GlobalId> mesh_identity_;

  std::vector<double> costs_;  ///< on rank 0, by element
  base::GlobalId weighed_topology_ = 0;

  int increment_ = 0;        ///< loaded or remembered last
  bool is_on_disk_ = false;  ///< that one
  SavedState<dim> body_;
  std::vector<base::GlobalId> own_ids_;  ///< of elements, in the order of body_.displacement
  std::optional<ResultsState> results_;
  std::vector<double> costs_then_;  ///< costs_ when it was accepted

  io::Checkpoint start_;  ///< of the next body, on rank 0: loaded, or where the last body has come to
  bool has_start_ = false;

  base::Signals signals_;
  std::string stop_signal_;
  bool is_asked_ = false;
  double last_written_ = 0.;

  io::Checkpoint read_newest() const;
  SavedState<dim> body_state_in(const io::Checkpoint& checkpoint, const mesh::Mesh<dim>& mesh) const;
  io::Checkpoint gather(const SavedState<dim>& state, const std::vector<base::GlobalId>& elements) const;
  bool is_due(int increment);
};

}  // namespace perimorph::fracture
