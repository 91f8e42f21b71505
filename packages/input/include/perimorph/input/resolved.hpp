#pragma once

#include <Teuchos_ParameterList.hpp>
#include <map>
#include <string>
#include <vector>

#include "perimorph/input/mistakes.hpp"

namespace perimorph::input {

/// The values of a case in the order of the schema, defaults filled in, without documentation. What has no value, or a
/// wrong one, is not there.
struct Resolved {
  Teuchos::ParameterList list;
  std::map<std::string, int> lines;  ///< "/Section/Name" -> where it was given

  bool given(const std::string& path) const { return lines.count(path) > 0; }
  int line(const std::string& path) const { return line_of(lines, path); }
};

/// Reads a case file and compares it with the schema, one parameter at a time. Local.
/// @param overrides "Section/Sub/Name=value" each, as if the file said so
/// @param schema a rule (rules.hpp) for each parameter. A sublist with one entry "*" stands for entries that the user
///        names, one without entries takes anything
/// @param mistakes to which those are added that were found
/// @throws UserError if there is no readable file or its XML is not well-formed
Resolved read(const std::string& file, const std::vector<std::string>& overrides, const Teuchos::ParameterList& schema,
              Mistakes& mistakes);

/// The values of a list: "/Section/Sub/Name = value", a line each. Local.
std::string listing(const Teuchos::ParameterList& list, const std::string& path = "");

/// The same, but only what the schema does not let a run change when it goes on from a checkpoint. What is handed on as
/// it is, it may change. Local.
std::string deciding_listing(const Teuchos::ParameterList& list, const Teuchos::ParameterList& schema,
                             const std::string& path = "");

}  // namespace perimorph::input
