#pragma once

#include <optional>
#include <string>
#include <vector>

#include "perimorph/input/mistakes.hpp"

namespace perimorph::input {

/// A <Parameter> or <ParameterList> as it stands in the file, not yet understood.
struct Node {
  bool is_list = false;
  std::string name;
  std::optional<std::string> type, value;  ///< of a parameter
  int line = command_line;
  std::vector<Node> children;  ///< of a list
};

/// Reads the text of a case file strictly: no other tags, attributes or text than those of a Teuchos parameter list.
/// Entities are never expanded.
/// @throws UserError if there is no readable file or its XML is not well-formed.
Node read_case_file(const std::string& file, Mistakes& mistakes);

/// Puts "Section/Sub/Name=value" into the tree, creating what is not there.
void apply_override(Node& root, const std::string& text, Mistakes& mistakes);

}  // namespace perimorph::input
