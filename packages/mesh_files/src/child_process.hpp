#pragma once

#include <sys/types.h>

#include <string>

namespace perimorph::mesh_files {

/// All that is written into a pipe until its other ends are closed. Local.
std::string read_to_end(int descriptor);

/// Waits for a child process; its status as of waitpid(). Local.
int wait_for(pid_t process);

}  // namespace perimorph::mesh_files
