#include "perimorph/output/checkpoints.hpp"

#include <chrono>
#include <sstream>

#include "data_sets.hpp"
#include "perimorph/base/errors.hpp"
#include "perimorph/mesh/fingerprint.hpp"

namespace perimorph::output {

using base::GlobalId;

namespace {

constexpr GlobalId current_format = 2;
constexpr const char *format_name = "format", *case_name = "case";

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

template <class DataSets, class State>
void describe_results(DataSets& sets, State& results) {
  auto& totals = results.totals;
  sets.numbers("results", results.seconds);
  sets.integers("results_counts", results.series.files, results.series.steps, totals.first_break, totals.broken,
                totals.solves, totals.iterations);
  sets.list("peaks", results.peaks);
  sets.list("peak_increments", results.peak_increments);
}

/// What a checkpoint belongs to, but for the case.
template <class DataSets, class Increment, class Mesh, class Costs>
void describe_origin(DataSets& sets, Increment& increment, Mesh& mesh, Costs& element_costs) {
  sets.integers("increment", increment);
  sets.list("mesh", mesh);
  sets.list("element_costs", element_costs);
}

}  // namespace

template <int dim>
Checkpoints<dim>::Checkpoints(const Teuchos::RCP<const base::Comm>& comm, const cases::Case& input,
                              const std::string& folder, base::Log log)
    : comm_(comm),
      log_(std::move(log)),
      folder_(folder),
      case_lines_(cases::deciding_lines(input)),
      every_(input.output.checkpoint_every),
      last_increment_(input.loading.increments),
      seconds_(60. * input.output.checkpoint_minutes),
      last_written_(now()) {}

/// On rank 0.
template <int dim>
io::Checkpoint Checkpoints<dim>::read_newest() const {
  const auto increments = folder_.increments();
  std::string trouble;
  for (auto newest = increments.rbegin(); newest != increments.rend(); ++newest) {
    try {
      return folder_.read(*newest);
    } catch (const base::UserError& error) {
      log_->warn("warning: {}", error.what());
      trouble = error.what();
    }
  }
  if (!trouble.empty()) throw base::UserError(trouble + ", and so are all others: run without --restart");
  return {};
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
  io::Checkpoint loaded;
  base::on_all_ranks(*comm_, [&] {
    if (comm_->getRank() != 0) return;
    loaded = read_newest();
    if (!loaded.integers.empty()) check_origin(loaded);
  });
  const bool is_found = base::max(*comm_, static_cast<GlobalId>(!loaded.integers.empty())) > 0;
  if (!is_found) {
    log_->info("no checkpoint found: starting from the beginning");
    return {};
  }
  DataSetReader reader(*comm_, loaded);
  describe_origin(reader, increment_, loaded_mesh_, element_costs_);
  if (comm_->getRank() != 0) element_costs_.clear();
  describe_results(reader, results_.emplace());
  results_->seconds_before = results_->seconds;
  is_on_disk_ = true;
  log_->info("restart          after increment {}, {} broken bonds", increment_, results_->totals.broken);
  return loaded;
}

template <int dim>
void Checkpoints<dim>::identify(const mesh::Mesh<dim>& whole) {
  base::on_all_ranks(*comm_, [&] {
    if (comm_->getRank() != 0) return;
    mesh_identity_ = {whole.n_global_elements, whole.n_global_nodes, mesh::fingerprint(whole)};
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
    if (comm_->getRank() == 0) folder_.remove_after(increment_);
  });
}

template <int dim>
bool Checkpoints<dim>::is_due(int increment) const {
  const bool is_time = seconds_ > 0. && now() - last_written_ >= seconds_;  // rank 0 has the clock
  const bool is_by_count = every_ > 0 && increment % every_ == 0;
  const bool is_by_time = base::max(*comm_, static_cast<GlobalId>(comm_->getRank() == 0 && is_time)) > 0;
  return is_by_count || is_by_time || increment == last_increment_;
}

template <int dim>
void Checkpoints<dim>::accept(int increment, fracture::Body<dim>& body, const ResultsState& results,
                              const std::vector<double>& element_costs, bool is_requested) {
  PERIMORPH_ASSERT(increment > increment_, "increment {} after {}", increment, increment_);
  body_ = body.save();
  owned_elements_ = owned_ids(body.mesh());
  results_ = results;
  element_costs_ = element_costs;
  increment_ = increment;
  is_on_disk_ = false;
  if (is_due(increment) || is_requested) write();
  if (every_ > 0 && increment % every_ == 0) body.forget_solves();
}

template <int dim>
void Checkpoints<dim>::write() {
  if (increment_ == 0 || is_on_disk_) return;
  PERIMORPH_ASSERT(results_.has_value(), "increment {} has no results", increment_);
  auto checkpoint = gather_state(*comm_, body_, owned_elements_);
  base::on_all_ranks(*comm_, [&] {
    if (comm_->getRank() != 0) return;
    DataSetWriter writer(checkpoint);
    writer.integers(format_name, current_format);
    checkpoint.texts[case_name] = case_lines_;
    describe_origin(writer, increment_, mesh_identity_, element_costs_);
    describe_results(writer, *results_);
    folder_.write(increment_, checkpoint);
  });
  is_on_disk_ = true;
  last_written_ = now();
}

template class Checkpoints<2>;
template class Checkpoints<3>;

}  // namespace perimorph::output
