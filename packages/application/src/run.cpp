#include "perimorph/application/run.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "outlook.hpp"
#include "perimorph/application/automatic_seeds.hpp"
#include "perimorph/base/errors.hpp"
#include "perimorph/base/sums.hpp"
#include "perimorph/base/temporary_folder.hpp"
#include "perimorph/base/text.hpp"
#include "perimorph/cases/advice.hpp"
#include "perimorph/cases/problem.hpp"
#include "perimorph/input/resolved.hpp"
#include "perimorph/mesh/mesh_report.hpp"
#include "perimorph/model/calibration.hpp"
#include "perimorph/model/refinement.hpp"
#include "perimorph/output/field_series.hpp"
#include "perimorph/output/partition_costs.hpp"
#include "perimorph/output/run_observer.hpp"
#include "preview.hpp"
#include "run_folder.hpp"

namespace perimorph::application {

using base::GlobalId;
using Comm = Teuchos::RCP<const base::Comm>;
using model::Problem;

namespace {

template <int dim>
void describe_fracture(const Problem<dim>& problem, bool is_calibrated, const base::Log& log) {
  const auto describe_one = [&](const std::string& name, const materials::Toughness& toughness) {
    if (!toughness.breaks()) {
      log->info("fracture         {}none: neither critical stretch nor fracture energy is given", name);
      return;
    }
    if (toughness.law.softens()) {
      log->info(
          "fracture         {}bonds soften from a stretch of {:.6g} and break at {:.6g}, fracture energy G_f = {:.6g}",
          name, toughness.law.limit(), toughness.critical_stretch(), toughness.fracture_energy);
      return;
    }
    log->info("fracture         {}critical stretch s_crit = {:.6g}, {} fracture energy G_c = {:.6g}", name,
              toughness.critical_stretch(), is_calibrated ? "calibrated to the mesh," : "by the integral,",
              toughness.fracture_energy);
  };
  for (std::size_t m = 0; m < problem.materials.size(); ++m) {
    describe_one(whose(problem, m), problem.materials[m].toughness);
  }
  for (const auto& [first, second, toughness] : problem.interfaces) {
    describe_one(fmt::format("between {} and {}: ", problem.materials[first].name, problem.materials[second].name),
                 toughness);
  }
}

template <int dim>
void describe(const base::Comm& comm, const cases::Case& input, const Problem<dim>& problem,
              const mesh::Mesh<dim>& mesh, const base::Log& log) {
  log->info("{}", input.title.empty() ? input.name : input.title);
  log->info("mesh             {}: {} elements, {} nodes on {}", input.mesh.file, mesh.n_global_elements,
            mesh.n_global_nodes, base::counted(static_cast<std::size_t>(comm.getSize()), "rank"));
  for (std::size_t m = 0; m < problem.materials.size(); ++m) {
    const auto& [tau0, length, horizon] = problem.materials[m].micromodulus;
    log->info("micromodulus     {}tau0 = {:.6g}, l = {:.6g}, horizon = {:.6g}", whose(problem, m), tau0, length,
              horizon);
  }
}

/// Of names that rank 0 knows.
template <int dim>
void warn_of_names(const mesh::Mesh<dim>& mesh, const cases::Case& input, const base::Log& log) {
  for (const auto& entry : mesh.side_sets) {
    const std::string name = output::name_in_results(entry.first);
    if (name == entry.first) continue;
    warn(log, input,
         {fmt::format(
             "/Mesh/File: the sides of the mesh's group \"{}\" are called \"{}\" in results, where the first is the "
             "surface of cracks",
             entry.first, name)});
  }
}

/// The mesh of a body, refined where the case asks for it: then whole on rank 0. Collective.
/// @param increments in the last of which automatic seeds are found, on the mesh as it is before that
template <int dim>
model::Refinement<dim> refine(const Teuchos::RCP<const base::Comm>& comm, mesh::Mesh<dim> root,
                              const cases::Case& input, int increments, Problem<dim>& problem, base::Profile& profile,
                              const base::Log& log) {
  const bool is_refined = input.numerical.refinement.levels > 0;
  if (is_refined && !problem.automatic_seeds.empty()) {
    const auto mesh = model::distribute_mesh(*comm, root, problem);
    place_automatic_seeds(comm, mesh, input.numerical, increments, problem, profile, log);
  }
  try {
    return {comm, std::move(root), problem, input.numerical};
  } catch (const base::UserError& error) {
    throw base::UserError(fmt::format("{}: /Mesh/Refinement/Levels: {}", input.file, error.what()));
  }
}

template <int dim>
void describe(const model::Refinement<dim>& refinement, const base::Log& log) {
  if (refinement.is_refined()) log->info("refined          {}", refinement.description());
}

template <int dim>
void warn_of(const base::Comm& comm, const cases::Case& input, const model::Refinement<dim>& refinement,
             const base::Log& log) {
  if (comm.getRank() == 0 && refinement.is_refined()) warn(log, input, refinement.warnings());
}

/// Places the seeds that are found by the strain in the last of so many increments, and calibrates the critical stretch
/// to the elements in all seeds; returns what the case would choose better. Collective.
template <int dim>
std::vector<std::string> place_and_calibrate(const Teuchos::RCP<const base::Comm>& comm, const mesh::Mesh<dim>& mesh,
                                             const cases::Case& input, int increments, Problem<dim>& problem,
                                             base::Profile& profile, const base::Log& log) {
  place_automatic_seeds(comm, mesh, input.numerical, increments, problem, profile, log);
  warn_of_seeds_everywhere(*comm, mesh, input, problem, log);
  const double size = model::element_size(*comm, mesh, problem);
  const bool is_calibrated = model::calibrate_to_mesh(problem, input.numerical, size);
  cases::check_compressive_strengths(input, problem);
  describe_fracture(problem, is_calibrated, log);
  auto lines = cases::advice(input, size);
  std::vector<double> stretches;
  for (const auto& material : problem.materials) {
    const auto& law = material.toughness.law;
    stretches.push_back(law.softens() ? std::numeric_limits<double>::infinity() : law.critical_stretch());
  }
  for (auto& line : cases::advice_on_stretches(input, stretches)) lines.push_back(std::move(line));
  return lines;
}

/// What reading the mesh changed, which rank 0 knows.
template <int dim>
void log_notes(const mesh::Mesh<dim>& mesh, const base::Log& log) {
  for (const std::string& note : mesh.notes) log->warn("note: {}", note);
}

/// One run of a case.
template <int dim>
class Run {
 public:
  /// Reads the checkpoint, if there is to be one. The arguments must outlive this. Collective.
  Run(const Comm& comm, const cases::Case& input, RunFolder& folder, output::ConsoleOptions console,
      base::Profile& profile, Start start)
      : comm_(comm),
        input_(input),
        folder_(folder),
        console_(std::move(console)),
        profile_(profile),
        checkpoints_(comm, input, folder.path(), console_.log),
        problem_(cases::make_problem<dim>(input)),
        appends_to_log_(start == Start::from_checkpoint) {
    if (start == Start::from_checkpoint) start_ = checkpoints_.load();
  }

  /// To the last increment, with as many meshes and partitions of them as it takes. Collective.
  void to_the_end() {
    auto refinement =
        refine(comm_, read(), input_, checkpoints_.planned_increments(), problem_, profile_, console_.log);
    return_to_start(refinement);
    const auto& costs = checkpoints_.element_costs();
    output::Rebalancing<dim> rebalancing(comm_, input_.solver.largest_imbalance,
                                         costs ? *costs : expected_costs(refinement), console_.log);
    auto mesh = distribute(refinement.mesh(), rebalancing);
    refinement.free_unrefined();
    describe(*comm_, input_, problem_, mesh, console_.log);
    describe(refinement, console_.log);
    warn_of(*comm_, input_, refinement, console_.log);
    const auto advice =
        place_and_calibrate(comm_, mesh, input_, checkpoints_.planned_increments(), problem_, profile_, console_.log);
    advise(console_.log, input_, advice, spdlog::level::info);
    auto position = checkpoints_.position();
    while (!is_done_on(mesh, refinement, rebalancing, position)) {
      mesh = distribute(refinement.is_refined() ? refinement.mesh() : mesh, rebalancing);
    }
  }

 private:
  Comm comm_;
  const cases::Case& input_;
  RunFolder& folder_;
  output::ConsoleOptions console_;
  base::Profile& profile_;
  output::Checkpoints<dim> checkpoints_;
  output::StopRequests requests_;
  Problem<dim> problem_;
  std::optional<io::Checkpoint> start_;  ///< state from which the next body goes on; none: from the beginning
  bool appends_to_log_, has_taken_over_ = false;

  mesh::Mesh<dim> read() {
    const auto timer = profile_.measure(base::Phase::read);
    auto checked = cases::read_mesh<dim>(*comm_, input_, folder_.for_mesh());
    log_notes(checked.mesh, console_.log);
    warn(console_.log, input_, checked.warnings);
    warn_of_names(checked.mesh, input_, console_.log);
    checkpoints_.identify(checked.mesh);
    return std::move(checked.mesh);
  }

  /// The mesh becomes that of the state from which the next body goes on; none: the first one. Returns whether it was
  /// another.
  bool return_to_start(model::Refinement<dim>& refinement) const {
    using FlagPoints = typename model::Refinement<dim>::FlagPoints;
    if (refinement.calls() == checkpoints_.refinements()) return false;
    refinement.go_to(start_ ? output::share_flag_points<dim>(*comm_, *start_) : FlagPoints(),
                     checkpoints_.refinements());
    return true;
  }

  std::vector<double> expected_costs(const model::Refinement<dim>& refinement) const {
    return output::expected_costs(*comm_, refinement.mesh(), problem_, input_.numerical.discontinuous);
  }

  /// @param part a whole mesh on rank 0, or what the ranks have of it now
  mesh::Mesh<dim> distribute(const mesh::Mesh<dim>& part, const output::Rebalancing<dim>& rebalancing) {
    const auto timer = profile_.measure(base::Phase::read);
    return model::distribute_mesh(*comm_, part, problem_, output::costs_of(*comm_, part, rebalancing.element_costs()));
  }

  /// Goes on with one partition of one mesh, as far as it serves; returns whether the run is done.
  /// @throws ComputationError if it was asked to stop, and as run_adaptive_loop does.
  bool is_done_on(const mesh::Mesh<dim>& mesh, model::Refinement<dim>& refinement,
                  output::Rebalancing<dim>& rebalancing, fracture::LoopPosition& position) {
    std::optional<fracture::Body<dim>> body;
    start_on(mesh, body);
    auto results = open_results(mesh, refinement);
    output::RunObserver<dim> observer(comm_, folder_.lock(), *results, checkpoints_, refinement, rebalancing,
                                      requests_);
    try {
      auto end = run_adaptive_loop(*body, limits(), observer, position);
      for (; end == fracture::LoopEnd::cut; end = run_adaptive_loop(*body, limits(), observer, position)) {
        console_.log->info("cut              step {} again, to load {:.6g}", position.increment + 1,
                           position.step.end());
        start_ = checkpoints_.start_of_increment();
        if (return_to_start(refinement)) {
          rebalancing.set_element_costs(expected_costs(refinement));
          return false;
        }
        start_on(mesh, body);
      }
      if (end == fracture::LoopEnd::refine) refine_after(*body, refinement, rebalancing);
      if (end == fracture::LoopEnd::rebalance) start_ = output::slice_state(*comm_, *body);
      if (end == fracture::LoopEnd::stopped) stop();
      if (end == fracture::LoopEnd::done) results->summarize(*body);
      return end == fracture::LoopEnd::done;
    } catch (const base::ComputationError& error) {
      save_what_is_left([&] { checkpoints_.write(*results); });
      if (dynamic_cast<const fracture::UnfinishedIncrement*>(&error) != nullptr) {
        save_what_is_left([&] { write_unfinished(position.increment + 1, *body, *results); });
      }
      throw;
    }
  }

  /// A new body, in the state from which the run goes on.
  void start_on(const mesh::Mesh<dim>& mesh, std::optional<fracture::Body<dim>>& body) {
    body.emplace(comm_, mesh, problem_, input_.numerical, profile_);
    if (start_) {
      body->restore(output::share_state(*comm_, *start_, mesh));
    } else {  // what is refused is so before the results of an earlier run go
      body->update_topology();
      check_that_bonds_can_break(*comm_, input_, problem_, *body);
    }
    start_.reset();
  }

  /// The mesh follows the body, and the state from which the next one goes on is this one's.
  void refine_after(const fracture::Body<dim>& body, model::Refinement<dim>& refinement,
                    output::Rebalancing<dim>& rebalancing) {
    const auto timer = profile_.measure(base::Phase::adapt);
    const auto state = output::slice_state(*comm_, body);
    const auto descents = follow(refinement, body.state().flag_points);
    start_ = output::refine_state<dim>(*comm_, state, descents);
    const auto costs_before = base::gather_on_root(*comm_, rebalancing.element_costs());
    std::vector<double> costs;
    for (const auto& descent : descents) costs.push_back(costs_before[descent.ancestor]);
    rebalancing.set_element_costs(output::in_slices(*comm_, refinement.mesh(), costs));
    describe(refinement, console_.log);
  }

  /// @throws ComputationError if the zone has come to elements that are not divided
  std::vector<mesh::Descent> follow(model::Refinement<dim>& refinement,
                                    const typename model::Refinement<dim>::FlagPoints& flag_points) const {
    try {
      return refinement.follow(flag_points);
    } catch (const base::UserError& error) {
      throw base::ComputationError(fmt::format("/Mesh/Refinement: {}", error.what()));
    }
  }

  void write_unfinished(int increment, const fracture::Body<dim>& body, output::Results<dim>& results) const {
    const auto file = results.write_unfinished(increment, body);
    console_.log->info("unfinished       increment {}, as it was before it failed: {}", increment, file);
  }

  fracture::LoopLimits limits() const {
    const auto& loading = input_.loading;
    fracture::LoopLimits limits{loading.increments, loading.max_damage_iterations, loading.max_zone_growths};
    if (loading.largest_break) limits.largest_break = *loading.largest_break;
    return limits;
  }

  /// The first time, removes what an earlier run has left: its checkpoints before its results if this run starts over,
  /// so that none counts on results that are gone, and otherwise those after which this run does not go on.
  std::unique_ptr<output::Results<dim>> open_results(const mesh::Mesh<dim>& mesh,
                                                     const model::Refinement<dim>& refinement) {
    const auto& earlier = checkpoints_.results();
    if (!has_taken_over_ && !earlier) checkpoints_.remove_later();
    if (!has_taken_over_) folder_.take_over(appends_to_log_);
    auto results = std::make_unique<output::Results<dim>>(comm_, input_, folder_.path(), console_, profile_, earlier);
    results->add_exports(
        std::make_unique<output::Exports<dim>>(comm_, mesh, input_, folder_.path(), checkpoints_.increment(), earlier));
    if (!has_taken_over_) checkpoints_.remove_later();
    has_taken_over_ = true;
    checkpoints_.begin(results->state(), refinement.calls());
    return results;
  }

  [[noreturn]] void stop() const {
    throw base::ComputationError(fmt::format("{} asked it to stop; --restart goes on after increment {}{}",
                                             requests_.signal(), checkpoints_.increment(),
                                             output::solves_of_the_next(checkpoints_.position())));
  }

  /// A computation that cannot go on can be looked at, and be continued by other means.
  template <class Save>
  void save_what_is_left(Save save) const {
    try {
      save();
    } catch (const base::ComputationError& error) {
      console_.log->warn("warning: {}", error.what());
    }
  }
};

/// Collective.
bool has_checkpoints(const base::Comm& comm, const std::string& folder) {
  const bool has = comm.getRank() == 0 && !io::CheckpointFolder(folder).list().empty();
  return base::max(comm, static_cast<GlobalId>(has)) > 0;
}

template <int dim>
void run_in(const Comm& comm, const cases::Case& input, const std::string& folder, Verbosity verbosity, Start start) {
  base::Profile profile;
  check_solver_parameters(input);
  const auto log = base::make_log(*comm, verbosity == Verbosity::quiet);
  RunFolder run_folder(comm, input, folder, log);
  const bool starts_over = start == Start::at_the_first_increment;
  if (starts_over && !has_checkpoints(*comm, folder)) run_folder.open_log(false);
  try {
    const bool shows_progress = verbosity == Verbosity::progress && comm->getRank() == 0;
    Run<dim> run(comm, input, run_folder, {log, shows_progress}, profile, start);
    run.to_the_end();
  } catch (const std::exception& error) {
    log->info("\n{}\n{}", error.what(), profile.table());
    throw;
  }
}

/// What a body holds before the first increment.
struct InitialSizes {
  std::array<double, 3> elements_of_class{};
  GlobalId bonds = 0;  ///< each once
  // Summed over the ranks as they are held: what several have counts several times.
  double bonds_held = 0., bonded_points = 0., bytes = 0., bytes_of_bonds = 0., bytes_of_operator = 0.;
};

/// Collective.
template <int dim>
InitialSizes sizes_of(const base::Comm& comm, const fracture::Body<dim>& body) {
  const auto& mesh = body.mesh();
  const auto model = body.model();
  InitialSizes sizes;
  for (int p = 0; p < model.bonds.n_pairs(); ++p) {
    const auto [first, second] = model.bonds.pair(p);
    if (first >= mesh.n_owned_elements) continue;
    if (mesh.is_image(second)) {
      model.bonds.for_each_bond(p, [&](const auto& bond) { sizes.bonds += model.bonds.counts_here(bond); });
    } else {
      sizes.bonds += static_cast<GlobalId>(model.bonds.first_bond(p + 1) - model.bonds.first_bond(p));
    }
  }
  for (int e = 0; e < mesh.n_owned_elements; ++e) {
    sizes.elements_of_class[static_cast<int>(body.topology().classes()[e])] += 1.;
  }
  for (int e = 0; e < mesh.n_elements(); ++e) {
    sizes.bonded_points += model.bonds.pairs_of(e).empty() ? 0 : model.points.count(e);
  }
  sizes.bonds_held = static_cast<double>(model.bonds.n_bonds());
  sizes.bytes = base::peak_memory();
  sizes.bytes_of_bonds = static_cast<double>(model.bonds.bytes());
  sizes.bytes_of_operator = static_cast<double>(body.system().bytes_of_operator());
  std::vector<double*> sums = {&sizes.bonds_held, &sizes.bonded_points, &sizes.bytes, &sizes.bytes_of_bonds,
                               &sizes.bytes_of_operator};
  for (double& count : sizes.elements_of_class) sums.push_back(&count);
  base::sum(comm, sums);
  sizes.bonds = base::sum(comm, sizes.bonds);
  return sizes;
}

template <int dim>
void describe_sizes(const base::Comm& comm, const fracture::Body<dim>& body, spdlog::logger& log) {
  const auto sizes = sizes_of(comm, body);
  const auto of = [&](morphing::ElementClass which) { return sizes.elements_of_class[static_cast<int>(which)]; };
  using morphing::ElementClass;
  log.info("models           {} FE, {} morphing, {} peridynamic ({} of them discontinuous)", of(ElementClass::fe),
           of(ElementClass::morph), of(ElementClass::pd), body.counts().dgfe_elements);
  log.info("at the start     {} unknowns, {} bonds, {:.2f} GB in all", body.counts().unknowns, sizes.bonds,
           sizes.bytes / 1e9);
  if (sizes.bonds_held > 0.) {
    log.info("memory           {:.0f} MB for bonds ({:.1f} bytes each, {:.0f} a point), {:.0f} MB for the operator",
             sizes.bytes_of_bonds / 1e6, sizes.bytes_of_bonds / sizes.bonds_held,
             2. * sizes.bonds_held / sizes.bonded_points, sizes.bytes_of_operator / 1e6);
  }
  log.info("The zone grows with the cracks, and unknowns, bonds and memory with it.");
}

template <int dim>
void check_in(const Comm& comm, const cases::Case& input, Verbosity verbosity, const std::string& preview) {
  base::Profile profile;
  check_solver_parameters(input);
  if (!preview.empty()) make_preview_folder(*comm, preview);
  const base::TemporaryFolder folder;
  const auto log = base::make_log(*comm, verbosity == Verbosity::quiet);
  auto problem = cases::make_problem<dim>(input);
  auto [root, warnings] = cases::read_whole_mesh<dim>(*comm, input, folder.path());
  log->info("{}", input::listing(input.resolved));
  const auto refinement = refine(comm, std::move(root), input, input.loading.increments, problem, profile, log);
  const auto& whole = refinement.mesh();
  const auto costs = output::expected_costs(*comm, whole, problem, input.numerical.discontinuous);
  const auto mesh = model::distribute_mesh(*comm, whole, problem, output::costs_of(*comm, whole, costs));
  describe(*comm, input, problem, mesh, log);
  describe(refinement, log);
  warn_of(*comm, input, refinement, log);
  if (mesh_files::is_geometry(input.mesh.file)) {
    log->info("geometry         a program that gmsh runs; commands and writing files are {} (--allow-shell)",
              input.mesh.meshing.side_effects == mesh_files::SideEffects::allowed ? "allowed" : "refused");
  }
  if (comm->getRank() == 0) log->info("{}", mesh::describe(whole));
  log_notes(whole, log);
  warn(log, input, warnings);
  warn_of_names(whole, input, log);

  const auto advice = place_and_calibrate(comm, mesh, input, input.loading.increments, problem, profile, log);
  advise(log, input, advice, spdlog::level::warn);
  fracture::Body<dim> body(comm, mesh, problem, input.numerical, profile);
  body.update_topology();
  check_that_bonds_can_break(*comm, input, problem, body);
  if (!preview.empty()) {
    write_preview(comm, input, problem, body, model::element_size(*comm, mesh, problem), preview);
  }
  describe_sizes(*comm, body, *log);
  describe_first_break(*comm, input, problem, body, log);
}

/// Calls an action with the case's dimension as a constant: the one place where it is chosen.
template <class Action>
void with_dimension(const cases::Case& input, Action action) {
  if (input.dimension == 2) action(std::integral_constant<int, 2>());
  if (input.dimension == 3) action(std::integral_constant<int, 3>());
}

}  // namespace

void check(const Teuchos::RCP<const base::Comm>& comm, const cases::Case& input, Verbosity verbosity,
           const std::string& preview) {
  with_dimension(input, [&](auto dim) { check_in<dim>(comm, input, verbosity, preview); });
}

void run(const Teuchos::RCP<const base::Comm>& comm, const cases::Case& input, const std::string& folder,
         Verbosity verbosity, Start start) {
  with_dimension(input, [&](auto dim) { run_in<dim>(comm, input, folder, verbosity, start); });
}

}  // namespace perimorph::application
