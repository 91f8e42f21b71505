#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace perimorph::mesh_files {

/// The bytes of a file, mapped into memory: only those that are looked at are read, and the system may drop them again.
/// Nobody may shorten the file meanwhile.
class MappedFile {
 public:
  /// Local. @throws base::UserError if it cannot be read
  explicit MappedFile(const std::string& file);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  std::string_view bytes() const { return bytes_; }

  /// Takes bytes out of memory until they are looked at again. Local.
  void release(std::size_t begin, std::size_t end) const;

 private:
  std::string_view bytes_;
};

}  // namespace perimorph::mesh_files
