#include "child_process.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>

namespace perimorph::mesh_files {

std::string read_to_end(int descriptor) {
  std::string text;
  std::array<char, 4096> piece;
  for (ssize_t n; (n = read(descriptor, piece.data(), piece.size())) != 0;) {
    if (n > 0) {
      text.append(piece.data(), static_cast<std::size_t>(n));
    } else if (errno != EINTR) {
      break;
    }
  }
  return text;
}

int wait_for(pid_t process) {
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

}  // namespace perimorph::mesh_files
