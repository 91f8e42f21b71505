#include "perimorph/fracture/checkpoints.hpp"

#include <chrono>
#include <numeric>
#include <sstream>

#include "balance.hpp"
#include "perimorph/base/errors.hpp"
#include "perimorph/mesh/fingerprint.hpp"

namespace perimorph::fracture {

using base::GlobalId;

namespace {

constexpr GlobalId format = 2;

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

template <class T>
std::vector<T> from_root(const base::Comm& comm, const std::vector<T>& values) {
  return base::gather_on_all(comm, comm.getRank() == 0 ? values : std::vector<T>());
}

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

template <int dim>
void put_body(io::Checkpoint& checkpoint, const SavedState<dim>& state) {
  const auto& counts = state.counts;
  checkpoint.numbers["body"] = {state.load_factor, state.force_scale, state.energies.dissipated,
                                state.energies.external_work};
  checkpoint.integers["body_counts"] = {
      counts.broken_bonds, counts.damaged_elements, counts.dgfe_elements,
      counts.unknowns,     counts.linear_solves,    counts.cg_iterations,
      counts.topologies,   state.break_calls,       state.break_calls_before_topology};
  auto& centroids = checkpoint.numbers["flag_points"];
  auto& flagged = checkpoint.integers["flagged_elements"];
  for (const auto& flag : state.flag_points) {
    centroids.insert(centroids.end(), flag.centroid.begin(), flag.centroid.end());
    flagged.insert(flagged.end(), {flag.element, flag.growth});
  }
}

template <int dim>
SavedState<dim> body_in(const std::vector<double>& numbers, const std::vector<GlobalId>& counts,
                        const std::vector<double>& centroids, const std::vector<GlobalId>& flagged) {
  SavedState<dim> state;
  state.load_factor = numbers.at(0);
  state.force_scale = numbers.at(1);
  state.energies = {0., numbers.at(2), numbers.at(3)};
  state.counts = {counts.at(0), counts.at(1), counts.at(2), counts.at(3), counts.at(4), counts.at(5), counts.at(6)};
  state.break_calls = counts.at(7);
  state.break_calls_before_topology = counts.at(8);
  for (std::size_t i = 0; 2 * i < flagged.size(); ++i) {
    state.flag_points.push_back({flagged[2 * i], flagged[2 * i + 1], {}});
    std::copy_n(centroids.begin() + static_cast<long>(i) * dim, dim, state.flag_points.back().centroid.begin());
  }
  return state;
}

void put_results(io::Checkpoint& checkpoint, const ResultsState& state) {
  checkpoint.numbers["results"] = {state.seconds};
  checkpoint.integers["results_counts"] = {state.series.files, state.series.steps, state.first_break,
                                           state.broken,       state.solves,       state.iterations};
  checkpoint.numbers["peaks"] = state.peaks;
  checkpoint.integers["peak_increments"] = state.peak_increments;
}

ResultsState results_in(const base::Comm& comm, const io::Checkpoint& checkpoint) {
  const auto numbers = [&](const char* name) {
    return from_root(comm, comm.getRank() == 0 ? checkpoint.numbers.at(name) : std::vector<double>());
  };
  const auto integers = [&](const char* name) {
    return from_root(comm, comm.getRank() == 0 ? checkpoint.integers.at(name) : std::vector<GlobalId>());
  };
  const auto counts = integers("results_counts");
  ResultsState state;
  state.seconds = state.seconds_before = numbers("results").at(0);
  state.series = {static_cast<int>(counts.at(0)), static_cast<int>(counts.at(1))};
  state.first_break = static_cast<int>(counts.at(2));
  state.broken = counts.at(3);
  state.solves = counts.at(4);
  state.iterations = counts.at(5);
  state.peaks = numbers("peaks");
  state.peak_increments = integers("peak_increments");
  return state;
}

template <int dim>
std::vector<GlobalId> own_ids(const mesh::Mesh<dim>& mesh) {
  return {mesh.element_ids.begin(), mesh.element_ids.begin() + mesh.n_owned_elements};
}

/// Every rank's elements' values out of those of all elements, which rank 0 has. Collective.
std::vector<double> fetch(const base::Comm& comm, const std::vector<GlobalId>& elements, std::size_t stride,
                          const std::vector<double>& all) {
  std::vector<std::vector<GlobalId>> asked(comm.getSize());
  asked[0] = elements;
  std::vector<std::vector<double>> answers(comm.getSize());
  const auto questions = base::exchange(comm, asked);
  for (std::size_t rank = 0; rank < questions.size(); ++rank) {
    for (const GlobalId element : questions[rank]) {
      const auto values = all.begin() + element * static_cast<GlobalId>(stride);
      answers[rank].insert(answers[rank].end(), values, values + static_cast<GlobalId>(stride));
    }
  }
  return base::exchange(comm, answers)[0];
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
      largest_imbalance_(input.solver.largest_imbalance),
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

template <int dim>
void Checkpoints<dim>::load() {
  base::on_all_ranks(*comm_, [&] {
    if (comm_->getRank() != 0) return;
    start_ = read_newest();
    if (start_.integers.empty()) {
      log_->info("no checkpoint found: starting from the beginning");
      return;
    }
    if (start_.integers["format"] != std::vector<GlobalId>{format}) {
      throw base::UserError("--restart: the checkpoint is of another version of the program");
    }
    if (case_lines_ != start_.texts["case"]) {
      const auto [here, there] = first_difference(case_lines_, start_.texts["case"]);
      throw base::UserError(
          fmt::format("--restart: the checkpoint belongs to another case: there \"{}\", here \"{}\"; "
                      "run without --restart, or name the case's own folder with --output",
                      there, here));
    }
    costs_ = start_.numbers.at("element_costs");
    log_->info("restart          after increment {}, {} broken bonds", start_.integers["increment"].at(0),
               start_.integers["body_counts"].at(0));
  });
  GlobalId loaded = 0;
  if (!start_.integers.empty()) loaded = start_.integers.at("increment").at(0);
  increment_ = static_cast<int>(base::max(*comm_, loaded));
  has_start_ = increment_ > 0;
  if (!has_start_) return;
  results_ = results_in(*comm_, start_);
  is_on_disk_ = true;
}

template <int dim>
void Checkpoints<dim>::identify(const mesh::Mesh<dim>& whole) {
  base::on_all_ranks(*comm_, [&] {
    if (comm_->getRank() != 0) return;
    mesh_identity_ = {whole.n_global_elements, whole.n_global_nodes, mesh::fingerprint(whole)};
    if (increment_ == 0) return;
    const auto& there = start_.integers["mesh"];
    if (there == mesh_identity_) return;
    const bool same_size = there.at(0) == mesh_identity_[0] && there.at(1) == mesh_identity_[1];
    throw base::UserError(fmt::format(
        "--restart: the checkpoint belongs to another mesh: {}; run without --restart, or bring back its mesh",
        same_size ? "as large as this one, but with other coordinates, elements or groups"
                  : fmt::format("there {} elements and {} nodes, here {} and {}", there.at(0), there.at(1),
                                mesh_identity_[0], mesh_identity_[1])));
  });
}

template <int dim>
void Checkpoints<dim>::restore(Body<dim>& body) {
  base::on_all_ranks(*comm_, [&] {
    if (comm_->getRank() == 0) folder_.remove_after(increment_);
  });
  if (!has_start_) return;
  body.restore(body_state_in(start_, body.mesh()));
  start_ = {};
  has_start_ = false;
}

template <int dim>
SavedState<dim> Checkpoints<dim>::body_state_in(const io::Checkpoint& checkpoint, const mesh::Mesh<dim>& mesh) const {
  const bool is_root = comm_->getRank() == 0;
  const auto numbers = [&](const char* name) { return is_root ? checkpoint.numbers.at(name) : std::vector<double>(); };
  const auto integers = [&](const char* name) {
    return from_root(*comm_, is_root ? checkpoint.integers.at(name) : std::vector<GlobalId>());
  };
  auto state = body_in<dim>(from_root(*comm_, numbers("body")), integers("body_counts"),
                            from_root(*comm_, numbers("flag_points")), integers("flagged_elements"));
  const auto broken = integers("broken_bonds");
  for (std::size_t i = 0; i < broken.size(); i += 3) state.broken.push_back({broken[i], broken[i + 1], broken[i + 2]});
  state.displacement = fetch(*comm_, mesh.element_ids, SavedState<dim>::values_per_element, numbers("displacement"));
  return state;
}

template <int dim>
bool Checkpoints<dim>::is_due(int increment) {
  const bool is_time = seconds_ > 0. && now() - last_written_ >= seconds_;  // rank 0 has the clock
  const bool is_by_count = every_ > 0 && increment % every_ == 0;
  const bool is_by_time = base::max(*comm_, static_cast<GlobalId>(comm_->getRank() == 0 && is_time)) > 0;
  return is_by_count || is_by_time || is_asked_ || increment == last_increment_;
}

template <int dim>
void Checkpoints<dim>::accept(int increment, Body<dim>& body, const Results<dim>& results) {
  body_ = body.save();
  own_ids_ = own_ids(body.mesh());
  results_ = results.state();
  costs_then_ = costs_;
  increment_ = increment;
  is_on_disk_ = false;
  if (is_due(increment)) write();
  if (every_ > 0 && increment % every_ == 0) body.forget_solves();
}

/// A new partition is worth its price only if the zone has grown since the last one: what was uneven then cannot be
/// mended.
template <int dim>
bool Checkpoints<dim>::rebalance_wanted(const Body<dim>& body) {
  constexpr double growth = 1.2;
  if (comm_->getSize() == 1 || body.counts().topologies == weighed_topology_) return false;
  weighed_topology_ = body.counts().topologies;
  const auto [total, imbalance] = measure_load(*comm_, body);
  const double before = base::max(*comm_, std::accumulate(costs_.begin(), costs_.end(), 0.));
  if (imbalance <= largest_imbalance_ || total <= growth * before) return false;
  log_->info("partition        anew: one rank has {:.2f} times the mean of the work", imbalance);
  costs_ = element_costs(*comm_, body);
  start_ = gather(body.save(), own_ids(body.mesh()));
  has_start_ = true;
  return true;
}

template <int dim>
bool Checkpoints<dim>::stop_requested() {
  const auto requests = signals_.look(*comm_);
  is_asked_ = is_asked_ || requests.checkpoint;
  stop_signal_ = requests.stop;
  return !stop_signal_.empty();
}

template <int dim>
void Checkpoints<dim>::write() {
  if (increment_ == 0 || is_on_disk_) return;
  auto checkpoint = gather(body_, own_ids_);
  base::on_all_ranks(*comm_, [&] {
    if (comm_->getRank() != 0) return;
    checkpoint.integers["format"] = {format};
    checkpoint.integers["increment"] = {increment_};
    checkpoint.integers["mesh"] = mesh_identity_;
    checkpoint.texts["case"] = case_lines_;
    checkpoint.numbers["element_costs"] = costs_then_;
    put_results(checkpoint, *results_);
    folder_.write(increment_, checkpoint);
  });
  is_on_disk_ = true;
  is_asked_ = false;
  last_written_ = now();
}

/// A body on rank 0. Elements by global id, so that the ranks leave no trace.
template <int dim>
io::Checkpoint Checkpoints<dim>::gather(const SavedState<dim>& state, const std::vector<GlobalId>& elements) const {
  constexpr auto stride = static_cast<std::size_t>(SavedState<dim>::values_per_element);
  const auto broken = base::gather_on_root(*comm_, state.broken);
  const auto ids = base::gather_on_root(*comm_, elements);
  const auto values = base::gather_on_root(*comm_, state.displacement);
  io::Checkpoint checkpoint;
  if (comm_->getRank() != 0) return checkpoint;

  put_body(checkpoint, state);
  auto& displacement = checkpoint.numbers["displacement"];
  displacement.resize(values.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    std::copy_n(values.begin() + static_cast<long>(i * stride), stride,
                displacement.begin() + ids[i] * static_cast<long>(stride));
  }
  auto& bonds = checkpoint.integers["broken_bonds"];
  for (const auto& bond : broken) bonds.insert(bonds.end(), {bond.first, bond.second, bond.call});
  return checkpoint;
}

template class Checkpoints<2>;
template class Checkpoints<3>;

}  // namespace perimorph::fracture
