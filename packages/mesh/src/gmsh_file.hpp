#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace perimorph::mesh {

/// A physical group of gmsh: dimension and number.
using GroupKey = std::pair<int, int>;

/// A kind of element in gmsh's numbering (its manual, "Node ordering" and "MSH file format").
struct GmshKind {
  int number;
  int dimension;
  int n_nodes;
};

/// One of the kinds that read_gmsh_file lets pass: points, and the linear elements up to dimension three.
const GmshKind& gmsh_kind(int number);

/// What a gmsh file says. Counts, numbers and kinds of elements are checked, nothing else.
struct GmshFile {
  std::map<GroupKey, std::string> group_names;

  std::vector<std::int64_t> node_tags;
  std::vector<std::array<double, 3>> coordinates;  ///< [length]

  std::vector<std::int64_t> element_tags;
  std::vector<int> element_kinds;             ///< gmsh's number, see gmsh_kind()
  std::vector<int> element_groups;            ///< index into group_lists
  std::vector<std::size_t> first_node = {0};  ///< nodes of element e: element_nodes[first_node[e]] ...
  std::vector<std::int64_t> element_nodes;    ///< node tags

  /// Numbers of physical groups (of the element's dimension) that elements may be in together; the first is empty.
  std::vector<std::vector<int>> group_lists = {{}};

  std::size_t n_elements() const { return element_tags.size(); }
};

/// Parses MSH 4.1 or 2.2, ASCII or binary. Local.
/// @throws base::UserError if the file cannot be read, is of another version or byte order, is truncated or damaged, or
///         has elements that are not linear points, lines, triangles, quadrangles, tetrahedra or hexahedra.
GmshFile read_gmsh_file(const std::string& file);

}  // namespace perimorph::mesh
