#include "perimorph/input/resolved.hpp"

#include <algorithm>
#include <set>

#include "perimorph/base/errors.hpp"
#include "perimorph/base/text.hpp"
#include "perimorph/input/literal.hpp"
#include "perimorph/input/rules.hpp"
#include "xml_tree.hpp"

namespace perimorph::input {

namespace {

using Teuchos::ParameterEntry;
using Teuchos::ParameterList;

std::vector<std::string> names_in(const ParameterList& schema) {
  std::vector<std::string> names;
  for (const auto& item : schema) names.push_back(item.first);
  return names;
}

const Node* find(const Node& list, const std::string& name, bool is_list) {
  for (const auto& child : list.children) {
    if (child.name == name && child.is_list == is_list) return &child;
  }
  return nullptr;
}

class Resolver {
 public:
  Resolver(Resolved& result, Mistakes& mistakes) : result_(result), mistakes_(mistakes) {}

  /// One list against its declaration: free-form (nothing declared), entries named by the user ("*"), or parameters.
  void list(const Node& found, const ParameterList& schema, const std::string& path, ParameterList& out) {
    if (schema.numParams() == 0) {
      free_form(found, path, out);
    } else if (schema.isSublist("*")) {
      entries(found, schema.sublist("*"), path, out);
    } else {
      check_names(found, schema, path);
      for (const auto& item : schema) declared(found, item.first, item.second, path, out);
    }
  }

 private:
  void check_names(const Node& found, const ParameterList& schema, const std::string& path) {
    const auto known = names_in(schema);
    std::set<std::string> seen;
    for (const auto& child : found.children) {
      const std::string here = path + "/" + child.name;
      if (!schema.isParameter(child.name)) {
        mistakes_.add(child.line, here,
                      fmt::format("unknown {}; allowed are {}{}", child.is_list ? "section" : "parameter",
                                  base::quoted_list(known), base::did_you_mean(child.name, known)));
      } else if (child.is_list != schema.isSublist(child.name)) {
        mistakes_.add(child.line, here,
                      child.is_list ? "found a <ParameterList>; allowed is a <Parameter>"
                                    : "found a <Parameter>; allowed is a <ParameterList>");
      } else {
        require_first(child, here, seen);
      }
    }
  }

  bool require_first(const Node& child, const std::string& path, std::set<std::string>& seen) {
    const bool first = seen.insert(child.name).second;
    if (!first) mistakes_.add(child.line, path, "given twice; allowed is once");
    return first;
  }

  void declared(const Node& found, const std::string& name, const ParameterEntry& declaration, const std::string& path,
                ParameterList& out) {
    const std::string here = path + "/" + name;
    const Node* child = find(found, name, declaration.isList());
    if (child != nullptr) result_.lines.emplace(here, child->line);
    if (declaration.isList()) {
      static const Node nothing;
      list(child != nullptr ? *child : nothing, Teuchos::getValue<ParameterList>(declaration), here, out.sublist(name));
    } else if (child != nullptr) {
      given(*child, declaration, here, out);
    } else {
      absent(name, declaration, here, out);
    }
  }

  void absent(const std::string& name, const ParameterEntry& declaration, const std::string& path, ParameterList& out) {
    const Rule& rule = rule_of(declaration);
    if (rule.presence() == Presence::required) {
      mistakes_.add(result_.line(path), path, fmt::format("missing; needed is {}", rule.allowed()));
    } else if (rule.presence() == Presence::defaulted) {
      out.setEntry(name, ParameterEntry(declaration.getAny(false), true));
    }
  }

  void given(const Node& found, const ParameterEntry& declaration, const std::string& path, ParameterList& out) {
    const std::string type = type_of(declaration);
    if (found.line != command_line && found.type != type) {
      const std::string what = found.type ? fmt::format("found type={}", in_quotes(*found.type)) : "found no type";
      mistakes_.add(found.line, path, fmt::format("{}; write type=\"{}\"", what, type));
      return;
    }
    const Rule& rule = rule_of(declaration);
    const auto entry = value(found, type, rule.allowed(), path);
    if (!entry) return;
    if (rule.accepts(*entry)) {
      out.setEntry(found.name, *entry);
    } else {
      mistakes_.add(found.line, path,
                    fmt::format("found {}; allowed is {}{}", in_quotes(*found.value), rule.allowed(),
                                base::did_you_mean(found.value->substr(0, 100), rule.choices())));
    }
  }

  std::optional<ParameterEntry> value(const Node& found, const std::string& type, const std::string& allowed,
                                      const std::string& path) {
    if (!found.value) {
      mistakes_.add(found.line, path, "found no value; write value=\"...\" with " + allowed);
      return std::nullopt;
    }
    auto entry = parse(type, *found.value);
    if (!entry) {
      mistakes_.add(found.line, path,
                    fmt::format("found {}, which is not {}; allowed is {}", in_quotes(*found.value),
                                describe_literal(type), allowed));
    }
    return entry;
  }

  /// Entries that the user names, such as the seeds.
  void entries(const Node& found, const ParameterList& schema, const std::string& path, ParameterList& out) {
    std::set<std::string> seen;
    for (const auto& child : found.children) {
      const std::string here = path + "/" + child.name;
      if (!child.is_list) {
        mistakes_.add(child.line, here,
                      "found a <Parameter>; allowed are only lists of parameters, with names of your choice");
      } else if (child.name.find_first_of("/=*") != std::string::npos) {
        mistakes_.add(child.line, here, "found a name with \"/\", \"=\" or \"*\"; allowed are names without these");
      } else if (require_first(child, here, seen)) {
        result_.lines.emplace(here, child.line);
        list(child, schema, here, out.sublist(child.name));
      }
    }
  }

  /// Lists handed on to Belos and MueLu, which check the names themselves.
  void free_form(const Node& found, const std::string& path, ParameterList& out) {
    std::set<std::string> seen;
    for (const auto& child : found.children) {
      const std::string here = path + "/" + child.name;
      if (!require_first(child, here, seen)) continue;
      result_.lines.emplace(here, child.line);
      if (child.is_list) {
        free_form(child, here, out.sublist(child.name));
      } else {
        free_parameter(child, here, out);
      }
    }
  }

  void free_parameter(const Node& found, const std::string& path, ParameterList& out) {
    const bool untyped = !found.type && found.line == command_line;
    const std::string type = untyped ? guess_type(*found.value) : found.type.value_or("");
    const auto& known = type_names();
    if (std::find(known.begin(), known.end(), type) == known.end()) {
      const std::string what = found.type ? fmt::format("found type={}", in_quotes(type)) : "found no type";
      mistakes_.add(found.line, path,
                    fmt::format("{}; allowed are {}{}", what, base::quoted_list(known),
                                base::did_you_mean(type.substr(0, 100), known)));
      return;
    }
    const auto entry = value(found, type, describe_literal(type), path);
    if (entry) out.setEntry(found.name, *entry);
  }

  Resolved& result_;
  Mistakes& mistakes_;
};

std::string line_of(const std::string& path, const ParameterEntry& value) {
  return fmt::format("{} = {}\n", path, to_literal(value));
}

/// In one line, whatever names and texts hold.
std::string in_one_line(const std::string& text) {
  std::string line;
  for (const char c : text) {
    if (c == '\n' || c == '\\') line += '\\';
    line += c == '\n' ? 'n' : c;
  }
  return line;
}

}  // namespace

Resolved read(const std::string& file, const std::vector<std::string>& overrides, const ParameterList& schema,
              Mistakes& mistakes) {
  Node root = read_case_file(file, mistakes);
  for (const auto& text : overrides) apply_override(root, text, mistakes);
  Resolved result;
  result.list.setName(schema.name());
  result.lines.emplace("", root.line);
  Resolver(result, mistakes).list(root, schema, "", result.list);
  return result;
}

std::string listing(const ParameterList& list, const std::string& path) {
  std::string text;
  for (const auto& item : list) {
    const std::string full = path + "/" + item.first;
    text += item.second.isList() ? listing(list.sublist(item.first), full) : line_of(full, item.second);
  }
  return text;
}

std::string deciding_listing(const ParameterList& list, const ParameterList& schema, const std::string& path) {
  std::string text;
  for (const auto& item : list) {
    const std::string full = path + "/" + item.first;
    const std::string declared = schema.isSublist("*") ? "*" : item.first;
    if (!schema.isParameter(declared)) continue;  // handed on as it is
    if (item.second.isList()) {
      text += deciding_listing(list.sublist(item.first), schema.sublist(declared), full);
    } else if (!rule_of(schema.getEntry(declared)).is_changeable()) {
      text += in_one_line(fmt::format("{} = {}", full, to_literal(item.second))) + '\n';
    }
  }
  return text;
}

}  // namespace perimorph::input
