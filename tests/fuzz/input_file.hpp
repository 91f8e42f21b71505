#pragma once

// The bytes under test as a file in memory.

#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <string>

namespace perimorph::fuzz {

/// The same file for all inputs of this process. It stays where a crash ended the process, and then holds its cause.
class InputFile {
 public:
  explicit InputFile(const std::string& ending)
      : name_("/dev/shm/perimorph_fuzz_" + std::to_string(getpid()) + ending) {}
  ~InputFile() { unlink(name_.c_str()); }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  const std::string& with(const std::uint8_t* data, std::size_t size) const {
    std::ofstream stream(name_, std::ios::binary | std::ios::trunc);
    stream.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    stream.close();
    if (!stream) std::abort();
    return name_;
  }

 private:
  std::string name_;
};

}  // namespace perimorph::fuzz
