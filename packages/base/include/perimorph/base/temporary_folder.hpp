#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>
#include <system_error>

#include "perimorph/base/errors.hpp"

namespace perimorph::base {

/// A folder of this process' own, removed together with this object.
class TemporaryFolder {
 public:
  /// @throws UserError if there is no place for it.
  TemporaryFolder() {
    std::error_code error;
    path_ = std::filesystem::temp_directory_path(error) / ("perimorph-" + std::to_string(getpid()));
    if (!error) std::filesystem::create_directories(path_, error);
    if (error) {
      throw UserError(fmt::format(
          "no temporary folder: {}; TMPDIR, or else /tmp, must be a folder that can be written to", error.message()));
    }
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

}  // namespace perimorph::base
