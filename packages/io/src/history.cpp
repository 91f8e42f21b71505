#include "perimorph/io/history.hpp"

#include <cerrno>
#include <cmath>
#include <cstring>

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

void History::write(const std::vector<double>& row) {
  PERIMORPH_ASSERT(row.size() == n_columns_, "{}: {} values for {} columns", file_, row.size(), n_columns_);
  errno = 0;
  stream_ << line(row, number) << std::flush;
  if (!stream_) {
    throw base::ComputationError(fmt::format("{}: the history cannot be written: {}", file_, std::strerror(errno)));
  }
}

}  // namespace perimorph::io
