// Runs gmsh as a process of its own: if it crashes, it does not take the solver along.

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <system_error>
#include <vector>

#include "child_process.hpp"
#include "file_cursor.hpp"
#include "perimorph/base/errors.hpp"
#include "perimorph/mesh_files/gmsh.hpp"

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

struct Outcome {
  int start_error;  // errno if the program could not be started, otherwise 0
  int status;       // as of waitpid()
  std::string output;
};

/// Runs a program found on the PATH to its end, without input; collects what it writes on both streams.
Outcome run(Words command) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return {errno, 0, ""};
  posix_spawn_file_actions_t streams;
  posix_spawn_file_actions_init(&streams);
  posix_spawn_file_actions_addopen(&streams, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&streams, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&streams, ends[1], STDERR_FILENO);

  Words environment = environment_without_mpi();
  pid_t process = 0;
  Outcome outcome = {};
  outcome.start_error = posix_spawnp(&process, command[0].c_str(), &streams, nullptr, pointers(command).data(),
                                     pointers(environment).data());
  posix_spawn_file_actions_destroy(&streams);
  close(ends[1]);
  if (outcome.start_error == 0) {
    outcome.output = read_to_end(ends[0]);
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

/// So that neither an older mesh nor what a failed gmsh left behind is taken for the result.
void remove_quietly(const std::string& file) {
  std::error_code ignored;
  std::filesystem::remove(file, ignored);
}

}  // namespace

void mesh_geometry(const std::string& geo_file, const std::string& msh_file, int dimension) {
  PERIMORPH_ASSERT(dimension == 2 || dimension == 3, "a mesh of dimension {}", dimension);
  require_regular_file(geo_file, "a geometry of gmsh");
  remove_quietly(msh_file);
  const Outcome outcome =
      run({"gmsh", fmt::format("-{}", dimension), "-format", "msh41", "-bin", "-v", "2", geo_file, "-o", msh_file});
  if (outcome.start_error == ENOENT) {
    throw base::UserError(geo_file + ": gmsh is needed to mesh it, but is not installed (apt-get install gmsh)");
  }
  if (outcome.start_error != 0) {
    throw base::UserError(
        fmt::format("{}: gmsh cannot be started: {}", geo_file, std::generic_category().message(outcome.start_error)));
  }
  std::error_code ignored;
  if (outcome.status != 0 || !std::filesystem::is_regular_file(msh_file, ignored)) {
    remove_quietly(msh_file);
    throw base::UserError(
        fmt::format("{}: {}. Its messages:\n{}", geo_file, how_it_ended(outcome), excerpt_of(outcome.output)));
  }
}

}  // namespace perimorph::mesh_files
