#include "file_cursor.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <system_error>

#include "perimorph/base/errors.hpp"

namespace perimorph::mesh_files {

namespace {

constexpr std::string_view white_space = " \t\r\n";

/// Unlike the standard library's, as C has it: "+1" is a number.
std::string_view without_plus(std::string_view text) {
  const bool has_plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
  return text.substr(has_plus ? 1 : 0);
}

}  // namespace

bool parse_number(std::string_view text, std::int64_t& value) {
  const std::string_view digits = without_plus(text);
  const char* end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, value);
  return error == std::errc() && stop == end;
}

bool parse_number(std::string_view text, double& value) {
  const std::string_view digits = without_plus(text);
  const char* end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, value);
  if (error == std::errc::result_out_of_range) value = std::strtod(std::string(digits).c_str(), nullptr);
  return error != std::errc::invalid_argument && stop == end;
}

std::string excerpt(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string shown(text.substr(0, longest));
  std::replace_if(
      shown.begin(), shown.end(), [](unsigned char c) { return c < 32 || c > 126; }, '?');
  return text.size() > longest ? shown + "..." : shown;
}

void require_regular_file(const std::string& file, const std::string& wanted) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  const auto refuse = [&](const std::string& why) { throw base::UserError(fmt::format("{}: {}", file, why)); };
  if (!std::filesystem::exists(status)) refuse("cannot be read: " + error.message());
  if (std::filesystem::is_directory(status)) refuse("is a folder, not " + wanted);
  if (!std::filesystem::is_regular_file(status)) refuse("is not a regular file, as " + wanted + " must be");
  if (std::filesystem::file_size(file, error) == 0) refuse("the file is empty; " + wanted + " is needed");
}

namespace {
std::string regular_file(const std::string& file, const std::string& wanted) {
  require_regular_file(file, wanted);
  return file;
}
}  // namespace

FileCursor::FileCursor(const std::string& file, const std::string& wanted)
    : file_(regular_file(file, wanted)), mapped_(file_), text_(mapped_.bytes()) {
  if (at_end()) throw base::UserError(fmt::format("{}: the file is empty; {} is needed", file, wanted));
}

void FileCursor::skip_white_space() {
  move_to(std::min(text_.find_first_not_of(white_space, position_), text_.size()));
}

void FileCursor::release_what_is_behind() {
  mapped_.release(released_, position_);
  released_ = position_;
}

bool FileCursor::at_end() {
  skip_white_space();
  return remaining() == 0;
}

std::string FileCursor::raw_line() {
  const std::size_t end = std::min(text_.find('\n', position_), text_.size()), begin = position_;
  move_to(std::min(end + 1, text_.size()));
  const bool windows = end > begin && text_[end - 1] == '\r';
  return std::string(text_.substr(begin, end - begin - (windows ? 1 : 0)));
}

std::string FileCursor::line() {
  const std::string whole = raw_line();
  std::string_view words = whole;
  words.remove_prefix(std::min(words.find_first_not_of(white_space), words.size()));
  words.remove_suffix(words.size() - (words.find_last_not_of(white_space) + 1));
  return std::string(words);
}

void FileCursor::expect(const std::string& words) {
  if (at_end()) fail_truncated();
  const std::string_view found = text_.substr(position_, words.size());
  if (found == words) {
    position_ += words.size();
  } else if (remaining() < words.size() && found == words.substr(0, found.size())) {
    fail_truncated();
  } else {
    fail(fmt::format("{} expected, found \"{}\"", excerpt(words), excerpt(token())));
  }
}

void FileCursor::skip_to_line(const std::string& words) {
  const std::size_t found =
      text_.compare(position_, words.size(), words) == 0 ? position_ : text_.find('\n' + words, position_);
  if (found == std::string::npos) fail(fmt::format("{} is missing: the file is truncated or damaged", excerpt(words)));
  move_to(found);
  skip_white_space();
}

void FileCursor::skip_past_line(const std::string& words) {
  skip_to_line(words);
  line();
}

std::string_view FileCursor::token() {
  if (at_end()) fail_truncated();
  const std::size_t end = std::min(text_.find_first_of(white_space, position_), text_.size());
  const std::string_view word = text_.substr(position_, end - position_);
  move_to(end);
  return word;
}

int FileCursor::ascii_int() {
  const std::int64_t value = ascii_long();
  if (value < std::numeric_limits<int>::min() || value > std::numeric_limits<int>::max()) {
    fail(fmt::format("the number {} is too large", value));
  }
  return static_cast<int>(value);
}

std::int64_t FileCursor::ascii_long() {
  const std::string_view word = token();
  std::int64_t value = 0;
  if (!parse_number(word, value)) fail(fmt::format("a whole number expected, found \"{}\"", excerpt(word)));
  return value;
}

double FileCursor::next_real() {
  const double value = binary_ ? raw<double>() : ascii_real();
  if (!std::isfinite(value)) fail(fmt::format("a coordinate is {}", value));
  return value;
}

double FileCursor::ascii_real() {
  const std::string_view word = token();
  double value = 0.;
  if (!parse_number(word, value)) fail(fmt::format("a number expected, found \"{}\"", excerpt(word)));
  return value;
}

void FileCursor::skip_line_break() {
  const std::size_t end = text_.find('\n', position_);
  if (end == std::string::npos) fail_truncated();
  move_to(end + 1);
}

void FileCursor::skip_numbers(std::size_t count, std::size_t bytes) {
  if (!binary_) {
    for (; count > 0; --count) token();
    return;
  }
  const std::size_t most = remaining() / bytes;
  move_to(position_ + std::min(count, most) * bytes);
  if (count > most) fail_truncated();
}

std::size_t FileCursor::checked(std::int64_t count, std::size_t numbers, std::size_t bytes) const {
  const std::size_t smallest = binary_ ? bytes : 2 * numbers;  // a digit and a space
  if (count < 0 || static_cast<std::size_t>(count) > remaining() / smallest) {
    fail(fmt::format("a count of {}, but the rest of the file holds at most {}: the file is truncated or damaged",
                     count, remaining() / smallest));
  }
  return static_cast<std::size_t>(count);
}

std::string FileCursor::place() const {
  if (binary_) return fmt::format("{}: byte {}", file_, position_);
  const std::string_view passed = text_.substr(0, std::max<std::size_t>(position_, 1) - 1);
  return fmt::format("{}:{}", file_, 1 + std::count(passed.begin(), passed.end(), '\n'));
}

void FileCursor::fail(const std::string& what) const { throw base::UserError(fmt::format("{}: {}", place(), what)); }

void FileCursor::fail_truncated() const { fail("the file ends too early: it is truncated"); }

}  // namespace perimorph::mesh_files
