#include "perimorph/cases/load_table.hpp"

#include <cmath>

#include "perimorph/base/errors.hpp"

namespace perimorph::cases {

void declare(const input::Section& section, LoadTable& table) {
  section.changeable().required(
      "File", table.file, "press.csv", input::file_name(),
      "Rows of a time and a value, separated by a comma, by rising times; relative to the case file's folder. The "
      "first line may name the columns, and those that begin with # are remarks. The first time is the beginning of "
      "the step and the last its end, in any unit; increments between them divide it evenly. The value is what the "
      "Rate is multiplied by [-], linear between rows; it begins with what that was before.");
}

std::vector<input::TableRow> read_load_table(const std::string& file) {
  auto rows = input::read_table(file, {"time", "value"});
  if (rows.size() < 2) {
    throw base::UserError(fmt::format("{}: found {} of a time and a value; allowed are at least 2", file,
                                      rows.size() == 1 ? "1 row" : "no row"));
  }
  const double whole = rows.back().numbers[0] - rows.front().numbers[0];
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double before = rows[i - 1].numbers[0], time = rows[i].numbers[0];
    if (time > before && time - before >= 1e-9 * whole && std::isfinite(whole)) continue;
    throw base::UserError(fmt::format(
        "{}:{}: found the time {} after {}; allowed are times that rise, each by at least 1e-9 of the whole", file,
        rows[i].line, time, before));
  }
  return rows;
}

}  // namespace perimorph::cases
