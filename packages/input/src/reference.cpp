#include "perimorph/input/reference.hpp"

#include <fmt/format.h>

#include <Teuchos_Array.hpp>
#include <sstream>

#include "perimorph/input/literal.hpp"
#include "perimorph/input/rules.hpp"

namespace perimorph::input {

namespace {

using Teuchos::ParameterList;

/// The text broken into lines, each indented.
std::string wrapped(const std::string& text, const std::string& indent) {
  constexpr std::size_t width = 100;
  std::string all, line = indent;
  std::istringstream in(text);
  for (std::string word; in >> word;) {
    if (line.size() > indent.size() && line.size() + 1 + word.size() > width) {
      all += line + "\n";
      line = indent;
    }
    line += (line.size() > indent.size() ? " " : "") + word;
  }
  return all + line + "\n";
}

/// Whether the user must, may or need not give the parameter, and its default or an example between quotes.
std::string presence(const Teuchos::ParameterEntry& entry, const std::string& quote) {
  const std::string literal = to_literal(entry);
  const std::string value = quote + (literal.empty() ? "\"\"" : literal) + quote;
  switch (rule_of(entry).presence()) {
    case Presence::required:
      return "required, such as " + value;
    case Presence::optional:
      return "optional, such as " + value;
    default:
      return "default " + value;
  }
}

std::string describe_parameter(const std::string& path, const Teuchos::ParameterEntry& entry) {
  return fmt::format("{}\n    {}; {}; allowed is {}\n{}\n", path, type_of(entry), presence(entry, ""),
                     rule_of(entry).allowed(), wrapped(entry.docString(), "    "));
}

std::string describe_list(const ParameterList& list, const std::string& path) {
  std::string text;
  for (const auto& item : list) {
    const std::string here = path + "/" + item.first;
    if (item.second.isList()) {
      text += here + "/\n" + wrapped(item.second.docString(), "    ") + "\n" +
              describe_list(list.sublist(item.first), here);
    } else {
      text += describe_parameter(here, item.second);
    }
  }
  return text;
}

/// Text in a cell of a table, where "|", "*", "_", "<" and "[" would mean something.
std::string cell(const std::string& text) {
  std::string escaped;
  for (const char c : text)
    escaped += (std::string("|*_<[").find(c) == std::string::npos ? "" : "\\") + std::string(1, c);
  return escaped;
}

/// A heading and what the list is for, a table of its own parameters, then its sublists.
std::string markdown_of(const ParameterList& list, const std::string& path) {
  std::string rows, sublists;
  for (const auto& item : list) {
    const std::string &name = item.first, here = fmt::format("{}/{}", path, name);
    const Teuchos::ParameterEntry& entry = item.second;
    if (entry.isList()) {
      sublists +=
          fmt::format("\n## `{}`\n\n{}\n{}", here, cell(entry.docString()), markdown_of(list.sublist(name), here));
    } else {
      rows += fmt::format("| `{}` | {} | {} | {} | {} |\n", name, type_of(entry), presence(entry, "`"),
                          cell(rule_of(entry).allowed()), cell(entry.docString()));
    }
  }
  const std::string header = "\n| parameter | type | given | allowed | meaning |\n|---|---|---|---|---|\n";
  return (rows.empty() ? "" : header + rows) + sublists;
}

}  // namespace

std::string describe(const ParameterList& schema) { return describe_list(schema, ""); }

std::string describe_in_markdown(const ParameterList& schema) { return markdown_of(schema, ""); }

}  // namespace perimorph::input
