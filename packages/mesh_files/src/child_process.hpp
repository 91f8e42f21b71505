#pragma once

#include <sys/types.h>

#include <functional>
#include <string>

namespace perimorph::mesh_files {

/// What is written into a pipe until its other end is closed, or nobody wants to wait any longer; of more than a
/// megabyte the beginning and the end. Local.
/// @param descriptor the end to read from
/// @param waits asked several times a second
std::string read_to_end(
    int descriptor, const std::function<bool()>& waits = [] { return true; });

/// From here on this process, a child, does not outlive the one that has started it. May be called after fork(). Local.
void end_with_parent();

/// From here on this process and its children start no program but one, as far as the system can see to that (Linux on
/// x86-64 and ARM). May be called between fork() and exec(). Local.
/// @param allowed the very string that execve() will be called with
void forbid_other_programs(const char* allowed);

/// Waits for a child process to end, and returns its status as waitpid() gives it. Local.
int wait_for(pid_t process);

}  // namespace perimorph::mesh_files
