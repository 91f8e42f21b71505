#include "perimorph/input/literal.hpp"

#include <fmt/format.h>

#include <Teuchos_Array.hpp>
#include <charconv>
#include <cmath>

#include "perimorph/base/errors.hpp"

namespace perimorph::input {

namespace {

using Teuchos::Array;
using Teuchos::ParameterEntry;

std::string trimmed(const std::string& text) {
  const char* blanks = " \t\r\n";
  const auto first = text.find_first_not_of(blanks);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// The standard's from_chars takes no "+", which is harmless.
template <class T>
std::optional<T> read_number(const std::string& text) {
  const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
  T value{};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data() + (plus ? 1 : 0), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

template <class T>
std::optional<T> read(const std::string& text);

template <>
std::optional<int> read<int>(const std::string& text) {
  return read_number<int>(trimmed(text));
}

template <>
std::optional<double> read<double>(const std::string& text) {
  const auto value = read_number<double>(trimmed(text));
  return value && std::isfinite(*value) ? value : std::nullopt;
}

template <>
std::optional<bool> read<bool>(const std::string& text) {
  const std::string word = trimmed(text);
  if (word == "true") return true;
  if (word == "false") return false;
  return std::nullopt;
}

template <>
std::optional<std::string> read<std::string>(const std::string& text) {
  return text;
}

/// "{a, b}": the texts between the commas, without the blanks around them; none may be empty.
std::optional<std::vector<std::string>> items(const std::string& text) {
  const std::string braced = trimmed(text);
  if (braced.size() < 2 || braced.front() != '{' || braced.back() != '}') return std::nullopt;
  const std::string inside = trimmed(braced.substr(1, braced.size() - 2));
  std::vector<std::string> found;
  if (inside.empty()) return found;
  for (std::size_t first = 0; first <= inside.size();) {
    const std::size_t comma = std::min(inside.find(',', first), inside.size());
    found.push_back(trimmed(inside.substr(first, comma - first)));
    if (found.back().empty() || found.back().find_first_of("{}") != std::string::npos) return std::nullopt;
    first = comma + 1;
  }
  return found;
}

template <class T>
std::optional<ParameterEntry> read_entry(const std::string& text) {
  const auto value = read<T>(text);
  if (!value) return std::nullopt;
  return ParameterEntry(*value);
}

template <class T>
std::optional<ParameterEntry> read_array(const std::string& text) {
  const auto texts = items(text);
  if (!texts) return std::nullopt;
  Array<T> values;
  for (const auto& item : *texts) {
    const auto value = read<T>(item);
    if (!value) return std::nullopt;
    values.push_back(*value);
  }
  return ParameterEntry(values);
}

template <class T>
std::string write(const T& value) {
  return fmt::format("{}", value);
}

template <class T>
std::string write(const Array<T>& values) {
  std::string list;
  for (const auto& value : values) list += (list.empty() ? "" : ", ") + write(value);
  return "{" + list + "}";
}

template <class T>
std::string write_entry(const ParameterEntry& entry) {
  return write(Teuchos::getValue<T>(entry));
}

template <class T>
bool is(const ParameterEntry& entry) {
  return entry.isType<T>();
}

struct Type {
  const char* name;
  const char* literal;
  bool (*is)(const ParameterEntry&);
  std::optional<ParameterEntry> (*read)(const std::string&);
  std::string (*write)(const ParameterEntry&);
};

const Type types[] = {
    {"int", "a whole number such as 12", is<int>, read_entry<int>, write_entry<int>},
    {"double", "a number such as 1.5 or 2e-3", is<double>, read_entry<double>, write_entry<double>},
    {"bool", "true or false", is<bool>, read_entry<bool>, write_entry<bool>},
    {"string", "a text", is<std::string>, read_entry<std::string>, write_entry<std::string>},
    {"Array(int)", "whole numbers such as {1, 2}", is<Array<int>>, read_array<int>, write_entry<Array<int>>},
    {"Array(double)", "numbers such as {1.5, 2e-3}", is<Array<double>>, read_array<double>, write_entry<Array<double>>},
    {"Array(string)", "texts such as {left, right}", is<Array<std::string>>, read_array<std::string>,
     write_entry<Array<std::string>>}};

const Type& type_called(const std::string& name) {
  for (const auto& type : types) {
    if (name == type.name) return type;
  }
  throw base::Bug("no such type: " + name);
}

}  // namespace

const std::vector<std::string>& type_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const auto& type : types) all.emplace_back(type.name);
    return all;
  }();
  return names;
}

std::string type_of(const ParameterEntry& entry) {
  for (const auto& type : types) {
    if (type.is(entry)) return type.name;
  }
  throw base::Bug("a parameter of a type that a case file does not know");
}

std::optional<ParameterEntry> parse(const std::string& type, const std::string& text) {
  return type_called(type).read(text);
}

std::string guess_type(const std::string& text) {
  for (const char* type : {"int", "double", "bool"}) {
    if (parse(type, text)) return type;
  }
  return "string";
}

std::string describe_literal(const std::string& type) { return type_called(type).literal; }

std::string to_literal(const ParameterEntry& entry) { return type_called(type_of(entry)).write(entry); }

}  // namespace perimorph::input
