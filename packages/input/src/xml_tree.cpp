#include "xml_tree.hpp"

#include <algorithm>
#include <pugixml.hpp>

#include "perimorph/base/errors.hpp"
#include "perimorph/base/text.hpp"
#include "text_file.hpp"

namespace perimorph::input {

namespace {

constexpr std::size_t most_bytes = 16 << 20;
constexpr int most_levels = 32;
constexpr std::size_t longest_name = 200;

[[noreturn]] void refuse(const std::string& file, const std::string& why) {
  throw base::UserError(fmt::format("{}: {}", file, why));
}

std::string read_text(const std::string& file) {
  if (file.empty()) refuse("case file", "its name is empty");
  std::string text = text_of_file(file, "a case file (.xml)", most_bytes);
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) refuse(file, "is empty; a <ParameterList> is needed");
  if (text.find('\0') != std::string::npos) refuse(file, "is not a text file; XML in UTF-8 is needed");
  return text;
}

class Lines {
 public:
  explicit Lines(const std::string& text) {
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] == '\n') ends_.push_back(static_cast<std::ptrdiff_t>(i));
    }
  }

  /// Number from 1 of the line that holds a byte.
  int at(std::ptrdiff_t offset) const {
    return 1 + static_cast<int>(std::lower_bound(ends_.begin(), ends_.end(), offset) - ends_.begin());
  }

 private:
  std::vector<std::ptrdiff_t> ends_;
};

/// Turns the document into nodes and names what does not belong in it.
class Reader {
 public:
  Reader(const Lines& lines, Mistakes& mistakes) : lines_(lines), mistakes_(mistakes) {}

  /// @throws UserError if there is no root: every parameter would be missing.
  Node root(const pugi::xml_document& document) {
    Node root;
    root.is_list = true;
    root.line = 1;
    bool found = false, others = false;
    for (const auto& child : document.children()) {
      if (child.type() == pugi::node_declaration) continue;
      if (std::strcmp(child.name(), "ParameterList") != 0 || found) {
        add(child, "", "found " + what_is(child) + "; allowed is one <ParameterList> that holds everything");
        others = true;
        continue;
      }
      found = true;
      root.line = line(child);
      check_attributes(child, "", list_attributes);
      read_children(child, "", 1, root);
    }
    if (!found && !others) mistakes_.add(1, "", "there is no <ParameterList>; one that holds everything is needed");
    if (!found) mistakes_.report();
    return root;
  }

 private:
  inline static const std::vector<std::string> list_attributes{"name", "id", "docString"};
  // isDefault and isUsed are written by Teuchos: a resolved list can be read again.
  inline static const std::vector<std::string> parameter_attributes{"name", "type",      "value", "docString",
                                                                    "id",   "isDefault", "isUsed"};

  int line(const pugi::xml_node& node) const { return lines_.at(node.offset_debug()); }
  void add(const pugi::xml_node& node, const std::string& path, const std::string& what) {
    mistakes_.add(line(node), path, what);
  }

  static std::string what_is(const pugi::xml_node& node) {
    switch (node.type()) {
      case pugi::node_element:
        return "the tag " + in_quotes(node.name());
      case pugi::node_doctype:
        return "a document type (entities are not expanded)";
      default:
        return "the text " + in_quotes(node.value());
    }
  }

  void read_children(const pugi::xml_node& list, const std::string& path, int level, Node& parent) {
    for (const auto& child : list.children()) {
      const std::string tag = child.name();
      if (tag == "Parameter") {
        read_parameter(child, path, parent);
      } else if (tag == "ParameterList") {
        read_list(child, path, level, parent);
      } else if (tag != "Validators" || child.first_child()) {
        const std::string near = base::did_you_mean(tag.substr(0, longest_name), {"Parameter", "ParameterList"});
        add(child, path, "found " + what_is(child) + "; allowed are <Parameter .../> and <ParameterList ...>" + near);
      }
    }
  }

  void read_parameter(const pugi::xml_node& node, const std::string& path, Node& parent) {
    Node parameter;
    if (!read_name(node, path, parameter)) return;
    check_attributes(node, path + "/" + parameter.name, parameter_attributes);
    if (const auto type = node.attribute("type")) parameter.type = type.value();
    if (const auto value = node.attribute("value")) parameter.value = value.value();
    if (const auto inside = node.first_child()) {
      add(inside, path + "/" + parameter.name, "found " + what_is(inside) + " inside; allowed is value=\"...\" alone");
    }
    parent.children.push_back(std::move(parameter));
  }

  void read_list(const pugi::xml_node& node, const std::string& path, int level, Node& parent) {
    Node list;
    list.is_list = true;
    if (!read_name(node, path, list)) return;
    const std::string inner = path + "/" + list.name;
    check_attributes(node, inner, list_attributes);
    if (level == most_levels) {
      add(node, "", fmt::format("lists are nested too deeply; allowed are {} levels", most_levels));
    } else {
      read_children(node, inner, level + 1, list);
    }
    parent.children.push_back(std::move(list));
  }

  /// Without a name of sense there is nothing to know the node by: false.
  bool read_name(const pugi::xml_node& node, const std::string& path, Node& result) {
    result.name = node.attribute("name").value();
    result.line = line(node);
    const bool is_readable = result.name.size() <= longest_name && !base::has_control_characters(result.name);
    if (!result.name.empty() && is_readable) return true;
    add(node, path,
        result.name.empty() ? fmt::format("<{}> without a name; name=\"...\" is needed", node.name())
                            : fmt::format("found the name {}; allowed is a readable one of at most {} characters",
                                          in_quotes(result.name), longest_name));
    return false;
  }

  void check_attributes(const pugi::xml_node& node, const std::string& path, const std::vector<std::string>& known) {
    std::vector<std::string> seen;
    for (const auto& attribute : node.attributes()) {
      const std::string name = attribute.name();
      if (std::find(known.begin(), known.end(), name) == known.end()) {
        add(node, path,
            fmt::format("found the attribute {}; allowed are {}{}", in_quotes(name), base::quoted_list(known),
                        base::did_you_mean(name.substr(0, longest_name), known)));
      } else if (std::find(seen.begin(), seen.end(), name) != seen.end()) {
        add(node, path, fmt::format("found the attribute {} twice; allowed is once", in_quotes(name)));
      } else {
        seen.push_back(name);
      }
    }
  }

  const Lines& lines_;
  Mistakes& mistakes_;
};

std::vector<std::string> split(const std::string& path) {
  std::vector<std::string> parts(1);
  for (const char c : path) {
    if (c == '/') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

Node& child_called(Node& parent, const std::string& name, bool is_list) {
  for (auto& child : parent.children) {
    if (child.name == name && child.is_list == is_list) return child;
  }
  Node child;
  child.name = name;
  child.is_list = is_list;
  return parent.children.emplace_back(std::move(child));
}

}  // namespace

Node read_case_file(const std::string& file, Mistakes& mistakes) {
  const std::string text = read_text(file);
  const Lines lines(text);
  pugi::xml_document document;
  // As a fragment, so that text beside the root is seen, not skipped.
  const unsigned int options = pugi::parse_default | pugi::parse_declaration | pugi::parse_doctype |
                               pugi::parse_fragment | pugi::parse_trim_pcdata;
  const auto result = document.load_buffer(text.data(), text.size(), options, pugi::encoding_utf8);
  if (!result) {
    const int line = lines.at(result.offset);
    refuse(fmt::format("1 mistake in {0}\n{0}:{1}", file, line),
           fmt::format("the XML is broken here ({}); is a tag, a quote or a \"/>\" missing?", result.description()));
  }
  return Reader(lines, mistakes).root(document);
}

void apply_override(Node& root, const std::string& text, Mistakes& mistakes) {
  const auto equals = text.find('=');
  std::string path = text.substr(0, equals);
  if (!path.empty() && path[0] == '/') path.erase(0, 1);  // as messages write it
  const auto parts = split(path);
  const bool sound = std::all_of(parts.begin(), parts.end(),
                                 [](const std::string& part) { return !part.empty() && part.size() <= longest_name; });
  if (equals == std::string::npos || !sound || parts.size() > most_levels) {
    mistakes.add(command_line, "", fmt::format("found {}; allowed is \"Section/Sub/Name=value\"", in_quotes(text)));
    return;
  }
  Node* list = &root;
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) list = &child_called(*list, parts[i], true);
  Node& parameter = child_called(*list, parts.back(), false);
  parameter.value = text.substr(equals + 1);
  parameter.line = command_line;
}

}  // namespace perimorph::input
