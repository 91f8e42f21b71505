#include "abaqus_lines.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "perimorph/base/errors.hpp"
#include "perimorph/base/text.hpp"
#include "text_fields.hpp"

namespace perimorph::mesh_files {

namespace {

constexpr int most_included = 1000;
constexpr std::int64_t largest_number = 999999999;

/// Commas part fields, but not inside quotes. One at the end of the line begins none.
std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields(1);
  bool is_quoted = false;
  for (const char c : line) {
    if (c == '"') is_quoted = !is_quoted;
    if (c == ',' && !is_quoted) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  for (std::string& field : fields) field = trimmed(field);
  if (fields.size() > 1 && fields.back().empty()) fields.pop_back();
  return fields;
}

std::string without_quotes(const std::string& text) {
  const bool is_quoted = text.size() > 1 && text.front() == '"' && text.back() == '"';
  return is_quoted ? text.substr(1, text.size() - 2) : text;
}

std::string without_blanks(std::string text) {
  text.erase(std::remove_if(text.begin(), text.end(), [](char c) { return c == ' ' || c == '\t'; }), text.end());
  return text;
}

bool is_keyword(const std::string& line) { return line[0] == '*'; }

}  // namespace

std::string AbaqusKeyword::value(const std::string& parameter) const {
  const auto found = parameters.find(parameter);
  return found == parameters.end() ? "" : found->second;
}

AbaqusLines::AbaqusLines(const std::string& file) {
  files_.push_back({file, std::make_unique<FileCursor>(file, "an input file of Abaqus")});
}

bool AbaqusLines::find_line() {
  while (line_.empty()) {
    if (files_.back().cursor->at_end()) {
      if (files_.size() == 1) return false;
      files_.pop_back();
      continue;
    }
    line_ = files_.back().cursor->line();
    if (line_.rfind("**", 0) == 0) line_.clear();
    if (line_.empty() || lower(without_blanks(line_.substr(0, 20))).rfind("*include", 0) != 0) continue;
    const AbaqusKeyword keyword = parse_keyword();
    include(keyword.value("input"));
  }
  return true;
}

/// The next line with those that continue it: all but the last end in a comma.
std::string AbaqusLines::continued() {
  std::string text = std::move(line_);
  line_.clear();
  while (text.back() == ',' && !files_.back().cursor->at_end()) {
    const std::string next = files_.back().cursor->line();
    if (next.rfind("**", 0) != 0) text += next;
  }
  return text;
}

AbaqusKeyword AbaqusLines::parse_keyword() {
  const std::vector<std::string> fields = split(continued());
  AbaqusKeyword keyword{lower(without_blanks(fields[0].substr(1))), {}};
  for (std::size_t i = 1; i < fields.size(); ++i) {
    const std::size_t equals = std::min(fields[i].find('='), fields[i].size());
    const std::string value = equals == fields[i].size() ? "" : trimmed(fields[i].substr(equals + 1));
    keyword.parameters[lower(without_blanks(fields[i].substr(0, equals)))] = without_quotes(value);
  }
  return keyword;
}

std::optional<AbaqusKeyword> AbaqusLines::next_keyword() {
  while (find_line()) {
    if (is_keyword(line_)) return parse_keyword();
    line_.clear();
  }
  return std::nullopt;
}

std::optional<std::vector<std::string>> AbaqusLines::next_data() {
  if (!find_line() || is_keyword(line_)) return std::nullopt;
  const std::vector<std::string> fields = split(line_);
  line_.clear();
  return fields;
}

void AbaqusLines::include(const std::string& name) {
  if (name.empty() || base::has_control_characters(name)) fail("*INCLUDE or INPUT= without a readable name of a file");
  const auto folder = std::filesystem::path(files_.back().name).parent_path();
  const std::string file = (folder / name).string();
  const bool is_open = std::any_of(files_.begin(), files_.end(), [&](const File& open) {
    std::error_code ignored;
    return std::filesystem::equivalent(open.name, file, ignored);
  });
  if (is_open) fail(fmt::format("the file \"{}\" includes itself", excerpt(name)));
  if (++n_included_ > most_included) fail(fmt::format("more than {} files are included", most_included));
  try {
    files_.push_back({file, std::make_unique<FileCursor>(file, "a part of an input file of Abaqus")});
  } catch (const base::UserError& error) {
    fail(fmt::format("what is to be included cannot be read: {}", error.what()));
  }
}

std::int64_t AbaqusLines::whole_number(const std::string& field) const {
  std::int64_t value = 0;
  if (!parse_number(field, value) || value < 1 || value > largest_number) {
    fail(fmt::format("a whole number from 1 to {} expected, found \"{}\"", largest_number, excerpt(field)));
  }
  return value;
}

double AbaqusLines::real_number(const std::string& field) const {
  double value = 0.;
  if (field.empty()) return value;
  if (!parse_number(with_exponent(field), value) || !std::isfinite(value)) {
    fail(fmt::format("a number expected, found \"{}\"", excerpt(field)));
  }
  return value;
}

}  // namespace perimorph::mesh_files
