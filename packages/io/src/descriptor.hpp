#pragma once

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "perimorph/base/algebra.hpp"

namespace perimorph::io {

/// An open file. Local. All throw std::system_error with errno.
class Descriptor {
 public:
  Descriptor(const std::string& path, int flags) : descriptor_(open(path.c_str(), flags | O_CLOEXEC, 0666)) {
    if (descriptor_ < 0) fail();
  }
  ~Descriptor() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  base::GlobalId size() const {
    struct stat about {};
    if (fstat(descriptor_, &about) != 0) fail();
    return static_cast<base::GlobalId>(about.st_size);
  }

  void set_size(base::GlobalId size) {
    if (ftruncate(descriptor_, size) != 0) fail();
  }

  void write(const char* bytes, std::size_t n, base::GlobalId at) {
    while (n > 0) {
      const auto done = pwrite(descriptor_, bytes, n, at);
      if (done < 0 && errno != EINTR) fail();
      if (done < 0) continue;
      bytes += done, at += done, n -= static_cast<std::size_t>(done);
    }
  }

  /// EIO if the file ends before.
  void read(char* bytes, std::size_t n, base::GlobalId at) const {
    while (n > 0) {
      const auto done = pread(descriptor_, bytes, n, at);
      if (done == 0) errno = EIO;
      if (done == 0 || (done < 0 && errno != EINTR)) fail();
      if (done < 0) continue;
      bytes += done, at += done, n -= static_cast<std::size_t>(done);
    }
  }

  /// Waits until the disk has what was written, and closes.
  void bring_to_disk_and_close() {
    if (fsync(descriptor_) != 0) fail();
    const int closed = ::close(descriptor_);
    descriptor_ = -1;
    if (closed != 0) fail();
  }

 private:
  int descriptor_;

  [[noreturn]] static void fail() { throw std::system_error(errno, std::generic_category()); }
};

}  // namespace perimorph::io
