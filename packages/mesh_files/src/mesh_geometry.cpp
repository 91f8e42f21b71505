// Runs gmsh as a process of its own: if it crashes, it does not take the solver along.

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <system_error>
#include <vector>

#include "child_process.hpp"
#include "file_cursor.hpp"
#include "geometry_script.hpp"
#include "perimorph/base/errors.hpp"
#include "perimorph/base/signals.hpp"
#include "perimorph/mesh_files/gmsh.hpp"
#include "text_fields.hpp"

namespace perimorph::mesh_files {

namespace {

constexpr int n_first_lines = 5, n_last_lines = 5;  // of gmsh's messages, in an error

using Words = std::vector<std::string>;

std::vector<char*> pointers(Words& words) {
  std::vector<char*> list;
  for (auto& word : words) list.push_back(word.data());
  list.push_back(nullptr);
  return list;
}

/// This process' environment without what mpirun put there: some builds of gmsh are linked with MPI, and would take
/// themselves for a rank of this run.
Words environment_without_mpi() {
  Words kept;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    bool is_mpi = false;
    for (const char* prefix : {"OMPI_", "PMIX_", "PMI_", "MPI_LOCAL"}) {
      is_mpi = is_mpi || std::strncmp(*variable, prefix, std::strlen(prefix)) == 0;
    }
    if (!is_mpi) kept.emplace_back(*variable);
  }
  return kept;
}

constexpr int not_started = 127;  // exit status, as of a shell

struct Outcome {
  int start_error;  // errno if the program could not be started, otherwise 0
  int status;       // as of waitpid()
  std::string output;
  bool was_ended;  // by this process, which did not want to wait any longer
};

/// Where the PATH has a program, or "".
std::string find_program(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    std::string file = (folder.empty() ? "." : folder) + "/" + name;
    std::error_code ignored;
    if (std::filesystem::is_regular_file(file, ignored) && access(file.c_str(), X_OK) == 0) return file;
  }
  return "";
}

/// Runs a program to its end, without input; collects what it writes on both streams. It is ended after some time, and
/// if this process is asked to stop.
/// @param command its file and arguments
Outcome run(Words command, const MeshingLimits& limits) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return {errno, 0, "", false};
  Words environment = environment_without_mpi();
  const std::vector<char*> arguments = pointers(command), variables = pointers(environment);
  const pid_t process = fork();
  if (process == 0) {
    end_with_parent();
    dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
    dup2(ends[1], STDOUT_FILENO);
    dup2(ends[1], STDERR_FILENO);
    if (limits.side_effects == SideEffects::refused) forbid_other_programs(arguments[0]);
    execve(arguments[0], arguments.data(), variables.data());
    _exit(not_started);
  }
  const int start_error = process < 0 ? errno : 0;
  close(ends[1]);
  Outcome outcome = {start_error, 0, "", false};
  if (process > 0) {
    const auto begin = std::chrono::steady_clock::now();
    outcome.output = read_to_end(ends[0], [&] {
      const std::chrono::duration<double, std::ratio<60>> minutes = std::chrono::steady_clock::now() - begin;
      outcome.was_ended = minutes.count() > limits.minutes || base::Signals::is_stop_asked();
      return !outcome.was_ended;
    });
    if (outcome.was_ended) kill(process, SIGKILL);
    outcome.status = wait_for(process);
  }
  close(ends[0]);
  return outcome;
}

/// The first lines (they name the cause) and the last ones, without repeated lines.
std::string excerpt_of(const std::string& output) {
  std::istringstream stream(output);
  Words lines;
  for (std::string line; std::getline(stream, line);) {
    if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(line);
  }
  if (lines.empty()) return "(none)";
  if (lines.size() > n_first_lines + n_last_lines) {
    const auto begin = lines.begin() + n_first_lines;
    lines.insert(lines.erase(begin, lines.end() - n_last_lines), "...");
  }
  return fmt::format("{}", fmt::join(lines, "\n"));
}

std::string how_it_ended(const Outcome& outcome) {
  if (WIFSIGNALED(outcome.status)) {
    return fmt::format("gmsh crashed ({}). Mesh.Algorithm = 8 crashes in gmsh 4.8: choose another, such as 6",
                       strsignal(WTERMSIG(outcome.status)));
  }
  if (WEXITSTATUS(outcome.status) != 0) return fmt::format("gmsh failed (status {})", WEXITSTATUS(outcome.status));
  return "gmsh wrote no mesh";
}

void refuse_commands(const std::string& geo_file) {
  const std::string command = command_beyond_meshing(geo_file);
  if (command.empty()) return;
  throw base::UserError(fmt::format(
      "{}{}; allowed are geometries that neither run programs nor write files, unless --allow-shell is given "
      "(do so only if you trust where it is from)",
      command.rfind(geo_file + ":", 0) == 0 ? "" : geo_file + ": ", command));
}

[[noreturn]] void fail_to_wait(const std::string& geo_file, const MeshingLimits& limits) {
  if (base::Signals::is_stop_asked()) {
    throw base::ComputationError(geo_file + ": a signal asked the run to stop while gmsh meshed it");
  }
  throw base::UserError(
      fmt::format("{}: gmsh was still meshing it after {} min, and was ended: either it loops forever, or it needs a "
                  "higher /Mesh/Maximum Meshing Minutes",
                  geo_file, limits.minutes));
}

/// So that neither an older mesh nor what a failed gmsh left behind is taken for the result.
void remove_quietly(const std::string& file) {
  std::error_code ignored;
  std::filesystem::remove(file, ignored);
}

}  // namespace

bool is_geometry(const std::string& file) { return lower(std::filesystem::path(file).extension()) == ".geo"; }

void mesh_geometry(const std::string& geo_file, const std::string& msh_file, int dimension,
                   const MeshingLimits& limits) {
  PERIMORPH_ASSERT(dimension == 2 || dimension == 3, "a mesh of dimension {}", dimension);
  require_regular_file(geo_file, "a geometry of gmsh");
  if (limits.side_effects == SideEffects::refused) refuse_commands(geo_file);
  if (ignores_last_command(geo_file)) {
    throw base::UserError(
        geo_file +
        ": gmsh passes over the last command, since its line holds several and does not end in a line "
        "break: allowed is a last line that does");
  }
  remove_quietly(msh_file);
  const std::string gmsh = find_program("gmsh");
  if (gmsh.empty()) {
    throw base::UserError(geo_file + ": gmsh is needed to mesh it, but is not installed (apt-get install gmsh)");
  }
  const Outcome outcome = run(
      {gmsh, fmt::format("-{}", dimension), "-format", "msh41", "-bin", "-v", "2", geo_file, "-o", msh_file}, limits);
  if (outcome.start_error != 0) {
    throw base::UserError(
        fmt::format("{}: gmsh cannot be started: {}", geo_file, std::generic_category().message(outcome.start_error)));
  }
  std::error_code ignored;
  if (outcome.status != 0 || !std::filesystem::is_regular_file(msh_file, ignored)) {
    remove_quietly(msh_file);
    if (outcome.was_ended) fail_to_wait(geo_file, limits);
    throw base::UserError(
        fmt::format("{}: {}. Its messages:\n{}", geo_file, how_it_ended(outcome), excerpt_of(outcome.output)));
  }
}

}  // namespace perimorph::mesh_files
