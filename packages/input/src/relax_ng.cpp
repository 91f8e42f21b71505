// The schema in RELAX NG, by which editors complete and check case files as one types.

#include <Teuchos_Array.hpp>
#include <pugixml.hpp>
#include <sstream>

#include "perimorph/input/literal.hpp"
#include "perimorph/input/reference.hpp"
#include "perimorph/input/rules.hpp"

namespace perimorph::input {

namespace {

using Teuchos::ParameterList;

constexpr const char* number = "[+-]?([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][+-]?[0-9]+)?";
constexpr const char* whole = "[+-]?[0-9]+";
constexpr const char* text_in_array = "[^{},]*[^{}, \\t\\r\\n][^{},]*";

/// "{a, b}" with such items.
std::string array_of(const std::string& item) { return "\\{\\s*(" + item + "(\\s*,\\s*" + item + ")*)?\\s*\\}"; }

/// What a literal of a type looks like, as a regular expression; "" for any text. Blanks around it are collapsed.
std::string pattern_of(const std::string& type) {
  if (type == "int") return whole;
  if (type == "double") return number;
  if (type == "bool") return "true|false";
  if (type == "Array(int)") return array_of(std::string("(") + whole + ")");
  if (type == "Array(double)") return array_of(std::string("(") + number + ")");
  if (type == "Array(string)") return array_of(std::string("(") + text_in_array + ")");
  return "";
}

pugi::xml_node append(pugi::xml_node parent, const char* tag, const std::string& name = "") {
  auto node = parent.append_child(tag);
  if (!name.empty()) node.append_attribute("name") = name.c_str();
  return node;
}

void append_text(pugi::xml_node parent, const char* tag, const std::string& text) {
  parent.append_child(tag).append_child(pugi::node_pcdata).set_value(text.c_str());
}

void append_pattern(pugi::xml_node parent, const std::string& pattern) {
  if (pattern.empty()) {
    append(parent, "text");
    return;
  }
  auto data = append(parent, "data");
  data.append_attribute("type") = "token";
  append(data, "param", "pattern").append_child(pugi::node_pcdata).set_value(pattern.c_str());
}

/// An element "ParameterList" or "Parameter" with its name: a certain one, or for "*" any without "/", "=" and "*".
pugi::xml_node append_element(pugi::xml_node parent, const char* tag, const std::string& name,
                              const std::string& documentation) {
  auto element = append(parent, "element", tag);
  if (!documentation.empty()) append_text(element, "a:documentation", documentation);
  auto attribute = append(element, "attribute", "name");
  if (name == "*") {
    append_pattern(attribute, "[^/=*]+");
  } else {
    auto value = append(attribute, "value");
    value.append_attribute("type") = "string";
    value.append_child(pugi::node_pcdata).set_value(name.c_str());
  }
  append(element, "ref", tag == std::string("Parameter") ? "ofParameters" : "ofLists");
  return element;
}

void append_parameter(pugi::xml_node parent, const std::string& name, const Teuchos::ParameterEntry& entry) {
  const Rule& rule = rule_of(entry);
  auto element = append_element(parent, "Parameter", name, entry.docString() + " Allowed is " + rule.allowed() + ".");
  append_text(append(element, "attribute", "type"), "value", type_of(entry));
  auto value = append(element, "attribute", "value");
  if (rule.choices().empty()) {
    append_pattern(value, pattern_of(type_of(entry)));
    return;
  }
  auto choice = append(value, "choice");
  for (const auto& word : rule.choices()) append_text(choice, "value", word);
}

/// The members of a list, in any order. That one is there, and not twice, RELAX NG cannot say of elements that have one
/// tag and differ in an attribute.
void append_members(pugi::xml_node parent, const ParameterList& list) {
  auto members = append(append(parent, "zeroOrMore"), "choice");
  append(members, "ref", "validators");
  if (list.numParams() == 0) append(members, "ref", "anything");
  for (const auto& item : list) {
    const std::string& name = item.first;
    if (item.second.isList()) {
      append_members(append_element(members, "ParameterList", name, item.second.docString()), list.sublist(name));
    } else {
      append_parameter(members, name, item.second);
    }
  }
}

/// Lists that are handed on as they are: any names, any of the types.
void define_anything(pugi::xml_node grammar) {
  auto choice = append(append(grammar, "define", "anything"), "choice");
  auto list = append(choice, "element", "ParameterList");
  append(list, "attribute", "name");
  append(list, "ref", "ofLists");
  append(append(list, "zeroOrMore"), "ref", "anything");
  for (const auto& type : type_names()) {
    auto parameter = append(choice, "element", "Parameter");
    append(parameter, "attribute", "name");
    append(parameter, "ref", "ofParameters");
    append_text(append(parameter, "attribute", "type"), "value", type);
    append_pattern(append(parameter, "attribute", "value"), pattern_of(type));
  }
}

/// Attributes that Teuchos writes into resolved.xml, and its empty list of validators.
void define_extras(pugi::xml_node grammar) {
  for (const auto& [define, names] : std::vector<std::pair<const char*, std::vector<const char*>>>{
           {"ofLists", {"id", "docString"}}, {"ofParameters", {"id", "docString", "isDefault", "isUsed"}}}) {
    auto extras = append(grammar, "define", define);
    for (const char* name : names) append(append(extras, "optional"), "attribute", name);
  }
  append(append(append(grammar, "define", "validators"), "element", "Validators"), "empty");
}

}  // namespace

std::string describe_in_relax_ng(const ParameterList& schema) {
  pugi::xml_document document;
  auto grammar = append(document, "grammar");
  grammar.append_attribute("xmlns") = "http://relaxng.org/ns/structure/1.0";
  grammar.append_attribute("xmlns:a") = "http://relaxng.org/ns/compatibility/annotations/1.0";
  grammar.append_attribute("datatypeLibrary") = "http://www.w3.org/2001/XMLSchema-datatypes";
  auto root = append(append(grammar, "start"), "element", "ParameterList");
  append(append(root, "optional"), "attribute", "name");
  append(root, "ref", "ofLists");
  append_members(root, schema);
  define_anything(grammar);
  define_extras(grammar);
  std::ostringstream text;
  document.save(text, "  ");
  return text.str();
}

}  // namespace perimorph::input
