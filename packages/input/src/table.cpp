#include "perimorph/input/table.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "perimorph/base/errors.hpp"
#include "perimorph/input/literal.hpp"
#include "perimorph/input/mistakes.hpp"
#include "text_file.hpp"

namespace perimorph::input {

namespace {

constexpr std::size_t most_bytes = 1 << 20;

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
  if (line.back() == ',') fields.emplace_back();  // which getline leaves out
  return fields;
}

/// Nothing where a field is no number.
std::vector<std::optional<double>> numbers_in(const std::string& line) {
  std::vector<std::optional<double>> numbers;
  for (const auto& field : fields_of(line)) {
    const auto entry = parse("double", field);
    numbers.push_back(entry ? std::optional(Teuchos::getValue<double>(*entry)) : std::nullopt);
  }
  return numbers;
}

bool says_nothing(const std::string& line) {
  const auto first = line.find_first_not_of(" \t\r");
  return first == std::string::npos || line[first] == '#';
}

/// @param where "file:line", for messages
std::vector<double> complete(const std::vector<std::optional<double>>& found, const std::vector<std::string>& columns,
                             const std::string& where, const std::string& line) {
  const bool all_are_numbers = std::all_of(found.begin(), found.end(), [](const auto& n) { return n.has_value(); });
  if (found.size() != columns.size() || !all_are_numbers) {
    throw base::UserError(fmt::format("{}: found {}; allowed are {} numbers, separated by commas: {}", where,
                                      in_quotes(line), columns.size(), fmt::join(columns, ", ")));
  }
  std::vector<double> numbers;
  for (const auto& number : found) numbers.push_back(*number);
  return numbers;
}

}  // namespace

std::vector<TableRow> read_table(const std::string& file, const std::vector<std::string>& columns) {
  std::string text = text_of_file(file, "a table (.csv)", most_bytes);
  constexpr const char* byte_order_mark = "\xEF\xBB\xBF";
  if (text.rfind(byte_order_mark, 0) == 0) text.erase(0, 3);
  std::istringstream in(text);
  std::vector<TableRow> rows;
  bool may_name_columns = true;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (says_nothing(line)) continue;
    const auto found = numbers_in(line);
    const bool has_numbers = std::any_of(found.begin(), found.end(), [](const auto& n) { return n.has_value(); });
    if (!std::exchange(may_name_columns, false) || has_numbers) {
      rows.push_back({number, complete(found, columns, fmt::format("{}:{}", file, number), line)});
    }
  }
  return rows;
}

}  // namespace perimorph::input
