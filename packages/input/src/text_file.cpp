#include "text_file.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "perimorph/base/errors.hpp"

namespace perimorph::input {

namespace {

[[noreturn]] void refuse(const std::string& file, const std::string& why) {
  throw base::UserError(fmt::format("{}: {}", file, why));
}

void require_readable(const std::string& file, const std::string& what, std::size_t most_bytes) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) refuse(file, fmt::format("there is no such file; {} is needed", what));
  if (std::filesystem::is_directory(status)) refuse(file, fmt::format("is a directory; {} in it is needed", what));
  if (!std::filesystem::is_regular_file(status)) {
    refuse(file, fmt::format("is not a regular file; {} is needed", what));
  }
  const auto bytes = std::filesystem::file_size(file, error);
  if (error) refuse(file, "cannot be read: " + error.message());
  if (bytes <= most_bytes) return;
  refuse(file, fmt::format("is too large ({} bytes); {} has at most {} MiB", bytes, what, most_bytes >> 20));
}

}  // namespace

std::string text_of_file(const std::string& file, const std::string& what, std::size_t most_bytes) {
  require_readable(file, what, most_bytes);
  std::ifstream in(file, std::ios::binary);
  if (!in) refuse(file, fmt::format("cannot be read: {}", std::strerror(errno)));
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace perimorph::input
