#include "child_process.hpp"

#include <linux/filter.h>
#include <linux/seccomp.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdint>

namespace perimorph::mesh_files {

namespace {

constexpr std::size_t longest_text = std::size_t{1} << 20U;
constexpr int milliseconds_between_looks = 100;

void leave_out_the_middle(std::string& text) {
  if (text.size() > longest_text) text.erase(longest_text / 2, text.size() - longest_text);
}

}  // namespace

std::string read_to_end(int descriptor, const std::function<bool()>& waits) {
  std::string text;
  std::array<char, 4096> piece;
  pollfd pipe = {descriptor, POLLIN, 0};
  while (waits()) {
    const int ready = poll(&pipe, 1, milliseconds_between_looks);
    const ssize_t n = ready > 0 ? read(descriptor, piece.data(), piece.size()) : ready;
    if (n > 0) {
      text.append(piece.data(), static_cast<std::size_t>(n));
      leave_out_the_middle(text);
    } else if (n < 0 ? errno != EINTR : ready > 0) {
      break;
    }
  }
  return text;
}

/// A filter of system calls: execve() must name the program by the address of this one string, which the memory of the
/// started program no longer has.
void end_with_parent() { prctl(PR_SET_PDEATHSIG, SIGKILL); }

void forbid_other_programs(const char* allowed) {
  const auto address = reinterpret_cast<std::uintptr_t>(allowed);
  const auto low = static_cast<std::uint32_t>(address),
             high = static_cast<std::uint32_t>(std::uint64_t{address} >> 32U);
  constexpr std::uint32_t number = offsetof(seccomp_data, nr), path = offsetof(seccomp_data, args);
  constexpr std::uint16_t load = BPF_LD | BPF_W | BPF_ABS, equal = BPF_JMP | BPF_JEQ | BPF_K, end = BPF_RET | BPF_K;
  std::array<sock_filter, 9> steps = {{{load, 0, 0, number},
                                       {equal, 5, 0, __NR_execveat},  // to the refusal
                                       {equal, 0, 5, __NR_execve},    // others to the permission
                                       {load, 0, 0, path},  // its lower half, on the machines with these calls
                                       {equal, 0, 2, low},
                                       {load, 0, 0, path + 4},
                                       {equal, 1, 0, high},
                                       {end, 0, 0, SECCOMP_RET_ERRNO | EPERM},
                                       {end, 0, 0, SECCOMP_RET_ALLOW}}};
  const sock_fprog program = {steps.size(), steps.data()};
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0) prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program);
}

int wait_for(pid_t process) {
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

}  // namespace perimorph::mesh_files
