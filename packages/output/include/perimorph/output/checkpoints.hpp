#pragma once

#include <optional>
#include <string>
#include <variant>

#include "perimorph/base/log.hpp"
#include "perimorph/cases/case.hpp"
#include "perimorph/fracture/adaptive_loop.hpp"
#include "perimorph/output/results.hpp"
#include "perimorph/output/state_transfer.hpp"

namespace perimorph::output {

/// What follows "after increment 12", such as ", and 40 solves of the next".
std::string solves_of_the_next(const fracture::LoopPosition& position);

/// A run's checkpoints: the state after the last accepted increment or within the next one, kept in memory, and brought
/// to disk when it is due, requested or about to be lost. They do not depend on the number of ranks.
template <int dim>
class Checkpoints {
 public:
  /// Local.
  Checkpoints(const Teuchos::RCP<const base::Comm>& comm, const cases::Case& input, const std::string& folder,
              base::Log log);

  /// Reads the newest checkpoint that is intact and that the results in the folder support, and returns the body's
  /// state in it (share_state), if there is any. Collective.
  /// @throws UserError if there are only others, or if it belongs to another case: names what differs.
  std::optional<io::Checkpoint> load();

  /// Which mesh this run has. Collective.
  /// @param part a whole mesh on rank 0, or what each rank has of it
  /// @throws UserError if the checkpoint that was loaded belongs to another.
  void identify(const mesh::Mesh<dim>& part);

  /// Where the run is: loaded or remembered last. Local.
  const fracture::LoopPosition& position() const { return position_; }
  int increment() const { return position_.increment; }

  /// What the results had come to at the last accepted increment; none: nothing has been written yet. Local.
  const std::optional<ResultsState>& results() const { return results_; }

  /// How many increments the run was to have when it began. Local.
  int planned_increments() const { return planned_increments_; }

  /// The cost of each element when the checkpoint that was loaded was written, in slices (partition_costs.hpp); none on
  /// all ranks if none was loaded. Local.
  const std::optional<std::vector<double>>& element_costs() const { return element_costs_; }

  /// The refinements of the mesh that the state at the position belongs to (model::Refinement::calls). Local.
  const std::vector<base::GlobalId>& refinements() const { return refinements_; }

  /// Removes all that are later than the position, which an earlier run has left. Collective.
  void remove_later() const;

  /// The results before the first increment: from then on there is something to go on from. Local.
  /// @param refinements of the mesh that states will belong to from now on
  void begin(const ResultsState& results, std::vector<base::GlobalId> refinements = {}) {
    if (!results_) results_ = results;
    refinements_of_mesh_ = std::move(refinements);
  }

  /// The state after the last accepted increment, to which one that was cut goes back; none: the beginning. Collective.
  std::optional<io::Checkpoint> start_of_increment() const;

  /// Remembers an accepted increment, and writes it if it is due. At every /Output/Checkpoint Every increments, the run
  /// itself goes on as one that starts from there would, to the last bit. Collective.
  /// @param element_costs by which the mesh is partitioned now, in slices
  /// @param is_requested it is due in any case; the same on all ranks
  /// @throws ComputationError if it is due and cannot be written.
  void accept(const fracture::LoopPosition& position, fracture::Body<dim>& body, Results<dim>& results,
              const std::vector<double>& element_costs, bool is_requested);

  /// Within an increment, after a solve: writes the state if it is due by the clock or requested. With
  /// /Output/Checkpoint Every it is that of the last twentieth solve, after which the run goes on as one that starts
  /// from there would, to the last bit; otherwise that of this solve, if it has taken ten of them or some seconds to
  /// get there. An increment that may be cut is not remembered. Collective.
  /// @param element_costs as for accept
  /// @param is_needed the state is about to be lost; the same on all ranks, as is_requested
  /// @throws ComputationError if it is due and cannot be written.
  void solved(const fracture::LoopPosition& position, fracture::Body<dim>& body, Results<dim>& results,
              const std::vector<double>& element_costs, bool is_needed, bool is_requested);

  /// Writes what is remembered, if that is not on disk already, after all results that it counts on. Collective.
  /// @throws ComputationError if it cannot be written.
  void write(Results<dim>& results);

 private:
  Teuchos::RCP<const base::Comm> comm_;
  base::Log log_;
  io::CheckpointFolder folder_;
  std::string case_lines_;
  int every_, last_increment_, planned_increments_;
  double seconds_;                                           ///< between two of them
  std::vector<base::GlobalId> mesh_identity_, loaded_mesh_;  ///< of this run; of the checkpoint that was loaded

  fracture::LoopPosition position_;  ///< loaded or remembered last
  bool is_on_disk_ = true;           ///< that one; the beginning needs none
  discretization::SavedState<dim> body_;
  std::vector<base::GlobalId> owned_elements_;  ///< in the order of body_.displacement
  std::optional<ResultsState> results_;         ///< at the last accepted increment
  double remembered_seconds_ = 0.;              ///< of the run, at the position that is remembered, [s]
  std::optional<std::vector<double>> element_costs_;
  std::vector<base::GlobalId> refinements_, refinements_of_mesh_;
  std::optional<io::Checkpoint> loaded_;  ///< as long as nothing else is remembered

  double last_remembered_, last_written_;  ///< [s]

  std::optional<io::Checkpoint> read_newest() const;
  std::string trouble_with(const io::Checkpoint& checkpoint, io::CheckpointId id) const;
  std::variant<io::Checkpoint, std::string> try_to_read(io::CheckpointId id) const;
  void check_origin(const io::Checkpoint& checkpoint) const;
  void check_results() const;
  bool have_passed(double seconds, double since) const;
  bool is_time() const;
  bool is_worthwhile(const fracture::LoopPosition& position) const;
  void remember(const fracture::LoopPosition& position, const fracture::Body<dim>& body,
                const std::vector<double>& element_costs);
};

}  // namespace perimorph::output
