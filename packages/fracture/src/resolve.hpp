#pragma once

#include <Teuchos_ParameterList.hpp>
#include <map>
#include <string>

#include "case_file.hpp"
#include "mistakes.hpp"

namespace perimorph::fracture {

/// The values of a case in the order of the schema, defaults filled in, without documentation. What has no value, or a
/// wrong one, is not there.
struct Resolved {
  Teuchos::ParameterList list;
  std::map<std::string, int> lines;  ///< "/Section/Name" -> where it was given

  bool given(const std::string& path) const { return lines.count(path) > 0; }
  int line(const std::string& path) const { return line_of(lines, path); }
};

/// Compares what was found with the schema, one parameter at a time.
Resolved resolve(const Node& root, const Teuchos::ParameterList& schema, Mistakes& mistakes);

}  // namespace perimorph::fracture
