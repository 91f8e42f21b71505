#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>

namespace perimorph::fracture {

/// A folder of this process that goes when this goes.
class TemporaryFolder {
 public:
  TemporaryFolder() { std::filesystem::create_directories(path_); }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_ = std::filesystem::temp_directory_path() / ("perimorph-" + std::to_string(getpid()));
};

}  // namespace perimorph::fracture
