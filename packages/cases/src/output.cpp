#include "perimorph/cases/output.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <set>

namespace perimorph::cases {

namespace {

void declare_probe(const input::Section& section, Probe& probe) {
  using namespace input;
  section.required("Points", probe.points, {0., 0., 10., 0.}, numbers("{x1, y1, x2, y2, ...}"),
                   "A point, or the corners of a line {x1, y1, x2, y2, ...} [length]. On a side that elements share, "
                   "the values are those of the element with the lowest number.");
  section.parameter("Divisions", probe.divisions, count(),
                    "Into how many equal parts each segment between a point and the next is divided; there is a place "
                    "at every end of a part. 1 is the points themselves.");
}

void check_probe(const input::Values& probe, int dimension) {
  constexpr std::int64_t most_places = 1'000'000;
  const auto* points = probe.numbers("Points");
  if (points == nullptr) return;
  if (points->empty() || points->size() % dimension != 0) {
    probe.mistake("Points", fmt::format("found {} numbers; allowed are one point or more, {} numbers each",
                                        points->size(), dimension));
    return;
  }
  const int* divisions = probe.count("Divisions");
  const std::int64_t n_segments = points->size() / dimension - 1;
  if (divisions == nullptr || n_segments * *divisions < most_places) return;
  probe.mistake("Divisions",
                fmt::format("found {}; allowed are less than {} places in one probe", *divisions, most_places));
}

void check_reactions(const input::Values& output) {
  const auto* groups = output.texts("Reactions");
  if (groups == nullptr) return;
  std::set<std::string> seen;
  for (const auto& group : *groups) {
    if (seen.insert(group).second) continue;
    output.mistake("Reactions", fmt::format("found {} twice; allowed is each group once", input::in_quotes(group)));
  }
}

}  // namespace

void declare(const input::Section& section, Output& output) {
  using namespace input;
  const Section changeable = section.changeable();
  changeable.parameter(
      "Every", output.every, count(),
      "Increments from one output of the fields to the next; increments in which bonds break, and the last "
      "one, are written anyway. 1 shows everything and may fill the disk in large runs.");
  changeable.parameter("Spread Files", output.spread_files, flag(),
                       "Whether each process writes the fields of its own elements, to case.e.N.0 up to case.e.N.<N-1> "
                       "on N processes, instead of one that gathers and writes all. For bodies that do not fit into "
                       "the memory of one; tools/join makes one file of them.");
  changeable.parameter(
      "Checkpoint Every", output.checkpoint_every, whole_number(),
      "Increments from one checkpoint to the next; 0 is never. The run goes on from each of them as one that "
      "is continued with --restart: on the same number of processes with the same bits. It takes a "
      "second per million elements and a set-up of the preconditioner.");
  changeable.parameter(
      "Checkpoint Minutes", output.checkpoint_minutes, at_least(0.),
      "Age of the last checkpoint, in minutes, at which the next one is written, also in the middle of a long "
      "increment; 0 is never. The end of the run, an error with status 3, SIGTERM, SIGINT and SIGUSR1 write one "
      "anyway. "
      "With Checkpoint Every, checkpoints within an increment are taken after every twentieth solve, and the "
      "preconditioner is then set up again (not if this is 0). The last two are kept.");
  section.parameter("Reactions", output.reactions, names("a list of groups such as {left, right}"),
                    "Groups whose reaction force is recorded in history.csv; {} means each group with a prescribed "
                    "displacement, and each rigid group, for which the moment about its "
                    "centre and the rotation are recorded, too.");
  section.parameter(
      "Crack", output.records_crack, flag(),
      "Whether the crack is recorded: in crack.csv its length for each increment, in crack_path.csv the sides of "
      "elements that open in it. A side is open when more than half of the bonds between its two elements are broken. "
      "The length is that of the open sides, and also of these projected onto the mean line of all open sides within a "
      "horizon, which takes out the stairs of a slanting crack. Pre-cracks do not count.");
  changeable.parameter("Bonds", output.bond_increments, increments("a list of increments such as {10, 20}"),
                       "Increments after which all bonds are written, to bonds-<increment>.vtp for ParaView: "
                       "positions, stretch, broken or not. 60 bytes for each bond.");
  section.entries("Probes", output.probes, declare_probe,
                  "Points and lines at which displacement and stress are recorded in probes.csv, each a list with a "
                  "name of your choice: a row for each increment and place.",
                  "One probe. All its places must be in the body.");
}

void check_output(const input::Values& section, int dimension) {
  check_reactions(section);
  for (const auto& probe : section.subs("Probes")) check_probe(probe, dimension);
}

}  // namespace perimorph::cases
