// The MSH 2.2 and 4.1 formats, as in "File formats" of gmsh's manual.

#include "gmsh_file.hpp"

#include <algorithm>
#include <cstdlib>
#include <set>

#include "file_cursor.hpp"
#include "perimorph/base/errors.hpp"

namespace perimorph::mesh_files {

namespace {

constexpr int no_groups = 0;  // index into MeshFile::group_lists

/// By gmsh's numbers of kinds of elements (its manual, "Node ordering" and "MSH file format").
const std::map<int, Shape> shapes = {{15, Shape::point},     {1, Shape::line},        {2, Shape::triangle},
                                     {3, Shape::quadrangle}, {4, Shape::tetrahedron}, {5, Shape::hexahedron},
                                     {6, Shape::wedge},      {7, Shape::pyramid}};

const Advice advice = {
    "mesh it with gmsh -2 (or -3), and put what is to be computed into a physical surface (or volume)",
    "Take points that only help to draw (such as the centre of a circle) out of the physical groups, and put all that "
    "is "
    "to be computed into a physical surface (or volume)",
    "If a whole surface is reversed, write its curve loop in the .geo file the other way round, or add  ReverseMesh "
    "Surface{...};"};

std::string name_of_other_kind(int number) {
  static const std::map<int, const char*> names = {
      {8, "3-node line"},         {9, "6-node triangle"}, {10, "9-node quadrangle"}, {11, "10-node tetrahedron"},
      {12, "27-node hexahedron"}, {13, "18-node prism"},  {14, "14-node pyramid"},   {16, "8-node quadrangle"},
      {17, "20-node hexahedron"}, {18, "15-node prism"},  {19, "13-node pyramid"}};
  const auto found = names.find(number);
  return found == names.end() ? fmt::format("of gmsh's kind {}", number)
                              : fmt::format("a {} (gmsh's kind {})", found->second, number);
}

/// A negative number stands for the group with reversed orientation.
int group_number(int signed_number) { return static_cast<int>(std::abs(static_cast<long>(signed_number))); }

/// Reads one file from front to back.
class Reader {
 public:
  explicit Reader(const std::string& file) : cursor_(file, "a gmsh mesh") {
    result_.name = file;
    result_.advice = advice;
  }

  MeshFile read() {
    read_format();
    while (!cursor_.at_end()) read_section();
    for (const char* needed : {"$Nodes", "$Elements"}) {
      if (sections_.count(needed) == 0) {
        cursor_.fail(fmt::format("the file ends without {}: it is truncated or holds no mesh", needed));
      }
    }
    name_the_unnamed();
    return std::move(result_);
  }

 private:
  void read_format() {
    if (const std::string first = cursor_.line(); first != "$MeshFormat") {
      cursor_.fail(fmt::format("not a gmsh mesh: its first line must be $MeshFormat, found \"{}\"", excerpt(first)));
    }
    const std::string description = cursor_.line();
    const std::string version = description.substr(0, description.find(' '));
    const std::string rest = description.substr(version.size());
    if (version != "4.1" && version != "2.2") {
      cursor_.fail(
          fmt::format("MSH version \"{}\"; allowed are 4.1 and 2.2 (convert it: gmsh -save -format msh41 -o new.msh "
                      "old.msh)",
                      excerpt(version)));
    }
    if (rest != " 0 8" && rest != " 1 8") {
      cursor_.fail(fmt::format("\"{} 0 8\" (ASCII) or \"{} 1 8\" (binary) expected, found \"{}\"", version, version,
                               excerpt(description)));
    }
    is_4_1_ = version == "4.1";
    if (rest == " 1 8") read_byte_order();
    cursor_.expect("$EndMeshFormat");
  }

  void read_byte_order() {
    cursor_.set_binary();
    if (const int one = cursor_.next_int(); one == 0x01000000) {
      cursor_.fail(
          "the file was written on a machine of the other byte order (endianness): convert it there to ASCII "
          "(gmsh -save -format msh41 -o new.msh old.msh)");
    } else if (one != 1) {
      cursor_.fail(fmt::format("the number 1 expected after the format, found {}: the file is damaged", one));
    }
  }

  void read_section() {
    const std::string name = cursor_.line();
    if (name.size() < 2 || name[0] != '$') {
      cursor_.fail(fmt::format("a section such as $Nodes expected, found \"{}\"", excerpt(name)));
    }
    if (name == "$PartitionedEntities") {
      cursor_.fail(
          "the mesh is partitioned: save it whole (without -part), the ranks' parts are made when a run starts");
    }
    sections_.insert(name);
    const std::string end = "$End" + name.substr(1);
    if (name == "$PhysicalNames") {
      read_names();
    } else if (name == "$Entities" && is_4_1_) {
      read_entities();
    } else if (name == "$Nodes") {
      is_4_1_ ? read_nodes_4_1() : read_nodes_2_2();
    } else if (name == "$Elements") {
      is_4_1_ ? read_elements_4_1() : read_elements_2_2();
    } else {
      cursor_.skip_to_line(end);
    }
    cursor_.expect(end);
  }

  /// Text in all flavours: count, then lines: dimension number "name".
  void read_names() {
    for (std::int64_t n = cursor_.ascii_long(); n > 0; --n) {
      const int dimension = cursor_.ascii_int(), number = cursor_.ascii_int();
      const std::string name = cursor_.line();
      if (name.size() < 2 || name.front() != '"' || name.back() != '"') {
        cursor_.fail(
            fmt::format("the name of physical group {} must be in double quotes, found \"{}\"", number, excerpt(name)));
      }
      result_.group_names[{dimension, number}] = name.substr(1, name.size() - 2);
    }
  }

  // ---- 4.1: points, curves, surfaces and volumes (entities) have groups; nodes and elements come by entity ----

  void read_entities() {
    std::array<std::size_t, 4> counts;
    for (auto& count : counts) count = cursor_.checked(cursor_.next_long(), 5, 36);
    for (int dimension = 0; dimension < 4; ++dimension) {
      for (std::size_t i = 0; i < counts[dimension]; ++i) read_entity(dimension);
    }
  }

  void read_entity(int dimension) {
    const int number = cursor_.next_int();
    const int n_box = dimension == 0 ? 3 : 6;
    for (int i = 0; i < n_box; ++i) cursor_.next_real();
    std::vector<int> groups(cursor_.checked(cursor_.next_long(), 1, 4));
    for (auto& group : groups) group = group_number(cursor_.next_int());
    if (!groups.empty()) list_of_entity_[{dimension, number}] = result_.add_group_list(groups);
    if (dimension == 0) return;
    for (std::size_t n = cursor_.checked(cursor_.next_long(), 1, 4); n > 0; --n) cursor_.next_int();
  }

  void read_nodes_4_1() {
    const std::size_t n_blocks = cursor_.checked(cursor_.next_long(), 4, 20);
    const std::size_t n_nodes = cursor_.checked(cursor_.next_long(), 4, 32);
    cursor_.next_long();  // smallest tag
    cursor_.next_long();  // largest tag
    reserve_nodes(n_nodes);
    for (std::size_t b = 0; b < n_blocks; ++b) read_node_block();
    check_total("nodes", n_nodes, result_.node_tags.size());
  }

  void read_node_block() {
    const int dimension = cursor_.next_int();
    cursor_.next_int();  // entity
    const int parametric = cursor_.next_int();
    const std::size_t n = cursor_.checked(cursor_.next_long(), 4, 32);
    for (std::size_t i = 0; i < n; ++i) result_.node_tags.push_back(cursor_.next_long());
    for (std::size_t i = 0; i < n; ++i) {
      read_coordinates();
      for (int p = 0; p < dimension && parametric != 0; ++p) cursor_.next_real();
    }
  }

  void read_elements_4_1() {
    const std::size_t n_blocks = cursor_.checked(cursor_.next_long(), 4, 20);
    const std::size_t n_elements = cursor_.checked(cursor_.next_long(), 2, 16);
    cursor_.next_long();  // smallest tag
    cursor_.next_long();  // largest tag
    reserve_elements(n_elements);
    for (std::size_t b = 0; b < n_blocks; ++b) read_element_block();
    check_total("elements", n_elements, result_.n_elements());
  }

  void read_element_block() {
    const int dimension = cursor_.next_int(), entity = cursor_.next_int(), kind = cursor_.next_int();
    const auto list = list_of_entity_.find({dimension, entity});
    const int groups = list == list_of_entity_.end() ? no_groups : list->second;
    for (std::size_t n = cursor_.checked(cursor_.next_long(), 2, 16); n > 0; --n) {
      const std::int64_t tag = cursor_.next_long();
      begin_element(tag, kind, groups);
      for (int i = 0; i < n_nodes(result_.shapes.back()); ++i) result_.element_nodes.push_back(cursor_.next_long());
      result_.end_element();
    }
  }

  // ---- 2.2: counts are text, numbers have 4 bytes; each element carries its group ----

  void read_nodes_2_2() {
    const std::int64_t count = cursor_.ascii_long();
    skip_to_data();
    const std::size_t n_nodes = cursor_.checked(count, 4, 28);
    reserve_nodes(n_nodes);
    for (std::size_t i = 0; i < n_nodes; ++i) {
      result_.node_tags.push_back(cursor_.next_int());
      read_coordinates();
    }
  }

  void read_elements_2_2() {
    const std::int64_t count = cursor_.ascii_long();
    skip_to_data();
    const std::size_t n_elements = cursor_.checked(count, 4, 8);
    reserve_elements(n_elements);
    while (result_.n_elements() < n_elements) {
      cursor_.binary() ? read_binary_run(n_elements - result_.n_elements()) : read_ascii_element();
    }
  }

  /// number, kind, number of tags, tags, nodes
  void read_ascii_element() {
    const int number = cursor_.next_int(), kind = cursor_.next_int(), n_tags = cursor_.next_int();
    read_element_2_2(number, kind, n_tags);
  }

  /// kind, number of elements, number of tags; then for each element its number, tags, nodes
  void read_binary_run(std::size_t most) {
    const int kind = cursor_.next_int(), n_elements = cursor_.next_int(), n_tags = cursor_.next_int();
    if (n_elements < 1 || static_cast<std::size_t>(n_elements) > most) {
      cursor_.fail(
          fmt::format("a run of {} elements, where 1 to {} can follow: the file is damaged", n_elements, most));
    }
    for (int i = 0; i < n_elements; ++i) {
      const int number = cursor_.next_int();
      read_element_2_2(number, kind, n_tags);
    }
  }

  void read_element_2_2(int number, int kind, int n_tags) {
    int group = 0;  // the first tag; 0 is none
    for (int t = 0; t < n_tags; ++t) {
      const int tag = cursor_.next_int();
      if (t == 0) group = group_number(tag);
    }
    begin_element(number, kind, list_of_group(group));
    for (int i = 0; i < n_nodes(result_.shapes.back()); ++i) result_.element_nodes.push_back(cursor_.next_int());
    result_.end_element();
  }

  int list_of_group(int group) {
    if (group == 0) return no_groups;
    const auto found = list_of_group_.find(group);
    return found != list_of_group_.end() ? found->second : list_of_group_[group] = result_.add_group_list({group});
  }

  // ---- common to both ----

  void skip_to_data() {
    if (cursor_.binary()) cursor_.skip_line_break();
  }

  void reserve_nodes(std::size_t n) {
    result_.node_tags.reserve(n);
    result_.coordinates.reserve(n);
  }

  void reserve_elements(std::size_t n) {
    result_.element_tags.reserve(n);
    result_.shapes.reserve(n);
    result_.element_groups.reserve(n);
    result_.first_node.reserve(n + 1);
  }

  void read_coordinates() {
    auto& point = result_.coordinates.emplace_back();
    for (auto& x : point) x = cursor_.next_real();
  }

  void begin_element(std::int64_t tag, int kind, int groups) {
    const auto shape = shapes.find(kind);
    if (shape == shapes.end()) {
      cursor_.fail(
          fmt::format("element {} is {}; allowed are 3-node triangles and 4-node quadrangles in 2D, 4-node tetrahedra, "
                      "5-node pyramids, 6-node prisms and 8-node hexahedra in 3D (with Mesh.ElementOrder = 1)",
                      tag, name_of_other_kind(kind)));
    }
    result_.begin_element(tag, shape->second, groups);
  }

  void name_the_unnamed() {
    static constexpr std::array<const char*, 4> entities = {"point", "curve", "surface", "volume"};
    for (std::size_t e = 0; e < result_.n_elements(); ++e) {
      const int dimension_of_element = dimension(result_.shapes[e]);
      for (const int group : result_.group_lists[result_.element_groups[e]]) {
        const GroupKey key{dimension_of_element, group};
        if (result_.group_names.count(key) == 0) {
          result_.group_names[key] = fmt::format("{}_{}", entities[dimension_of_element], group);
        }
      }
    }
  }

  void check_total(const char* what, std::size_t announced, std::size_t found) {
    if (found == announced) return;
    cursor_.fail(fmt::format("{} {} announced, {} found: the file is damaged", announced, what, found));
  }

  FileCursor cursor_;
  MeshFile result_;
  bool is_4_1_ = false;
  std::set<std::string> sections_;
  std::map<GroupKey, int> list_of_entity_;  // 4.1: by dimension and number of the entity
  std::map<int, int> list_of_group_;        // 2.2
};

}  // namespace

MeshFile read_gmsh_file(const std::string& file) { return Reader(file).read(); }

}  // namespace perimorph::mesh_files
