#include "perimorph/io/disk.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "checksum.hpp"
#include "perimorph/base/errors.hpp"

namespace perimorph::io {

using base::GlobalId;

namespace {

/// Of a file's first bytes.
Checksum checksum_of_file(const std::string& path, GlobalId size) {
  std::ifstream stream(path, std::ios::binary);
  std::string block(1 << 20, '\0');
  Checksum checksum = 0;
  while (size > 0 && stream) {
    stream.read(block.data(), std::min(size, static_cast<GlobalId>(block.size())));
    const GlobalId n = stream.gcount();
    checksum = checksum_of({block.data(), static_cast<std::size_t>(n)}, checksum);
    size -= n;
  }
  return checksum;
}

}  // namespace

void bring_to_disk(const std::string& path) {
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  int error = descriptor < 0 ? errno : 0;
  if (error == 0 && fsync(descriptor) != 0 && errno != EINVAL) error = errno;  // EINVAL: there is nothing to wait for
  if (descriptor >= 0) close(descriptor);
  if (error == 0) return;
  throw base::ComputationError(fmt::format("{}: it cannot be brought to the disk: {}", path, std::strerror(error)));
}

base::GlobalId size_of(const std::string& path) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (!error) return static_cast<GlobalId>(size);
  throw base::ComputationError(
      fmt::format("{}: it is missing: something has removed it while the run was writing it", path));
}

std::string trouble_with(const std::string& folder, const FileExtent& extent) {
  const std::string path = (std::filesystem::path(folder) / extent.name).string();
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (error) return "is missing";
  if (static_cast<GlobalId>(size) < extent.size) return "is shorter than it was";
  if (extent.checksum == FileExtent::no_checksum || extent.checksum == checksum_of_file(path, extent.size)) return "";
  return "is not what it was";
}

}  // namespace perimorph::io
