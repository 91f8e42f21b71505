#include "perimorph/io/history.hpp"

#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "perimorph/base/errors.hpp"

namespace perimorph::io {

namespace {

/// Doubles represent every integer up to 2^53, which is above this.
constexpr double largest_exact_integer = 1e15;

std::string number(double value) {
  const bool integral = std::abs(value) < largest_exact_integer && value == std::trunc(value);
  return integral ? fmt::format("{}", static_cast<long long>(value)) : fmt::format("{:.10g}", value);
}

/// A comma or a quote in a boundary's name must not become a column (RFC 4180).
std::string quoted_if_needed(const std::string& field) {
  if (field.find_first_of(",\"") == std::string::npos) return field;
  std::string quoted = "\"";
  for (const char c : field) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

/// One line of comma-separated fields.
template <class T, class ToText>
std::string line(const std::vector<T>& values, ToText to_text) {
  std::string text;
  const char* separator = "";
  for (const T& value : values) {
    text += separator + to_text(value);
    separator = ",";
  }
  return text + '\n';
}

}  // namespace

History::History(const std::string& file, const std::vector<std::string>& columns)
    : file_(file), n_columns_(columns.size()) {
  errno = 0;
  stream_.open(file_);
  stream_ << line(columns, quoted_if_needed) << std::flush;
  if (!stream_) {
    throw base::UserError(fmt::format("{}: the history cannot be written: {}; name another directory with --output",
                                      file_, std::strerror(errno)));
  }
}

History::History(std::string file, std::size_t n_columns)
    : file_(std::move(file)), n_columns_(n_columns), stream_(file_, std::ios::app) {}

History History::resume(const std::string& file, const std::vector<std::string>& columns, int increment) {
  std::ifstream old(file);
  std::string text, kept;
  std::getline(old, text);
  if (text + '\n' != line(columns, quoted_if_needed)) {
    throw base::UserError(fmt::format("{}: it cannot be continued: it is missing or has other columns", file));
  }
  int last = 0;
  for (kept = text + '\n'; last < increment && std::getline(old, text); kept += text + '\n')
    last = std::atoi(text.c_str());
  if (last != increment) {
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
  PERIMORPH_ASSERT(row.size() == n_columns_, "{}: {} values for {} columns", file_, row.size(), n_columns_);
  errno = 0;
  stream_ << line(row, number) << std::flush;
  if (!stream_) {
    throw base::ComputationError(fmt::format("{}: the history cannot be written: {}", file_, std::strerror(errno)));
  }
}

}  // namespace perimorph::io
