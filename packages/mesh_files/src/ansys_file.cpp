// Archives of ANSYS (CDWRITE, blocked) and the input files of its Workbench: the commands ET, ETBLOCK, KEYOPT, TYPE,
// NBLOCK, EBLOCK and CMBLOCK of its Command Reference.

#include "ansys_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>

#include "ansys_elements.hpp"
#include "file_cursor.hpp"
#include "perimorph/base/errors.hpp"
#include "text_fields.hpp"

namespace perimorph::mesh_files {

namespace {

const char* const advice = "write PLANE182 elements for a 2D case, SOLID185 for a 3D one";

// Which field of a line of EBLOCK, SOLID is what.
constexpr std::size_t material_field = 0, type_field = 1, count_field = 8, number_field = 10, n_fields = 11;

using Nodes = std::vector<std::int64_t>;

class Reader {
 public:
  explicit Reader(const std::string& file) : cursor_(file, "an ANSYS archive") {
    result_.name = file;
    result_.advice = advice;
    result_.sides_follow_from_node_sets = true;
  }

  MeshFile read() {
    while (!cursor_.at_end()) read_command();
    if (!has_nodes_ || !has_elements_) {
      cursor_.fail(
          fmt::format("the file ends without {}: it is truncated, or no archive that CDWRITE wrote in blocked form",
                      has_nodes_ ? "EBLOCK" : "NBLOCK"));
    }
    sorted_tags_ = result_.node_tags;
    std::sort(sorted_tags_.begin(), sorted_tags_.end());
    add_blocks();
    add_node_sets();
    note_what_was_passed_over();
    return std::move(result_);
  }

 private:
  /// A component: runs of numbers, first and last, ascending.
  struct Component {
    std::string name;
    std::vector<std::pair<std::int64_t, std::int64_t>> runs;
  };

  void read_command() {
    const std::vector<std::string> fields = fields_of(cursor_.line());
    const std::string command = lower(fields[0]);
    if (command == "et") {
      read_element_type(fields);
    } else if (command == "etblock") {
      read_element_types();
    } else if (command == "keyop" || command == "keyopt" || command == "keyo") {
      read_option(fields);
    } else if (command == "type") {
      current_type_ = fields.size() > 1 ? number_or_parameter(fields[1]).value_or(0) : 0;
    } else if (command == "*set") {
      read_parameter(fields);
    } else if (command == "nblock") {
      read_nodes();
    } else if (command == "eblock") {
      read_elements(fields);
    } else if (command == "cmblock") {
      read_component(fields);
    }
  }

  // ---- numbers ----

  std::int64_t whole_number(const std::string& text) const {
    const std::string digits = trimmed(text);
    std::int64_t value = 0;
    if (!parse_number(digits, value)) {
      cursor_.fail(fmt::format("a whole number expected, found \"{}\"", excerpt(digits)));
    }
    return value;
  }

  double real_number(const std::string& text) const {
    const std::string digits = trimmed(text);
    double value = 0.;
    if (digits.empty()) return value;
    if (!parse_number(with_exponent(digits), value) || !std::isfinite(value)) {
      cursor_.fail(fmt::format("a number expected, found \"{}\"", excerpt(digits)));
    }
    return value;
  }

  /// The count in a command's field, -1 if there is none.
  std::int64_t announced(const std::vector<std::string>& fields, std::size_t field) const {
    return field < fields.size() && !fields[field].empty() ? whole_number(fields[field]) : -1;
  }

  void check_total(const char* what, std::int64_t expected, std::size_t found) const {
    if (expected <= 0 || static_cast<std::size_t>(expected) == found) return;
    cursor_.fail(fmt::format("{} {} announced, {} found: the file is damaged", expected, what, found));
  }

  ColumnFormat read_format() {
    const std::string line = cursor_.line();
    ColumnFormat format;
    if (!parse_column_format(line, format)) {
      cursor_.fail(fmt::format("a format such as (3i9,6e21.13e3) expected, found \"{}\"", excerpt(lower(line))));
    }
    return format;
  }

  /// The next line of a block.
  std::string data_line() {
    if (cursor_.at_end_of_text()) cursor_.fail_truncated();
    return cursor_.raw_line();
  }

  /// The whole numbers of a line, up to its end.
  std::vector<std::int64_t> integers(const std::string& line, const ColumnFormat& format) const {
    std::vector<std::int64_t> values;
    std::size_t begin = 0;
    for (const int width : format.integers) {
      const std::string text = column(line, begin, width);
      if (trimmed(text).empty()) break;
      values.push_back(whole_number(text));
      begin += static_cast<std::size_t>(width);
    }
    return values;
  }

  // ---- nodes and elements ----

  /// ET, number, kind (182 or PLANE182), key options
  void read_element_type(const std::vector<std::string>& fields) {
    if (fields.size() < 3) cursor_.fail("ET without a number and an element type");
    const std::string digits = fields[2].substr(std::min(fields[2].find_first_of("0123456789"), fields[2].size()));
    if (const auto number = number_or_parameter(fields[1])) {
      const auto option = [&](std::size_t field) {
        return fields.size() > field ? static_cast<int>(number_or_parameter(fields[field]).value_or(0)) : 0;
      };
      types_[*number] = {static_cast<int>(whole_number(digits) % 100000), option(3), option(5)};
    }
  }

  /// KEYOPT, type, which, value
  void read_option(const std::vector<std::string>& fields) {
    if (fields.size() < 4) return;
    const auto type = types_.find(number_or_parameter(fields[1]).value_or(0));
    if (type == types_.end()) return;
    const auto which = number_or_parameter(fields[2]);
    const int value = static_cast<int>(number_or_parameter(fields[3]).value_or(0));
    if (which == 1) type->second.first_option = value;
    if (which == 3) type->second.third_option = value;
  }

  /// *SET, name, value: Workbench names types of contact elements so.
  void read_parameter(const std::vector<std::string>& fields) {
    std::int64_t value = 0;
    if (fields.size() > 2 && parse_number(fields[2], value)) parameters_[lower(fields[1])] = value;
  }

  std::optional<std::int64_t> number_or_parameter(const std::string& field) const {
    std::int64_t value = 0;
    if (parse_number(field, value)) return value;
    const auto parameter = parameters_.find(lower(field));
    return parameter == parameters_.end() ? std::nullopt : std::optional(parameter->second);
  }

  /// Since ANSYS 2019: number, kind, key options (as text), a line each.
  void read_element_types() {
    const ColumnFormat format = read_format();
    for (;;) {
      const std::string line = data_line();
      const std::vector<std::int64_t> numbers = integers(line, format);
      if (numbers.empty() || numbers[0] == -1) return;
      if (numbers.size() < 2) cursor_.fail("ETBLOCK has a line without a number and an element type");
      const int width = format.others.empty() ? format.integers.back() : format.others[0];
      const auto option = [&](int which) {
        const int begin = format.integers[0] + format.integers[1] + (which - 1) * width;
        const std::string text = trimmed(column(line, static_cast<std::size_t>(begin), width));
        return static_cast<int>(number_or_parameter(text).value_or(0));
      };
      types_[numbers[0]] = {static_cast<int>(numbers[1] % 100000), option(1), option(3)};
    }
  }

  /// The command's counts are upper bounds.
  void read_nodes() {
    const ColumnFormat format = read_format();
    const int first_real = std::accumulate(format.integers.begin(), format.integers.end(), 0);
    for (;;) {
      const std::string line = data_line();
      const std::string start = trimmed(line);
      if (start.rfind("-1", 0) == 0 || start.rfind("N,", 0) == 0 || start.rfind("n,", 0) == 0) break;
      result_.node_tags.push_back(whole_number(column(line, 0, format.integers[0])));
      auto& point = result_.coordinates.emplace_back();
      auto begin = static_cast<std::size_t>(first_real);
      for (std::size_t d = 0; d < std::min(point.size(), format.others.size()); ++d) {
        point[d] = real_number(column(line, begin, format.others[d]));
        begin += static_cast<std::size_t>(format.others[d]);
      }
    }
    has_nodes_ = true;
  }

  void read_elements(const std::vector<std::string>& fields) {
    if (fields.size() < 3 || lower(fields[2]) != "solid") return pass_over_elements();
    const ColumnFormat format = read_format();
    const std::size_t before = n_elements();
    for (;;) {
      const std::vector<std::int64_t> line = integers(data_line(), format);
      if (!line.empty() && line[0] == -1) break;
      if (line.size() < n_fields) {
        cursor_.fail(fmt::format("an element with {} fields; {} and its nodes are needed", line.size(), n_fields));
      }
      read_element(line, format);
    }
    check_total("elements", announced(fields, 4), n_elements() - before);
    has_elements_ = true;
  }

  /// Of this file so far, also those that are passed over.
  std::size_t n_elements() const {
    std::size_t n = result_.n_elements();
    for (const auto& [kind, count] : passed_over_) n += count;
    return n;
  }

  /// A block without SOLID is all of the type that the command TYPE names, or else its lines do.
  void pass_over_elements() {
    const ColumnFormat format = read_format();
    for (;;) {
      const std::vector<std::int64_t> line = integers(data_line(), format);
      if (!line.empty() && line[0] == -1) return;
      const bool is_named = types_.count(current_type_) > 0 || line.size() <= type_field;
      const auto type = types_.find(is_named ? current_type_ : line[type_field]);
      if (type == types_.end() || !is_without_body(type->second)) {
        cursor_.fail(
            fmt::format("EBLOCK without SOLID, of ANSYS' element type {}; allowed in such a block are surface, contact "
                        "and other elements without a body, which are passed over",
                        type == types_.end() ? 0 : type->second.kind));
      }
      ++passed_over_[type->second.kind];
    }
  }

  void read_element(const std::vector<std::int64_t>& line, const ColumnFormat& format) {
    const std::int64_t number = line[number_field];
    const AnsysType type = type_of(number, line[type_field]);
    const auto n_nodes = static_cast<std::size_t>(line[count_field]);
    Nodes nodes(line.begin() + n_fields, line.end());
    while (nodes.size() < n_nodes) {
      const auto rest = integers(data_line(), format);
      if (rest.empty()) break;
      nodes.insert(nodes.end(), rest.begin(), rest.end());
    }
    if (nodes.size() != n_nodes) {
      cursor_.fail(fmt::format("element {} announces {} nodes, but has {}", number, n_nodes, nodes.size()));
    }
    if (is_without_body(type)) {
      ++passed_over_[type.kind];
    } else {
      add_body_element(line, *nodes_of_ansys_type(type), nodes);
    }
  }

  void add_body_element(const std::vector<std::int64_t>& line, const AnsysNodes& kind, const Nodes& nodes) {
    const std::int64_t number = line[number_field];
    if (nodes.size() > kind.n_nodes || nodes.size() < kind.n_corners) {  // the last of those between may be left out
      cursor_.fail(fmt::format("element {} has {} nodes; its type has {}", number, nodes.size(), kind.n_nodes));
    }
    if (kind.is_plane) ++result_.n_plane_bodies;
    const bool is_full = kind.n_corners > (kind.is_plane ? 3 : 4);  // other shapes are this one with repeated nodes
    const Shape shape = kind.is_plane ? (is_full ? Shape::quadrangle : Shape::triangle)
                                      : (is_full ? Shape::hexahedron : Shape::tetrahedron);
    result_.add_element(number, shape, 0, nodes);
    materials_.push_back(line[material_field]);
  }

  AnsysType type_of(std::int64_t element, std::int64_t number) const {
    const auto type = types_.find(number);
    if (type == types_.end()) {
      cursor_.fail(fmt::format("element {} has type {}, which no ET command defines before it", element, number));
    }
    if (!nodes_of_ansys_type(type->second) && !is_without_body(type->second)) {
      cursor_.fail(fmt::format(
          "element {} is of ANSYS' type {}; allowed are plane elements, solids and shells such as PLANE182, "
          "SOLID185, SOLID187 and SHELL181 (unselect others before CDWRITE)",
          element, type->second.kind));
    }
    if (is_axisymmetric(type->second)) {
      cursor_.fail(fmt::format(
          "element {} is of ANSYS' type {} with KEYOPT(3) = {}, an axisymmetric one; allowed are plane elements of "
          "plane stress or plane strain",
          element, type->second.kind, type->second.third_option));
    }
    return type->second;
  }

  void note_what_was_passed_over() {
    for (const auto& [kind, count] : passed_over_) {
      result_.notes.push_back(
          fmt::format("{} elements of ANSYS' type {}, which have no body, are passed over", count, kind));
    }
  }

  // ---- components ----

  /// Numbers, a negative one closing a run from the number before it.
  void read_component(const std::vector<std::string>& fields) {
    if (fields.size() < 4) cursor_.fail("CMBLOCK without a name, a kind and a count");
    const std::string kind = lower(fields[2]).substr(0, 4);
    const std::size_t count = cursor_.checked(announced(fields, 3), 1, 1);
    const ColumnFormat format = read_format();
    Component component{fields[1], {}};
    for (std::size_t n = 0; n < count;) {
      const std::vector<std::int64_t> values = integers(data_line(), format);
      if (values.empty() || values.size() > count - n) {
        cursor_.fail(fmt::format("component \"{}\" announces {} numbers, but has {}", excerpt(component.name), count,
                                 n + values.size()));
      }
      for (const std::int64_t value : values) extend(component, value);
      n += values.size();
    }
    if (kind == "node") {
      define(std::move(component), node_components_);
    } else if (kind == "elem") {
      define(std::move(component), element_components_);
    }
  }

  /// A component replaces an earlier one of its name, as in ANSYS.
  static void define(Component component, std::vector<Component>& all) {
    const auto earlier =
        std::find_if(all.begin(), all.end(), [&](const Component& other) { return other.name == component.name; });
    if (earlier != all.end()) all.erase(earlier);
    all.push_back(std::move(component));
  }

  void extend(Component& component, std::int64_t value) const {
    auto& runs = component.runs;
    const std::int64_t last = runs.empty() ? 0 : runs.back().second;
    const bool closes_run = value < 0 && !runs.empty() && runs.back().first == last && value < -last;
    if (closes_run) {
      runs.back().second = value == INT64_MIN ? INT64_MAX : -value;
    } else if (value > last) {
      runs.emplace_back(value, value);
    } else {
      cursor_.fail(
          fmt::format("component \"{}\" has {} after {}; allowed are ascending numbers, and -n after m for m to "
                      "n",
                      excerpt(component.name), value, last));
    }
  }

  /// The places in an ascending list of the numbers in a component.
  template <class Use>
  static void for_each_in(const Component& component, const std::vector<std::int64_t>& ascending, Use use) {
    for (const auto& [first, last] : component.runs) {
      auto it = std::lower_bound(ascending.begin(), ascending.end(), first);
      for (; it != ascending.end() && *it <= last; ++it) use(*it);
    }
  }

  void add_node_sets() {
    int number = 0;
    for (const Component& component : node_components_) {
      const GroupKey key{0, ++number};
      result_.group_names[key] = component.name;
      const int list = result_.add_group_list({number});
      for_each_in(component, sorted_tags_,
                  [&](std::int64_t node) { result_.add_element(node, Shape::point, list, {node}); });
    }
  }

  void add_blocks() {
    const std::vector<int> by_component = component_of_elements();
    const bool all_in_one = std::find(by_component.begin(), by_component.end(), -1) == by_component.end();
    std::map<std::pair<int, std::int64_t>, int> list_of_group;
    for (std::size_t e = 0; e < materials_.size(); ++e) {
      const std::int64_t group = all_in_one ? by_component[e] : materials_[e];
      const int element_dimension = dimension(result_.shapes[e]);
      auto [entry, is_new] = list_of_group.emplace(std::make_pair(element_dimension, group), 0);
      if (is_new) {
        const int number = static_cast<int>(list_of_group.size());
        entry->second = result_.add_group_list({number});
        result_.group_names[{element_dimension, number}] =
            all_in_one ? element_components_[static_cast<std::size_t>(group)].name : fmt::format("material_{}", group);
      }
      result_.element_groups[e] = entry->second;
    }
  }

  /// For each element the one component that it is in, or -1.
  std::vector<int> component_of_elements() const {
    std::map<std::int64_t, std::size_t> place;
    for (std::size_t e = 0; e < result_.n_elements(); ++e) place[result_.element_tags[e]] = e;
    std::vector<std::int64_t> ascending;
    for (const auto& entry : place) ascending.push_back(entry.first);
    std::vector<int> component(result_.n_elements(), -1), n_components(result_.n_elements(), 0);
    for (std::size_t c = 0; c < element_components_.size(); ++c) {
      for_each_in(element_components_[c], ascending, [&](std::int64_t element) {
        component[place.at(element)] = static_cast<int>(c);
        ++n_components[place.at(element)];
      });
    }
    for (std::size_t e = 0; e < component.size(); ++e) {
      if (n_components[e] != 1) component[e] = -1;
    }
    return component;
  }

  FileCursor cursor_;
  MeshFile result_;
  bool has_nodes_ = false, has_elements_ = false;
  std::map<std::int64_t, AnsysType> types_;  ///< by the number that ET gives them
  std::int64_t current_type_ = 0;            ///< as TYPE says
  std::map<std::string, std::int64_t> parameters_;
  std::map<int, std::size_t> passed_over_;  ///< number of elements by kind
  std::vector<std::int64_t> materials_;     ///< by element
  std::vector<Component> node_components_, element_components_;
  std::vector<std::int64_t> sorted_tags_;
};

}  // namespace

MeshFile read_ansys_file(const std::string& file) { return Reader(file).read(); }

}  // namespace perimorph::mesh_files
