#include "perimorph/io/history.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <iterator>

#include "checksum.hpp"
#include "perimorph/base/errors.hpp"

namespace perimorph::io {

namespace {

/// Doubles represent every integer up to 2^53, which is above this.
constexpr double largest_exact_integer = 1e15;

/// A comma or a quote in a boundary's name must not become a column (RFC 4180).
std::string quoted_if_needed(const std::string& field) {
  if (field.find_first_of(",\"") == std::string::npos) return field;
  std::string quoted = "\"";
  for (const char c : field) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

/// One line of comma-separated fields.
std::string line(const std::vector<std::string>& values) {
  std::string text;
  const char* separator = "";
  for (const auto& value : values) {
    text += separator + quoted_if_needed(value);
    separator = ",";
  }
  return text + '\n';
}

}  // namespace

History::History(const std::string& file, const std::vector<std::string>& columns)
    : file_(file), n_columns_(columns.size()), extent_{std::filesystem::path(file).filename(), 0, 0} {
  PERIMORPH_ASSERT(n_columns_ > 0, "{}: a table without columns", file_);
  errno = 0;
  std::ofstream{file_}.flush();        // empty, and then behind what is there: if it is no longer what we have written,
  stream_.open(file_, std::ios::app);  // that shows
  append(line(columns));
  if (!stream_) {
    throw base::UserError(fmt::format("{}: the history cannot be written: {}; name another directory with --output",
                                      file_, std::strerror(errno)));
  }
}

History::History(const std::string& file, std::size_t n_columns, const FileExtent& extent)
    : file_(file), n_columns_(n_columns), extent_(extent), stream_(file_, std::ios::app) {}

History History::resume(const std::string& file, const std::vector<std::string>& columns, const FileExtent& extent) {
  std::string header;
  std::getline(std::ifstream(file), header);
  if (header + '\n' != line(columns)) {
    throw base::UserError(fmt::format("{}: it cannot be continued: it is missing or has other columns", file));
  }
  std::error_code error;
  if (static_cast<base::GlobalId>(std::filesystem::file_size(file, error)) != extent.size) {
    std::filesystem::resize_file(file, static_cast<std::uintmax_t>(extent.size), error);
  }
  if (error) throw base::UserError(fmt::format("{}: the history cannot be written: {}", file, error.message()));
  return {file, columns.size(), extent};
}

void History::append(const std::string& text) {
  stream_ << text << std::flush;
  extent_.size += static_cast<base::GlobalId>(text.size());
  extent_.checksum = checksum_of(text, static_cast<Checksum>(extent_.checksum));
}

void History::write(const std::vector<double>& row) {
  std::vector<std::string> texts;
  std::transform(row.begin(), row.end(), std::back_inserter(texts), number);
  write_texts(texts);
}

void History::write_texts(const std::vector<std::string>& row) {
  PERIMORPH_ASSERT(row.size() == n_columns_, "{}: {} values for {} columns", file_, row.size(), n_columns_);
  errno = 0;
  append(line(row));
  if (!stream_) {
    throw base::ComputationError(fmt::format("{}: the history cannot be written: {}", file_, std::strerror(errno)));
  }
}

void History::check() const {
  std::error_code error;
  const auto size = std::filesystem::file_size(file_, error);
  if (!error && static_cast<base::GlobalId>(size) == extent_.size) return;
  throw base::ComputationError(
      fmt::format("{}: it is missing or was changed by something else while the run was writing it", file_));
}

std::string History::number(double value) {
  const bool integral = std::abs(value) < largest_exact_integer && value == std::trunc(value);
  return integral ? fmt::format("{}", static_cast<long long>(value)) : fmt::format("{:.10g}", value);
}

}  // namespace perimorph::io
