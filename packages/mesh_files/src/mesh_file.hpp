#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "perimorph/mesh/element_type.hpp"

namespace perimorph::mesh_files {

/// What a mesh file may consist of: points and linear elements (others are reduced to them). Points and lines only
/// serve as members of groups; the others are in the order of mesh::ElementType.
enum class Shape : std::uint8_t { point, line, triangle, quadrangle, tetrahedron, pyramid, wedge, hexahedron };

int dimension(Shape shape);
int n_nodes(Shape shape);
mesh::ElementType element_type(Shape shape);  ///< of a shape of dimension 2 or 3

/// A group of elements of one dimension: that dimension, and the group's number.
using GroupKey = std::pair<int, int>;

/// What a mesh file says, whatever its format; each reader checks its own format, build_mesh() all the rest. Node sets
/// are groups of points, side sets groups of lines (2D) or faces (3D).
struct MeshFile {
  std::string name;    ///< of the file, for messages
  std::string advice;  ///< against a mesh without elements of the case's dimension, in terms of the program it is from

  std::vector<std::string> notes;  ///< what the reader passed over, a sentence each

  std::map<GroupKey, std::string> group_names;  ///< of all groups that elements are in

  std::vector<std::int64_t> node_tags;
  std::vector<std::array<double, 3>> coordinates;  ///< [length]

  std::vector<std::int64_t> element_tags;
  std::vector<Shape> shapes;
  std::vector<int> element_groups;            ///< index into group_lists
  std::vector<std::size_t> first_node = {0};  ///< nodes of element e: element_nodes[first_node[e]] ...
  std::vector<std::int64_t> element_nodes;    ///< node tags

  /// Numbers of groups (of the element's dimension) that elements may be in together; the first is empty.
  std::vector<std::vector<int>> group_lists = {{}};

  std::size_t n_plane_bodies = 0;  ///< of plane elements, those that are shells or the like, and not only sides

  std::array<std::size_t, 4> n_second_order{};  ///< by dimension: elements that were of second order
  std::vector<std::int64_t> mid_nodes;          ///< tags of their nodes that are no corners, once or more often

  /// For formats without side sets: sides of the boundary with all their nodes in one node set make a side set.
  bool sides_follow_from_node_sets = false;

  std::size_t n_elements() const { return element_tags.size(); }

  /// Asserts that lists that belong together have as many items.
  void check_lengths() const;

  /// Adds an element; its nodes are then to be added to element_nodes, and end_element() called.
  void begin_element(std::int64_t tag, Shape shape, int group_list);
  void end_element() { first_node.push_back(element_nodes.size()); }

  /// @param nodes corners first; those that follow make it an element of second order, which is taken by its corners
  void add_element(std::int64_t tag, Shape shape, int group_list, const std::vector<std::int64_t>& nodes);

  /// The index of a new list in group_lists.
  int add_group_list(std::vector<int> groups);
};

}  // namespace perimorph::mesh_files
