#pragma once

#include <optional>
#include <string>

#include "perimorph/base/log.hpp"
#include "perimorph/cases/case.hpp"
#include "perimorph/output/results.hpp"
#include "perimorph/output/state_transfer.hpp"

namespace perimorph::output {

/// A run's checkpoints: the state after the last accepted increment, kept in memory, and brought to disk when it is
/// due, requested or about to be lost. They do not depend on the number of ranks.
template <int dim>
class Checkpoints {
 public:
  /// Local.
  Checkpoints(const Teuchos::RCP<const base::Comm>& comm, const cases::Case& input, const std::string& folder,
              base::Log log);

  /// Reads the newest intact checkpoint and returns the body's state in it (share_state), if there is any. Collective.
  /// @throws UserError if all are damaged, or if it belongs to another case: names what differs.
  std::optional<io::Checkpoint> load();

  /// Which mesh this run has. The mesh is whole on rank 0. Collective.
  /// @throws UserError if the checkpoint that was loaded belongs to another.
  void identify(const mesh::Mesh<dim>& whole);

  /// The increment that was loaded or accepted last, 0 if there was none, and what the results had come to. Local.
  int increment() const { return increment_; }
  const std::optional<ResultsState>& results() const { return results_; }

  /// The cost of each element when the checkpoint that was loaded was written; on rank 0, {} if none was. Local.
  const std::vector<double>& element_costs() const { return element_costs_; }

  /// Removes the files of later increments than that one, which an earlier run has left. Collective.
  void remove_later() const;

  /// Remembers an accepted increment, and writes it if it is due. At every /Output/Checkpoint Every increments, the run
  /// itself goes on as one that starts from there would, to the last bit. Collective.
  /// @param element_costs by which the mesh is partitioned now, on rank 0
  /// @param is_requested it is due in any case; the same on all ranks
  /// @throws ComputationError if it is due and cannot be written.
  void accept(int increment, fracture::Body<dim>& body, const ResultsState& results,
              const std::vector<double>& element_costs, bool is_requested);

  /// Writes what is remembered, if that is not on disk already. Collective. @throws ComputationError if it cannot be.
  void write();

 private:
  Teuchos::RCP<const base::Comm> comm_;
  base::Log log_;
  io::CheckpointFolder folder_;
  std::string case_lines_;
  int every_, last_increment_;
  double seconds_;                                           ///< between two of them
  std::vector<base::GlobalId> mesh_identity_, loaded_mesh_;  ///< of this run; of the checkpoint that was loaded

  int increment_ = 0;        ///< loaded or remembered last
  bool is_on_disk_ = false;  ///< that one
  discretization::SavedState<dim> body_;
  std::vector<base::GlobalId> owned_elements_;  ///< in the order of body_.displacement
  std::optional<ResultsState> results_;
  std::vector<double> element_costs_;

  double last_written_ = 0.;

  io::Checkpoint read_newest() const;
  void check_origin(const io::Checkpoint& checkpoint) const;
  bool is_due(int increment) const;
};

}  // namespace perimorph::output
