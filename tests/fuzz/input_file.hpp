#pragma once

// The bytes under test as a file in memory.

#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace perimorph::fuzz {

/// The same file for all inputs of this process, in a folder of its own. It stays where a crash ended the process, and
/// then holds its cause.
class InputFile {
 public:
  explicit InputFile(const std::string& ending) : name_(folder_ / ("input" + ending)) {
    std::filesystem::create_directories(folder_);
  }
  ~InputFile() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  const std::string& with(const std::uint8_t* data, std::size_t size) const {
    std::ofstream stream(name_, std::ios::binary | std::ios::trunc);
    stream.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    stream.close();
    if (!stream) std::abort();
    return name_;
  }

  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_ = "/dev/shm/perimorph_fuzz_" + std::to_string(getpid());
  std::string name_;
};

}  // namespace perimorph::fuzz
