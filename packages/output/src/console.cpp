#include "perimorph/output/console.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "perimorph/base/errors.hpp"

namespace perimorph::output {

Console::Console(ConsoleOptions options, const base::Profile& profile, int last_increment, double horizon,
                 double elapsed)
    : options_(std::move(options)),
      profile_(profile),
      last_increment_(last_increment),
      horizon_(horizon),
      last_accepted_(elapsed),
      last_line_(elapsed) {
  PERIMORPH_ASSERT(last_increment >= 1 && horizon > 0., "{} increments, a horizon of {}", last_increment, horizon);
}

void Console::clear_progress() const {
  if (options_.shows_progress) fmt::print("\r\033[K");
}

/// Chooses the reaction that the lines show, too: the one that is the largest at first.
void Console::show_header(const std::vector<Reaction>& reactions) {
  const auto* largest = largest_force(reactions);
  shown_reaction_ = largest == nullptr ? 0 : largest - reactions.data();
  const std::string column = largest == nullptr ? "" : largest->column;
  options_.log->info("{:>6} {:>9} {:>22} {:>12} {:>12} {:>8} {:>10} {:>7} {:>6} {:>9}", "step", "load",
                     "reaction " + column, "new broken", "all broken", "DGFE", "unknowns", "solves", "its", "seconds");
  has_shown_header_ = true;
}

void Console::show(const IncrementRecord& record, base::GlobalId newly_broken) {
  clear_progress();
  if (!has_shown_header_) show_header(record.reactions);
  const auto& counts = record.counts;
  const double elapsed = profile_.elapsed();
  options_.log->info("{:>6} {:>9.4g} {:>22.6g} {:>12} {:>12} {:>8} {:>10} {:>7} {:>6} {:>9.2f}", record.increment,
                     record.load_factor, record.reactions.empty() ? 0. : record.reactions[shown_reaction_].force,
                     newly_broken, counts.broken_bonds, counts.dgfe_elements, counts.unknowns, counts.linear_solves,
                     counts.cg_iterations, elapsed - last_accepted_);
  warn_of_overlap(record);
  if (record.increment > 1) pace_.add(elapsed - last_accepted_);
  last_accepted_ = last_line_ = elapsed;
}

/// Once, as soon as it is more than the solver's tolerance can be.
void Console::warn_of_overlap(const IncrementRecord& record) {
  constexpr double of_horizon = 1e-3;
  if (has_warned_ || record.overlap <= of_horizon * horizon_) return;
  has_warned_ = true;
  options_.log->warn(
      "warning: crack faces overlap, by {:.3g} at ({:.6g}): see overlap in history.csv; /Peridynamics/Crack Faces says "
      "where they press on each other",
      record.overlap, fmt::join(record.overlap_place, ", "));
}

void Console::show_progress(const fracture::LoopPosition& position, const discretization::Counts& counts,
                            const std::vector<std::string>& fallbacks) {
  constexpr double patience = 60.;  // seconds without a line
  const int increment = position.increment + 1;
  const double elapsed = profile_.elapsed();
  for (; n_fallbacks_reported_ < fallbacks.size(); ++n_fallbacks_reported_) {
    clear_progress();
    options_.log->warn("warning: increment {}: /Solver: {}", increment, fallbacks[n_fallbacks_reported_]);
  }
  if (elapsed - last_line_ > patience) {
    last_line_ = elapsed;
    options_.log->info("       in step {}: {} solves, {} broken bonds, {} discontinuous elements, {:.0f} s", increment,
                       counts.linear_solves, counts.broken_bonds, counts.dgfe_elements, elapsed);
  }
  if (!options_.shows_progress) return;
  constexpr int width = 30;
  const auto [begin, size] = position.step;
  const int done = static_cast<int>(width * begin / last_increment_);
  const int n_left = static_cast<int>(std::ceil((last_increment_ - begin) / size));
  const double left = pace_.left(n_left, elapsed - last_accepted_);
  fmt::print("\r\033[K[{:=>{}}{:>{}}] step {}/{}: {} solves, {} broken bonds{}", ">", done + 1, "", width - done,
             position.step.end(), last_increment_, counts.linear_solves, counts.broken_bonds,
             increment > 2 ? fmt::format(", at this pace {} left", base::duration(left)) : "");
  std::fflush(stdout);
}

void Console::summarize(const base::Comm& comm, const discretization::Counts& counts, const Totals& totals,
                        const std::vector<Reaction>& reactions) {
  clear_progress();
  options_.log->info("");
  options_.log->info("broken bonds     {}{}", counts.broken_bonds,
                     totals.first_break > 0 ? fmt::format(", the first in step {}", totals.first_break) : "");
  options_.log->info("damaged elements {}, discontinuous {}", counts.damaged_elements, counts.dgfe_elements);
  options_.log->info("linear solves    {} with {} iterations; {} topologies", totals.solves, totals.iterations,
                     counts.topologies);
  const double memory = base::peak_memory();
  options_.log->info("memory           {:.0f} MB in all, {:.0f} MB on the rank with most",
                     base::sum(comm, memory) / 1e6, base::max(comm, memory) / 1e6);
  constexpr double negligible = 1e-5;  // of the largest: rounding, and what the solver tolerates
  double largest = 0.;
  for (const auto& r : reactions) largest = std::max(largest, std::abs(r.peak));
  for (const auto& r : reactions) {
    if (std::abs(r.peak) > negligible * largest) {
      options_.log->info("reaction {:<24} peak {:>12.6g} in step {}, last {:>12.6g}", r.column, r.peak,
                         r.peak_increment, r.force);
    }
  }
  options_.log->info("\n{}", profile_.table());
}

}  // namespace perimorph::output
