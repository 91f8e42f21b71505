#pragma once

#include <string>
#include <vector>

#include "perimorph/input/section.hpp"
#include "perimorph/input/table.hpp"

namespace perimorph::cases {

/// The course of a condition within a stage, from a file.
struct LoadTable {
  std::string name;                   ///< of the condition
  std::string file;                   ///< relative to the case file's folder
  std::vector<input::TableRow> rows;  ///< {time [any unit], what the condition's rate is multiplied by [-]}
};

void declare(const input::Section& section, LoadTable& table);

/// The rows of a file. Local.
/// @throws UserError that names file and line if they are no course: fewer than two, or times that do not rise.
std::vector<input::TableRow> read_load_table(const std::string& file);

}  // namespace perimorph::cases
