#include "perimorph/output/checkpoints.hpp"

#include <Teuchos_DefaultSerialComm.hpp>
#include <chrono>
#include <sstream>

#include "data_sets.hpp"
#include "perimorph/base/errors.hpp"
#include "perimorph/mesh/fingerprint.hpp"

namespace perimorph::output {

using base::GlobalId;

namespace {

constexpr GlobalId current_format = 8;
constexpr int solves_between = 20;  // states within an increment from which it goes on to the last bit
constexpr const char *format_name = "format", *case_name = "case", *costs_name = "element_costs";

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// The first line that only one of two texts has, from each: the same ones if there is none.
std::pair<std::string, std::string> first_difference(const std::string& one, const std::string& other) {
  std::istringstream a(one), b(other);
  std::string line_a, line_b;
  while (a || b) {
    if (!std::getline(a, line_a)) line_a.clear();
    if (!std::getline(b, line_b)) line_b.clear();
    if (line_a != line_b) break;
  }
  return {line_a, line_b};
}

template <class DataSets, class Files>
void describe_files(DataSets& sets, Files& files, const char* name, const char* name_of_names) {
  sets.records(name, files, &io::FileExtent::size, &io::FileExtent::checksum);
  sets.texts(name_of_names, files, &io::FileExtent::name);
}

template <class DataSets, class State>
void describe_results(DataSets& sets, State& results) {
  auto& totals = results.totals;
  sets.numbers("results", results.seconds);
  sets.integers("results_counts", results.series.files, results.series.steps, totals.first_break, totals.broken,
                totals.solves, totals.iterations);
  sets.list("peaks", results.peaks);
  sets.list("peak_increments", results.peak_increments);
  describe_files(sets, results.tables, "tables", "table_names");
  describe_files(sets, results.fields, "field_files", "field_file_names");
  describe_files(sets, results.bonds, "bond_files", "bond_file_names");
}

/// What a checkpoint belongs to, but for the case.
template <class DataSets, class Position, class Increments, class Mesh>
void describe_origin(DataSets& sets, Position& position, Increments& planned_increments, Mesh& mesh,
                     Mesh& refinements) {
  sets.integers("increment", position.increment, position.growths, position.damage_iterations, position.is_solved,
                position.accuracy, position.broken_before);
  sets.numbers("load_step", position.step.begin, position.step.size);
  sets.integers("planned_increments", planned_increments);
  sets.list("mesh", mesh);
  sets.list("refinements", refinements);
}

io::CheckpointId id_of(const fracture::LoopPosition& position) {
  return {position.increment, position.damage_iterations};
}

}  // namespace

std::string solves_of_the_next(const fracture::LoopPosition& position) {
  return position.damage_iterations == 0 ? "" : fmt::format(", and {} solves of the next", position.damage_iterations);
}

template <int dim>
Checkpoints<dim>::Checkpoints(const Teuchos::RCP<const base::Comm>& comm, const cases::Case& input,
                              const std::string& folder, base::Log log)
    : comm_(comm),
      log_(std::move(log)),
      folder_(folder),
      case_lines_(cases::deciding_lines(input)),
      every_(input.output.checkpoint_every),
      last_increment_(input.loading.increments),
      planned_increments_(input.loading.increments),
      seconds_(60. * input.output.checkpoint_minutes),
      last_remembered_(now()),
      last_written_(last_remembered_) {}

/// Why the run cannot go on from one that has been read; "" if it can. On rank 0.
template <int dim>
std::string Checkpoints<dim>::trouble_with(const io::Checkpoint& checkpoint, io::CheckpointId id) const {
  check_origin(checkpoint);
  const Teuchos::SerialComm<int> alone;
  DataSetReader reader(alone, checkpoint);
  ResultsState results;
  describe_results(reader, results);
  for (const auto& file : files_of(results)) {
    const auto trouble = io::trouble_with(folder_.path(), file);
    if (trouble.empty()) continue;
    return fmt::format("{}/{}: it cannot be continued: it {}: {} is of no use without it", folder_.path(), file.name,
                       trouble, folder_.file(id));
  }
  return "";
}

/// Reads one; returns it, or why the run cannot go on from it. Collective.
template <int dim>
std::variant<io::Checkpoint, std::string> Checkpoints<dim>::try_to_read(io::CheckpointId id) const {
  io::Checkpoint checkpoint;
  try {
    checkpoint = folder_.read(*comm_, id);
  } catch (const base::UserError& error) {
    return error.what();
  }
  std::string trouble;
  base::on_all_ranks(*comm_, [&] {
    if (comm_->getRank() == 0) trouble = trouble_with(checkpoint, id);
  });
  trouble = base::broadcast(*comm_, trouble);
  if (!trouble.empty()) return trouble;
  return checkpoint;
}

/// Collective.
template <int dim>
std::optional<io::Checkpoint> Checkpoints<dim>::read_newest() const {
  std::vector<io::CheckpointId> all;
  base::on_all_ranks(*comm_, [&] {
    if (comm_->getRank() == 0) all = folder_.list();
  });
  all = base::gather_on_all(*comm_, all);
  std::string trouble;
  for (auto newest = all.rbegin(); newest != all.rend(); ++newest) {
    auto found = try_to_read(*newest);
    if (auto* checkpoint = std::get_if<io::Checkpoint>(&found)) return std::move(*checkpoint);
    trouble = std::get<std::string>(found);
    log_->warn("warning: {}", trouble);
  }
  if (trouble.empty()) return {};
  throw base::UserError(trouble + ", and so are all others: run without --restart");
}

/// On rank 0.
template <int dim>
void Checkpoints<dim>::check_origin(const io::Checkpoint& checkpoint) const {
  const auto format = checkpoint.integers.find(format_name);
  if (format == checkpoint.integers.end() || format->second != std::vector<GlobalId>{current_format}) {
    throw base::UserError("--restart: the checkpoint is of another version of the program");
  }
  const auto& case_there = checkpoint.texts.at(case_name);
  if (case_lines_ == case_there) return;
  const auto [here, there] = first_difference(case_lines_, case_there);
  throw base::UserError(
      fmt::format("--restart: the checkpoint belongs to another case: there \"{}\", here \"{}\"; "
                  "run without --restart, or name the case's own folder with --output",
                  there, here));
}

template <int dim>
std::optional<io::Checkpoint> Checkpoints<dim>::load() {
  auto loaded = read_newest();
  if (!loaded) {
    log_->info("no checkpoint found: starting from the beginning");
    return {};
  }
  DataSetReader reader(*comm_, *loaded);
  describe_origin(reader, position_, planned_increments_, loaded_mesh_, refinements_);
  element_costs_ = loaded->number_rows.at(costs_name).values;
  describe_results(reader, results_.emplace());
  results_->seconds_before = results_->seconds;
  log_->info("restart          after increment {}, {} broken bonds{}", position_.increment, results_->totals.broken,
             solves_of_the_next(position_));
  loaded_ = loaded;
  return loaded;
}

template <int dim>
std::optional<io::Checkpoint> Checkpoints<dim>::start_of_increment() const {
  if (loaded_ || position_.increment == 0) return loaded_;
  return slice_state(*comm_, body_, owned_elements_);
}

template <int dim>
void Checkpoints<dim>::identify(const mesh::Mesh<dim>& part) {
  const auto fingerprint = mesh::fingerprint(*comm_, part);
  base::on_all_ranks(*comm_, [&] {
    if (comm_->getRank() != 0) return;
    mesh_identity_ = {part.n_global_elements, part.n_global_nodes, fingerprint};
    if (loaded_mesh_.empty() || loaded_mesh_ == mesh_identity_) return;
    const auto size = [](const std::vector<GlobalId>& mesh) { return std::pair(mesh.at(0), mesh.at(1)); };
    const auto here = size(mesh_identity_), there = size(loaded_mesh_);
    throw base::UserError(fmt::format(
        "--restart: the checkpoint belongs to another mesh: {}; run without --restart, or bring back its mesh",
        here == there ? "as large as this one, but with other coordinates, elements or groups"
                      : fmt::format("there {} elements and {} nodes, here {} and {}", there.first, there.second,
                                    here.first, here.second)));
  });
}

template <int dim>
void Checkpoints<dim>::remove_later() const {
  base::on_all_ranks(*comm_, [&] {
    if (comm_->getRank() == 0) folder_.remove_after(id_of(position_));
  });
}

/// Whether so many seconds have passed since then. The same on all ranks: rank 0 has the clock.
template <int dim>
bool Checkpoints<dim>::have_passed(double seconds, double since) const {
  const bool is_late = comm_->getRank() == 0 && now() - since >= seconds;
  return base::max(*comm_, static_cast<GlobalId>(is_late)) > 0;
}

template <int dim>
bool Checkpoints<dim>::is_time() const {
  return seconds_ > 0. && have_passed(seconds_, last_written_);
}

/// Whether the way from what is remembered to this position would take some time once more.
template <int dim>
bool Checkpoints<dim>::is_worthwhile(const fracture::LoopPosition& position) const {
  constexpr int some_solves = 10;
  constexpr double some_seconds = 5.;
  const int before = position.increment == position_.increment ? position_.damage_iterations : 0;
  return position.damage_iterations - before >= some_solves || have_passed(some_seconds, last_remembered_);
}

template <int dim>
void Checkpoints<dim>::remember(const fracture::LoopPosition& position, const fracture::Body<dim>& body,
                                const std::vector<double>& element_costs) {
  loaded_.reset();
  element_costs_ = element_costs;
  refinements_ = refinements_of_mesh_;
  body_ = body.save();
  owned_elements_ = owned_ids(body.mesh());
  last_remembered_ = now();
  position_ = position;
  is_on_disk_ = false;
}

template <int dim>
void Checkpoints<dim>::accept(const fracture::LoopPosition& position, fracture::Body<dim>& body, Results<dim>& results,
                              const std::vector<double>& element_costs, bool is_requested) {
  const int increment = position.increment;
  PERIMORPH_ASSERT(increment > position_.increment, "increment {} after {}", increment, position_.increment);
  remember(position, body, element_costs);
  results_ = results.state();
  remembered_seconds_ = results_->seconds;
  const bool is_by_count = every_ > 0 && increment % every_ == 0;
  const bool is_due = is_by_count || position.step.begin >= last_increment_ || is_requested;
  if (is_time() || is_due) write(results);
  if (is_by_count) body.forget_solves();
}

template <int dim>
void Checkpoints<dim>::solved(const fracture::LoopPosition& position, fracture::Body<dim>& body, Results<dim>& results,
                              const std::vector<double>& element_costs, bool is_needed, bool is_requested) {
  const bool is_due = is_time() || is_requested;
  const bool is_exact = every_ > 0;
  const bool is_kept = !position.may_be_cut && (is_exact ? position.damage_iterations % solves_between == 0
                                                         : (is_due || is_needed) && is_worthwhile(position));
  if (is_kept && !(id_of(position) == id_of(position_))) {
    remember(position, body, element_costs);
    remembered_seconds_ = results.state().seconds;
  }
  if (is_kept && is_exact) {
    body.forget_solves();
    body.renew_forces();
  }
  if (is_due) write(results);
}

/// On rank 0: what was removed or cut while the run went on would be missed by the next one.
template <int dim>
void Checkpoints<dim>::check_results() const {
  for (const auto& file : files_of(*results_)) {
    const auto trouble = io::trouble_with(folder_.path(), {file.name, file.size});
    if (trouble.empty()) continue;
    throw base::ComputationError(fmt::format("{}/{}: it {}: something else has changed it while the run went on",
                                             folder_.path(), file.name, trouble));
  }
}

template <int dim>
void Checkpoints<dim>::write(Results<dim>& results) {
  if (is_on_disk_) return;
  PERIMORPH_ASSERT(results_.has_value(), "increment {} has no results", position_.increment);
  results.bring_to_disk();
  auto checkpoint = slice_state(*comm_, body_, owned_elements_);
  checkpoint.number_rows[costs_name] = {1, element_costs_.value()};
  base::on_all_ranks(*comm_, [&] {
    if (comm_->getRank() != 0) return;
    check_results();
    DataSetWriter writer(checkpoint);
    writer.integers(format_name, current_format);
    checkpoint.texts[case_name] = case_lines_;
    describe_origin(writer, position_, planned_increments_, mesh_identity_, refinements_);
    auto at_position = *results_;
    at_position.seconds = remembered_seconds_;
    describe_results(writer, at_position);
  });
  folder_.write(*comm_, id_of(position_), checkpoint);
  is_on_disk_ = true;
  last_written_ = now();
}

template class Checkpoints<2>;
template class Checkpoints<3>;

}  // namespace perimorph::output
