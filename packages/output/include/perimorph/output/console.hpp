#pragma once

#include "perimorph/base/log.hpp"
#include "perimorph/base/pace.hpp"
#include "perimorph/base/profile.hpp"
#include "perimorph/fracture/adaptive_loop.hpp"
#include "perimorph/output/increment_record.hpp"

namespace perimorph::output {

/// Where a run reports, and how much.
struct ConsoleOptions {
  base::Log log;
  bool shows_progress;  ///< a line on the terminal, overwritten in place, while an increment goes on; on rank 0
};

/// What a run counts from its first increment to its last.
struct Totals {
  int first_break = 0;            ///< increment; 0: nothing has broken
  base::GlobalId broken = 0;      ///< bonds
  base::GlobalId solves = 0;      ///< of linear systems
  base::GlobalId iterations = 0;  ///< of conjugate gradients
};

/// What a run shows people while it goes on: a line for each accepted increment, progress within one, and a summary.
class Console {
 public:
  /// @param profile must outlive this
  /// @param horizon against which overlaps of crack faces are judged, [length]
  /// @param elapsed what the profile showed when the last increment was accepted, [s]
  Console(ConsoleOptions options, const base::Profile& profile, int last_increment, double horizon, double elapsed);

  /// An accepted increment. Local.
  /// @param newly_broken bonds that broke in it
  void show(const IncrementRecord& record, base::GlobalId newly_broken);

  /// How far the current increment has come. Local.
  /// @param fallbacks of the solver so far; those that are new are reported
  void show_progress(const fracture::LoopPosition& position, const discretization::Counts& counts,
                     const std::vector<std::string>& fallbacks);

  /// Counts, memory, peak and last reactions, profile. Collective.
  void summarize(const base::Comm& comm, const discretization::Counts& counts, const Totals& totals,
                 const std::vector<Reaction>& reactions);

 private:
  ConsoleOptions options_;
  const base::Profile& profile_;
  int last_increment_;
  double horizon_;
  base::Pace pace_;
  double last_accepted_, last_line_;  ///< elapsed then, [s]
  std::size_t shown_reaction_ = 0;    ///< in the lines
  bool has_shown_header_ = false, has_warned_ = false;
  std::size_t n_fallbacks_reported_ = 0;

  void clear_progress() const;
  void show_header(const std::vector<Reaction>& reactions);
  void warn_of_overlap(const IncrementRecord& record);
};

}  // namespace perimorph::output
