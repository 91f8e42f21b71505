#pragma once

#include <memory>
#include <optional>
#include <string>

#include "perimorph/cases/case.hpp"
#include "perimorph/io/history.hpp"
#include "perimorph/output/console.hpp"
#include "perimorph/output/exports.hpp"
#include "perimorph/output/field_series.hpp"
#include "perimorph/output/results_state.hpp"

namespace perimorph::output {

/// The first Exodus file of an increment that cannot be finished, in a folder within that of the run.
std::string unfinished_file(const std::string& folder, const std::string& case_name);

/// Everything a run leaves behind of its accepted increments: a row of history.csv, a line on the terminal, fields, and
/// what is written on request. Rank 0 writes what it gathers from all; spread files each rank by itself.
template <int dim>
class Results {
 public:
  /// Goes on with the results of an earlier run, if there is one; what is left of other runs is removed. Collective.
  /// @param profile must outlive this
  /// @throws UserError if the folder cannot be written, or the earlier results are not there.
  Results(const Teuchos::RCP<const base::Comm>& comm, const cases::Case& input, const std::string& folder,
          ConsoleOptions console, base::Profile& profile, const std::optional<ResultsState>& earlier = {});

  /// Accepted increments are recorded by these too. Local.
  void add_exports(std::unique_ptr<Exports<dim>> exports) { exports_ = std::move(exports); }

  /// What it has come to; complete on rank 0 only. Local.
  ResultsState state() const;

  /// Records the last accepted increment; fields too if they are due, a bond broke or it is the last of all.
  /// Collective.
  /// @throws ComputationError if a file cannot be written, or somebody has removed or changed it.
  void accept(const fracture::LoopPosition& position, const fracture::Body<dim>& body);

  /// Writes the fields of an increment that cannot be finished, beside the series of those that are accepted; returns
  /// the file. Collective. @throws as accept.
  std::string write_unfinished(int increment, const fracture::Body<dim>& body);

  /// What the current increment is at. Local.
  void show_progress(const fracture::LoopPosition& position, const fracture::Body<dim>& body) {
    console_.show_progress(position, body.counts(), body.solver_fallbacks());
  }

  /// Waits until the disk has all files as they are. Collective. @throws ComputationError if it fails.
  void bring_to_disk();

  /// The closing lines: peak and last reaction, counts, profile. Collective.
  void summarize(const fracture::Body<dim>& body) { console_.summarize(*comm_, body.counts(), totals_, reactions_); }

 private:
  Teuchos::RCP<const base::Comm> comm_;
  base::Profile& profile_;
  std::string folder_;
  double earlier_seconds_;  ///< of the run that this one goes on with
  int output_every_, last_increment_;
  Totals totals_;
  std::vector<Reaction> reactions_;
  std::vector<Column> columns_;
  SeriesOptions unfinished_;  ///< of an increment that cannot be finished
  Console console_;
  std::unique_ptr<io::History> history_;  ///< on rank 0
  std::unique_ptr<FieldSeries<dim>> fields_;
  std::unique_ptr<Exports<dim>> exports_;

  void remove_unfinished() const;
  double seconds() const { return earlier_seconds_ + profile_.elapsed(); }
  base::GlobalId count(int increment, const discretization::Counts& counts);
  IncrementRecord record_of(int increment, const fracture::Body<dim>& body);
  std::vector<double> values_of(const IncrementRecord& record) const;
};

}  // namespace perimorph::output
