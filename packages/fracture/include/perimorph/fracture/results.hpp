#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <tuple>

#include "perimorph/base/log.hpp"
#include "perimorph/base/pace.hpp"
#include "perimorph/cases/case.hpp"
#include "perimorph/fracture/body.hpp"
#include "perimorph/fracture/exports.hpp"
#include "perimorph/io/exodus.hpp"
#include "perimorph/io/history.hpp"

namespace perimorph::fracture {

/// Where a run speaks.
struct Voice {
  base::Log log;
  bool shows_progress;  ///< a line on the terminal, overwritten in place, while an increment goes on
};

/// What results have come to, for a run that goes on after them.
struct ResultsState {
  double seconds = 0.;         ///< since the start of the run
  double seconds_before = 0.;  ///< of them, before this process was started
  io::SeriesExtent series;
  int first_break = 0;
  base::GlobalId broken = 0, solves = 0, iterations = 0;
  std::vector<double> peaks;                    ///< of each reaction, [force]
  std::vector<base::GlobalId> peak_increments;  ///< in which increment
};

/// An element as it travels to rank 0, or into a file.
struct ElementRecord {
  base::GlobalId id;
  base::GlobalId nodes[mesh::max_corners];
  int block, kind;
  mesh::ElementType type;
};

/// What elements of one block of a file have in common; blocks come in this order.
struct BlockKey {
  int block, kind;
  mesh::ElementType type;
  bool operator<(const BlockKey& other) const {
    return std::tie(block, kind, type) < std::tie(other.block, other.kind, other.type);
  }
};

/// Sets of sides by name.
using SideSets = std::map<std::string, std::vector<mesh::Side>>;

/// Everything a run leaves behind: a row of history.csv and a line on the terminal per accepted increment, and the
/// Exodus series. Rank 0 writes what it gathers from all; spread files each rank by itself.
template <int dim>
class Results {
 public:
  /// Goes on with the results of an earlier run after that increment, if there are any. Collective.
  /// @throws UserError if the folder cannot be written, or the earlier results are not there.
  Results(const Teuchos::RCP<const base::Comm>& comm, const cases::Case& input, const std::string& folder, Voice voice,
          base::Profile& profile, int increment = 0, const std::optional<ResultsState>& earlier = {});

  /// Accepted increments are recorded by these too. Local.
  void add_exports(std::unique_ptr<Exports<dim>> exports) { exports_ = std::move(exports); }

  /// What it has come to; complete on rank 0 only. Local.
  ResultsState state() const;

  /// Records an increment; fields too if they are due, a bond broke or it is the last. Collective.
  void accept(int increment, const Body<dim>& body);

  /// What the current increment is at. Local.
  void show_progress(int increment, const Body<dim>& body);

  /// The closing lines: peak and last reaction, counts, profile. Local.
  void summarize(const Body<dim>& body);

 private:
  struct Reaction {
    std::string column;  ///< "<group>_<x|y|z>"
    std::string group;
    int component;
    double force = 0., displacement = 0.;  ///< of the last accepted increment: sum, mean over the group
    double peak = 0.;
    int peak_increment = 0;
  };

  Teuchos::RCP<const base::Comm> comm_;
  Voice voice_;
  base::Profile& profile_;
  bool is_spread_;
  double horizon_;
  int output_every_, last_increment_;
  std::vector<Reaction> reactions_;
  int shown_reaction_ = 0;  ///< in the lines on the terminal
  bool has_shown_a_line_ = false;
  operators::Overlap<dim> overlap_;  ///< of the last accepted increment
  bool has_warned_ = false;          ///< of an overlap
  std::unique_ptr<io::History> history_;
  std::unique_ptr<io::ExodusSeries<dim>> series_;
  std::unique_ptr<Exports<dim>> exports_;
  base::GlobalId broken_before_ = 0, topology_written_ = 0;  ///< none of an earlier run's: a new file
  base::GlobalId broken_sides_written_ = 0;
  int first_break_ = 0;
  base::Pace pace_;
  double seconds_before_ = 0., last_word_ = 0.;  ///< elapsed at the last accepted increment, at the last line
  base::GlobalId total_solves_ = 0, total_iterations_ = 0;

  bool first_file_is_new_ = true;  ///< no earlier run has left this series
  /// Rank 0: place in the file of each element in the order of gathering. In spread files: of each own element.
  std::vector<int> element_place_;
  std::vector<int> spread_nodes_;  ///< local nodes in the order of a spread file

  void take_over(const ResultsState& earlier);
  void measure_reactions(int increment, const Body<dim>& body);
  void show_line(int increment, const Body<dim>& body);
  void warn_of_overlap();
  double earlier_seconds_ = 0.;  ///< of the run that this one goes on with
  double seconds() const { return earlier_seconds_ + profile_.elapsed(); }
  std::vector<double> globals(const Body<dim>& body) const;
  void open_series(const cases::Case& input, const std::string& folder, std::vector<std::string> globals,
                   const std::optional<ResultsState>& earlier);
  void start_file(const Body<dim>& body, const std::vector<mesh::Side>& broken_surface);
  io::ExodusModel<dim> gathered(const Body<dim>& body, const std::vector<ElementRecord>& own,
                                const std::set<BlockKey>& keys, const SideSets& side_sets);
  io::ExodusModel<dim> own_part(const Body<dim>& body, std::vector<ElementRecord> own, const std::set<BlockKey>& keys,
                                const SideSets& side_sets);
  void write_fields(const Body<dim>& body, const std::vector<double>& global_values);
  std::vector<double> nodal_in_file_order(const Body<dim>& body, int component) const;
  std::vector<double> in_file_order(const std::vector<double>& own_elements) const;
};

}  // namespace perimorph::fracture
