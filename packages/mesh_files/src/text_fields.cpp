#include "text_fields.hpp"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstring>

namespace perimorph::mesh_files {

namespace {

constexpr std::size_t longest_command = 500, most_columns = 200;
constexpr int widest_column = 60;

}  // namespace

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::vector<std::string> fields_of(const std::string& line) {
  const std::string command = line.substr(0, std::min(line.find('!'), longest_command));
  std::vector<std::string> fields;
  for (std::size_t begin = 0; begin <= command.size();) {
    const std::size_t comma = std::min(command.find(',', begin), command.size());
    fields.push_back(trimmed(command.substr(begin, comma - begin)));
    begin = comma + 1;
  }
  return fields;
}

bool parse_column_format(const std::string& line, ColumnFormat& format) {
  const std::string text = lower(line);
  const char* next = text.c_str();
  if (*next++ != '(') return false;
  while (*next != ')') {
    int count = 0, width = 0, length = 0;
    char letter = ' ';
    const bool is_group = std::sscanf(next, "%4d%c%4d%n", &count, &letter, &width, &length) == 3;
    const bool is_in_order = letter == 'i' ? format.others.empty() : letter == 'e' || letter == 'f' || letter == 'a';
    if (!is_group || !is_in_order || count < 1 || width < 1 || width > widest_column) return false;
    if (format.integers.size() + format.others.size() + static_cast<std::size_t>(count) > most_columns) return false;
    auto& columns = letter == 'i' ? format.integers : format.others;
    columns.insert(columns.end(), static_cast<std::size_t>(count), width);
    next += length;
    next += std::strspn(next, ".0123456789e");  // digits after the point, and in the exponent
    if (*next == ',') ++next;
  }
  return !format.integers.empty();
}

std::string column(const std::string& line, std::size_t begin, int width) {
  return begin < line.size() ? line.substr(begin, static_cast<std::size_t>(width)) : "";
}

std::string with_exponent(std::string number) {
  for (char& c : number) {
    if (c == 'd' || c == 'D') c = 'e';
  }
  const std::size_t sign = number.find_first_of("+-", 1);
  if (sign != std::string::npos && std::isdigit(static_cast<unsigned char>(number[sign - 1])) != 0) {
    number.insert(sign, "e");
  }
  return number;
}

}  // namespace perimorph::mesh_files
