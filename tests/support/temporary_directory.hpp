#pragma once

#include <stdlib.h>

#include <filesystem>
#include <string>

namespace perimorph::tests {

/// A new directory that is removed with everything in it. With PERIMORPH_KEEP=DIRECTORY in the environment that one is
/// used instead and kept, so that the files can be looked at.
class TemporaryDirectory {
 public:
  TemporaryDirectory() {
    if (const char* kept = getenv("PERIMORPH_KEEP")) {
      path_ = kept;
      keep_ = true;
      std::filesystem::create_directories(path_);
      return;
    }
    std::string name = (std::filesystem::temp_directory_path() / "perimorph-XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~TemporaryDirectory() {
    if (!keep_) std::filesystem::remove_all(path_);
  }
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
  bool keep_ = false;
};

}  // namespace perimorph::tests
