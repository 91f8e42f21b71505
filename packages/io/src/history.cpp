#include "perimorph/io/history.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iterator>

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
    : file_(file), n_columns_(columns.size()) {
  PERIMORPH_ASSERT(n_columns_ > 0, "{}: a table without columns", file_);
  errno = 0;
  stream_.open(file_);
  stream_ << line(columns) << std::flush;
  if (!stream_) {
    throw base::UserError(fmt::format("{}: the history cannot be written: {}; name another directory with --output",
                                      file_, std::strerror(errno)));
  }
}

History::History(std::string file, std::size_t n_columns)
    : file_(std::move(file)), n_columns_(n_columns), stream_(file_, std::ios::app) {}

History History::resume(const std::string& file, const std::vector<std::string>& columns, int increment, Rows rows) {
  std::ifstream old(file);
  std::string text, kept;
  std::getline(old, text);
  if (text + '\n' != line(columns)) {
    throw base::UserError(fmt::format("{}: it cannot be continued: it is missing or has other columns", file));
  }
  kept = text + '\n';
  int last = 0;
  // The last line of a run that ended by force may be cut off, and its number with it.
  while (std::getline(old, text) && !old.eof() && std::atoi(text.c_str()) <= increment) {
    last = std::atoi(text.c_str());
    kept += text + '\n';
  }
  if (rows == Rows::in_each_increment && last != increment) {
    throw base::UserError(fmt::format("{}: it cannot be continued: increment {} is missing", file, increment));
  }
  const std::string beside = file + ".part";
  std::ofstream renewed(beside);
  renewed << kept << std::flush;
  std::error_code error;
  if (renewed) std::filesystem::rename(beside, file, error);
  if (!renewed || error) throw base::UserError(fmt::format("{}: the history cannot be written", file));
  return {file, columns.size()};
}

void History::write(const std::vector<double>& row) {
  std::vector<std::string> texts;
  std::transform(row.begin(), row.end(), std::back_inserter(texts), number);
  write_texts(texts);
}

void History::write_texts(const std::vector<std::string>& row) {
  PERIMORPH_ASSERT(row.size() == n_columns_, "{}: {} values for {} columns", file_, row.size(), n_columns_);
  errno = 0;
  stream_ << line(row) << std::flush;
  if (!stream_) {
    throw base::ComputationError(fmt::format("{}: the history cannot be written: {}", file_, std::strerror(errno)));
  }
}

std::string History::number(double value) {
  const bool integral = std::abs(value) < largest_exact_integer && value == std::trunc(value);
  return integral ? fmt::format("{}", static_cast<long long>(value)) : fmt::format("{:.10g}", value);
}

}  // namespace perimorph::io
