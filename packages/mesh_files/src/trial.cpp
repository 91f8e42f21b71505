#include "trial.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>

#include "child_process.hpp"
#include "perimorph/base/errors.hpp"

namespace perimorph::mesh_files {

namespace {

constexpr int ended = 0, failed = 1, refused = 2;  // exit status: the last one with a UserError's message

std::size_t address_space() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

void limit(int resource, rlim_t value) {
  rlimit now{};
  getrlimit(static_cast<__rlimit_resource>(resource), &now);
  now.rlim_cur = std::min(value, now.rlim_max);
  setrlimit(static_cast<__rlimit_resource>(resource), &now);
}

void confine(std::size_t memory, unsigned seconds) {
  for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU}) std::signal(signal, SIG_DFL);
  limit(RLIMIT_AS, address_space() + memory);
  limit(RLIMIT_CPU, seconds);
  limit(RLIMIT_CORE, 0);
  const int nowhere = open("/dev/null", O_WRONLY);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
}

[[noreturn]] void work_and_exit(const std::function<void()>& work, int message) {
  int status = ended;
  try {
    work();
  } catch (const base::UserError& error) {
    const std::string text = error.what();
    status = write(message, text.data(), text.size()) == static_cast<ssize_t>(text.size()) ? refused : failed;
  } catch (...) {  // no memory, for example
    status = failed;
  }
  _exit(status);
}

}  // namespace

std::string on_trial(const std::function<void()>& work, std::size_t memory, unsigned seconds) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return std::strerror(errno);
  const pid_t process = fork();
  if (process == 0) {
    end_with_parent();
    confine(memory, seconds);
    work_and_exit(work, ends[1]);
  }
  close(ends[1]);
  const std::string message = process < 0 ? "" : read_to_end(ends[0]);
  close(ends[0]);
  if (process < 0) return "no process for it could be started";
  const int status = wait_for(process);
  if (WIFEXITED(status) && WEXITSTATUS(status) == ended) return "";
  if (WIFEXITED(status) && WEXITSTATUS(status) == refused) throw base::UserError(message);
  if (WIFSIGNALED(status)) return strsignal(WTERMSIG(status));
  return "no memory, or an error of a library";
}

}  // namespace perimorph::mesh_files
