#pragma once

#include <string>
#include <vector>

namespace perimorph::mesh_files {

std::string lower(std::string text);
std::string upper(std::string text);
std::string trimmed(const std::string& text);  ///< without blanks at its ends

/// The fields of a command, without blanks around them and without the comment after "!".
std::vector<std::string> fields_of(const std::string& line);

/// What a line such as (3i9,6e21.13e3) or (1i7,2i9,6e21.13e3) says: columns of whole numbers, then others.
struct ColumnFormat {
  std::vector<int> integers, others;  ///< widths of the columns
};

/// Returns whether the line is one that can be true.
bool parse_column_format(const std::string& line, ColumnFormat& format);

/// The part of a line that a column holds, "" beyond the line's end.
std::string column(const std::string& line, std::size_t begin, int width);

/// A number as std::from_chars reads it. ANSYS writes exponents with E, D, or, of three digits, without a letter:
/// "1.5-101".
std::string with_exponent(std::string number);

}  // namespace perimorph::mesh_files
