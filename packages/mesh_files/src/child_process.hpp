#pragma once

#include <sys/types.h>

#include <string>

namespace perimorph::mesh_files {

/// All that is written into a pipe until its other end is closed. Local.
/// @param descriptor the end to read from
std::string read_to_end(int descriptor);

/// Waits for a child process to end, and returns its status as waitpid() gives it. Local.
int wait_for(pid_t process);

}  // namespace perimorph::mesh_files
