#pragma once

#include <string>
#include <vector>

namespace perimorph::input {

/// A row of a table, and the line of the file in which it stands.
struct TableRow {
  int line;
  std::vector<double> numbers;  ///< as many as the table has columns
};

/// Reads numbers separated by commas (CSV), a row a line. The first line may name the columns; empty lines, and those
/// that begin with #, are passed over. Local.
/// @param columns what they hold, for messages
/// @throws UserError "file:line: what was found; what is allowed" at the first line that is no such row, or if the file
///         cannot be read.
std::vector<TableRow> read_table(const std::string& file, const std::vector<std::string>& columns);

}  // namespace perimorph::input
