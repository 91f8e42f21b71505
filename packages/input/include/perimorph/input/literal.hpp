#pragma once

#include <Teuchos_ParameterEntry.hpp>
#include <optional>
#include <string>
#include <vector>

namespace perimorph::input {

/// The types of a case file: "int", "double", "bool", "string", "Array(int)", "Array(double)", "Array(string)".
const std::vector<std::string>& type_names();

/// The case file's name for the type of a value.
std::string type_of(const Teuchos::ParameterEntry& entry);

/// A value, if the whole text is a literal of the type and nothing else (Teuchos reads "abc" as 0 and "1e3" as 1).
std::optional<Teuchos::ParameterEntry> parse(const std::string& type, const std::string& text);

/// The type that a text without one looks like: int, double, bool, or else string.
std::string guess_type(const std::string& text);

/// What a literal looks like: "a number such as 1.5 or 2e-3".
std::string describe_literal(const std::string& type);

/// A value as one would write it in a case file.
std::string to_literal(const Teuchos::ParameterEntry& entry);

}  // namespace perimorph::input
