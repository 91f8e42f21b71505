// perimorph run | check | params: the command line. The adaptive loop is in packages/fracture/src/adaptive_loop.cpp.

#include <sys/prctl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <Tpetra_Core.hpp>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>

#include "perimorph/application/run.hpp"
#include "perimorph/base/consensus.hpp"
#include "perimorph/base/errors.hpp"
#include "perimorph/base/text.hpp"
#include "perimorph/cases/case.hpp"
#include "perimorph/cases/reference.hpp"

namespace {

using namespace perimorph;

struct Arguments {
  std::string case_file, output, preview;
  std::vector<std::string> overrides;
  bool quiet = false, no_progress = false, restart = false, allow_shell = false;
  bool markdown = false, relax_ng = false;

  application::Verbosity verbosity() const {
    if (quiet) return application::Verbosity::quiet;
    return no_progress || isatty(STDOUT_FILENO) == 0 ? application::Verbosity::lines : application::Verbosity::progress;
  }
  mesh_files::SideEffects side_effects() const {
    return allow_shell ? mesh_files::SideEffects::allowed : mesh_files::SideEffects::refused;
  }
  application::Start start() const {
    return restart ? application::Start::from_checkpoint : application::Start::at_the_first_increment;
  }
};

/// Every rank reads it; a mistake in it is an error on all ranks.
cases::Case read_case(const base::Comm& comm, const Arguments& arguments) {
  cases::Case input;
  for (const bool is_first : {true, false}) {  // it reports the mistakes, for which it may have to read the mesh
    base::on_all_ranks(comm, [&] {
      if (is_first != (comm.getRank() == 0)) return;
      input = cases::read_case(arguments.case_file, arguments.overrides, arguments.side_effects());
    });
  }
  return input;
}

/// What is wrong with a name; nothing if it is one.
std::string check_name(const std::string& text) { return text.empty() ? "found \"\"; allowed is a name" : ""; }

void add_case_options(CLI::App& command, Arguments& arguments) {
  command.add_option("case", arguments.case_file, "Case file (XML)")->required();
  command.add_option("--set", arguments.overrides, "Override a parameter: \"Section/Sub/Name=value\"")
      ->allow_extra_args(false);
  command.add_flag("--quiet", arguments.quiet, "Print warnings and errors only");
  command.add_flag("--allow-shell", arguments.allow_shell,
                   "Let the mesh's geometry (.geo) run commands and write files, which is refused otherwise");
}

std::string description_of_parameters(const Arguments& arguments) {
  if (arguments.markdown) return cases::describe_schema_in_markdown();
  return arguments.relax_ng ? cases::describe_schema_in_relax_ng() : cases::describe_schema();
}

/// What the command line asks for. Collective.
void carry_out(const Teuchos::RCP<const base::Comm>& comm, const std::string& command, const Arguments& arguments) {
  if (command == "params") {
    if (comm->getRank() == 0) std::fputs(description_of_parameters(arguments).c_str(), stdout);
    return;
  }
  const cases::Case input = read_case(*comm, arguments);
  if (command == "check") return application::check(comm, input, arguments.verbosity(), arguments.preview);
  application::run(comm, input, arguments.output.empty() ? "results/" + input.name : arguments.output,
                   arguments.verbosity(), arguments.start());
}

/// Nothing can throw out of a destructor, and yet memory may end there: the job ends with a word.
[[noreturn]] void end_the_job() {
  int status = 1;
  const char* reason = "a call that must not fail has failed";
  try {
    if (const auto error = std::current_exception()) std::rethrow_exception(error);
  } catch (const std::exception& error) {
    if (base::is_out_of_memory(error)) {
      status = 3;
      reason = "there is no memory left";
    }
  } catch (...) {
  }
  std::fprintf(stderr, "perimorph: %s: all ranks are ended\n", reason);
  int is_initialized = 0;
  MPI_Initialized(&is_initialized);
  if (is_initialized != 0) MPI_Abort(MPI_COMM_WORLD, status);
  std::_Exit(status);
}

/// A rank does not outlive the mpirun that has started it.
void end_with_launcher() {
  if (std::getenv("OMPI_COMM_WORLD_RANK") != nullptr) prctl(PR_SET_PDEATHSIG, SIGKILL);
}

}  // namespace

int main(int argc, char** argv) {
  std::set_terminate(end_the_job);
  end_with_launcher();
  CLI::App app("Perimorph: where cracks start and where they run in brittle bodies");
  app.require_subcommand(1);
  Arguments arguments;
  auto* run = app.add_subcommand("run", "Run a case to its last increment");
  add_case_options(*run, arguments);
  run->add_option("--output", arguments.output, "Folder for the results (default: results/<case>)")->check(check_name);
  run->add_flag("--no-progress", arguments.no_progress, "No progress bar, even on a terminal");
  run->add_flag("--restart", arguments.restart, "Continue after the newest checkpoint in the folder of the results");
  auto* check = app.add_subcommand("check", "Check a case and its mesh, and say what a run would cost");
  add_case_options(*check, arguments);
  check->add_option("--preview", arguments.preview, "Folder for what tools/preview draws the case from")
      ->check(check_name);
  auto* params = app.add_subcommand("params", "Print every parameter with default, range, unit and meaning");
  auto* as_page = params->add_flag("--markdown", arguments.markdown, "As a Markdown page");
  params->add_flag("--relax-ng", arguments.relax_ng, "As a RELAX NG schema, for editors")->excludes(as_page);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }

  std::signal(SIGXFSZ, SIG_IGN);  // a file at its limit is then an error in order, like a full disk
  std::signal(SIGUSR1, SIG_IGN);  // as long as there is nothing to write into a checkpoint
  ::setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);  // without mpiexec Open MPI needs no daemon either
  Tpetra::ScopeGuard mpi(&argc, &argv);
  const auto comm = Tpetra::getDefaultComm();
  const auto fail = [&](const char* kind, const std::exception& error, int status) {
    if (comm->getRank() == 0) std::fprintf(stderr, "perimorph: %s%s\n", kind, base::printable(error.what()).c_str());
    return status;
  };
  try {
    const base::Consensus consensus(*comm);
    consensus.run([&] { carry_out(comm, app.get_subcommands().front()->get_name(), arguments); });
    return 0;
  } catch (const base::UserError& error) {
    return fail("", error, 2);
  } catch (const base::ComputationError& error) {
    return fail("the computation could not go on: ", error, 3);
  } catch (const std::exception& error) {
    return fail("this is a bug: ", error, 1);
  }
}
