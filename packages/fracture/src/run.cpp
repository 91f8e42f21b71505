#include "perimorph/fracture/run.hpp"

#include <Teuchos_XMLParameterListHelpers.hpp>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "balance.hpp"
#include "perimorph/base/errors.hpp"
#include "perimorph/base/temporary_folder.hpp"
#include "perimorph/cases/advice.hpp"
#include "perimorph/cases/problem.hpp"
#include "perimorph/fracture/automatic_seeds.hpp"
#include "perimorph/fracture/run_observer.hpp"
#include "perimorph/input/resolved.hpp"
#include "perimorph/mesh/mesh_report.hpp"
#include "perimorph/model/calibration.hpp"

namespace perimorph::fracture {

using base::GlobalId;

namespace {

/// The names that a run writes to are none of those that it reads.
void check_that_input_is_spared(const cases::Case& input, const std::string& folder) {
  const auto is_result = [&](const std::string& file) {
    std::error_code ignored;
    for (const std::string& name : {std::string("resolved.xml"), input.name + ".e"}) {
      if (std::filesystem::equivalent(std::filesystem::path(folder) / name, file, ignored)) return true;
    }
    return false;
  };
  for (const auto& [file, what] : {std::pair{input.file, "case"}, {input.mesh.file, "mesh"}}) {
    if (!is_result(file)) continue;
    throw base::UserError(
        fmt::format("{}: the results would replace the {}: name another folder with --output", file, what));
  }
}

void make_folder(const base::Comm& comm, const cases::Case& input, const std::string& folder) {
  base::on_all_ranks(comm, [&] {
    if (comm.getRank() != 0) return;
    check_that_input_is_spared(input, folder);
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw base::UserError(fmt::format("{}: the output folder cannot be made: {}", folder, error.message()));
  });
}

void write_resolved(const base::Comm& comm, const cases::Case& input, const std::string& file) {
  base::on_all_ranks(comm, [&] {
    if (comm.getRank() != 0) return;
    std::ofstream stream(file);
    Teuchos::writeParameterListToXmlOStream(input.resolved, stream);
    stream.close();
    if (!stream) throw base::UserError(fmt::format("{}: cannot be written", file));
  });
}

template <int dim>
void describe(const base::Comm& comm, const cases::Case& input, const Problem<dim>& problem,
              const mesh::Mesh<dim>& mesh, const base::Log& log) {
  log->info("{}", input.title.empty() ? input.name : input.title);
  log->info("mesh             {}: {} elements, {} nodes on {} rank{}", input.mesh.file, mesh.n_global_elements,
            mesh.n_global_nodes, comm.getSize(), comm.getSize() == 1 ? "" : "s");
  log->info("micromodulus     tau0 = {:.6g}, l = {:.6g}, horizon = {:.6g}", problem.micromodulus.tau0,
            problem.micromodulus.characteristic_length, problem.micromodulus.horizon);
}

/// Places the seeds that are found by the strain, and calibrates the critical stretch to the elements in all seeds,
/// whose size is returned. Collective.
template <int dim>
double place_and_calibrate(const Teuchos::RCP<const base::Comm>& comm, const mesh::Mesh<dim>& mesh,
                           const cases::Case& input, Problem<dim>& problem, base::Profile& profile,
                           const base::Log& log) {
  place_automatic_seeds(comm, mesh, input.numerical, input.loading.increments, problem, profile, log);
  const double size = model::element_size(*comm, mesh, problem);
  const bool is_calibrated = model::calibrate_to_mesh(problem, input.numerical, size);
  if (std::isinf(problem.critical_stretch)) {
    log->info("fracture         none: neither critical stretch nor fracture energy is given");
  } else {
    log->info("fracture         critical stretch s_crit = {:.6g}, {} fracture energy G_c = {:.6g}",
              problem.critical_stretch, is_calibrated ? "calibrated to the mesh," : "by the integral,",
              problem.fracture_energy);
  }
  return size;
}

/// A computation that cannot go on can be continued by other means.
template <int dim>
void save_what_is_left(Checkpoints<dim>& checkpoints, spdlog::logger& log) {
  try {
    checkpoints.write();
  } catch (const base::ComputationError& error) {
    log.warn("warning: {}", error.what());
  }
}

/// Goes on with one partition of the mesh, as far as it serves; returns whether the run is done.
/// @throws ComputationError if it was asked to stop, and as run_adaptive_loop does.
template <int dim>
bool run_on(const Teuchos::RCP<const base::Comm>& comm, const mesh::Mesh<dim>& mesh, const cases::Case& input,
            const Problem<dim>& problem, const std::string& folder, const Voice& voice, base::Profile& profile,
            Checkpoints<dim>& checkpoints, LoopPosition& position) {
  Body<dim> body(comm, mesh, problem, input.numerical, profile);
  Results<dim> results(comm, input, folder, voice, profile, checkpoints.increment(), checkpoints.results());
  results.add_exports(std::make_unique<Exports<dim>>(comm, mesh, input, folder, checkpoints.increment()));
  checkpoints.restore(body);
  RunObserver<dim> observer(results, checkpoints);
  const LoopLimits limits{input.loading.increments, input.loading.max_damage_iterations,
                          input.loading.max_zone_growths};
  const LoopEnd end = run_adaptive_loop(body, limits, observer, position);
  if (end == LoopEnd::stopped) {
    throw base::ComputationError(fmt::format("{} asked it to stop; --restart goes on after increment {}",
                                             checkpoints.stop_signal(), checkpoints.increment()));
  }
  if (end == LoopEnd::done) results.summarize(body);
  return end == LoopEnd::done;
}

template <int dim>
void run_in(const Teuchos::RCP<const base::Comm>& comm, const cases::Case& input, const std::string& folder, Talk talk,
            Start start) {
  base::Profile profile;
  make_folder(*comm, input, folder);
  base::Log log;
  base::on_all_ranks(*comm, [&] {
    log = base::make_log(*comm, talk == Talk::quiet, folder + "/run.log", start == Start::from_checkpoint);
  });
  try {
    Checkpoints<dim> checkpoints(comm, input, folder, log);
    if (start == Start::from_checkpoint) checkpoints.load();
    write_resolved(*comm, input, folder + "/resolved.xml");
    auto problem = cases::make_problem<dim>(input);
    const auto whole = [&] {
      const auto timer = profile.measure(base::Phase::read);
      auto mesh = cases::read_whole_mesh<dim>(*comm, input, folder);
      checkpoints.identify(mesh);
      checkpoints.expect_costs(expected_costs(mesh, problem, input.numerical.discontinuous));
      return mesh;
    }();
    const auto distribute = [&] {
      const auto timer = profile.measure(base::Phase::read);
      return model::distribute_mesh(*comm, whole, problem, checkpoints.costs());
    };
    auto mesh = distribute();
    describe(*comm, input, problem, mesh, log);
    place_and_calibrate(comm, mesh, input, problem, profile, log);
    const Voice voice{log, talk == Talk::progress && comm->getRank() == 0};
    try {
      LoopPosition position{checkpoints.increment()};
      while (!run_on(comm, mesh, input, problem, folder, voice, profile, checkpoints, position)) mesh = distribute();
    } catch (const base::ComputationError&) {
      save_what_is_left(checkpoints, *log);
      throw;
    }
  } catch (const std::exception& error) {
    log->info("\n{}\n{}", error.what(), profile.table());
    throw;
  }
}

template <int dim>
void check_in(const Teuchos::RCP<const base::Comm>& comm, const cases::Case& input, Talk talk) {
  base::Profile profile;
  const base::TemporaryFolder folder;
  const auto log = base::make_log(*comm, talk == Talk::quiet);
  auto problem = cases::make_problem<dim>(input);
  const auto whole = cases::read_whole_mesh<dim>(*comm, input, folder.path());
  const auto mesh =
      model::distribute_mesh(*comm, whole, problem, expected_costs(whole, problem, input.numerical.discontinuous));
  log->info("{}", input::listing(input.resolved));
  describe(*comm, input, problem, mesh, log);
  if (comm->getRank() == 0) log->info("{}", mesh::describe(whole));

  const double size = place_and_calibrate(comm, mesh, input, problem, profile, log);
  Body<dim> body(comm, mesh, problem, input.numerical, profile);
  body.update_topology();
  const auto model = body.model();
  GlobalId n_bonds = 0;
  std::array<double, 3> elements_of_class{};
  for (int p = 0; p < model.bonds.n_pairs(); ++p) {
    const bool is_counted_here = model.bonds.pair(p).first < mesh.n_owned_elements;
    if (is_counted_here) n_bonds += static_cast<GlobalId>(model.bonds.first_bond(p + 1) - model.bonds.first_bond(p));
  }
  for (int e = 0; e < mesh.n_owned_elements; ++e)
    elements_of_class[static_cast<int>(body.topology().classes()[e])] += 1.;
  std::vector<double> sums(elements_of_class.begin(), elements_of_class.end());
  sums.push_back(base::peak_memory());
  double n_points = 0.;  // with bonds; those on several ranks count on each, as their memory does
  for (int e = 0; e < mesh.n_elements(); ++e) n_points += model.bonds.pairs_of(e).empty() ? 0 : model.points.count(e);
  sums.insert(sums.end(),
              {static_cast<double>(model.bonds.n_bonds()), n_points, static_cast<double>(model.bonds.bytes()),
               static_cast<double>(body.system().bytes_of_operator())});
  base::sum(*comm, sums);
  n_bonds = base::sum(*comm, n_bonds);
  log->info("models           {} FE, {} morphing, {} peridynamic ({} of them discontinuous)", sums[0], sums[1], sums[2],
            body.counts().dgfe_elements);
  log->info("at the start     {} unknowns, {} bonds, {:.2f} GB in all", body.counts().unknowns, n_bonds, sums[3] / 1e9);
  if (sums[4] > 0.) {
    log->info("memory           {:.0f} MB for bonds ({:.1f} bytes each, {:.0f} a point), {:.0f} MB for the operator",
              sums[6] / 1e6, sums[6] / sums[4], 2. * sums[4] / sums[5], sums[7] / 1e6);
  }
  log->info("The zone grows with the cracks, and unknowns, bonds and memory with it.");
  for (const auto& line : cases::advice(input, size)) log->warn("advice: {}: {}", input.file, line);
}

/// Calls an action with the case's dimension as a constant: the one place where it is chosen.
template <class Action>
void with_dimension(const cases::Case& input, Action action) {
  if (input.dimension == 2) action(std::integral_constant<int, 2>());
  if (input.dimension == 3) action(std::integral_constant<int, 3>());
}

}  // namespace

void check(const Teuchos::RCP<const base::Comm>& comm, const cases::Case& input, Talk talk) {
  with_dimension(input, [&](auto dim) { check_in<dim>(comm, input, talk); });
}

void run(const Teuchos::RCP<const base::Comm>& comm, const cases::Case& input, const std::string& folder, Talk talk,
         Start start) {
  with_dimension(input, [&](auto dim) { run_in<dim>(comm, input, folder, talk, start); });
}

}  // namespace perimorph::fracture
