#include "mesh_file.hpp"

#include <algorithm>

#include "perimorph/base/errors.hpp"

namespace perimorph::mesh_files {

namespace {

struct Properties {
  int dimension, n_nodes;
};

/// In the order of Shape.
constexpr std::array<Properties, 8> properties = {{{0, 1}, {1, 2}, {2, 3}, {2, 4}, {3, 4}, {3, 5}, {3, 6}, {3, 8}}};

}  // namespace

int dimension(Shape shape) { return properties[static_cast<std::size_t>(shape)].dimension; }
int n_nodes(Shape shape) { return properties[static_cast<std::size_t>(shape)].n_nodes; }

mesh::ElementType element_type(Shape shape) {
  PERIMORPH_ASSERT(dimension(shape) >= 2, "shape {} is none of an element", static_cast<int>(shape));
  return static_cast<mesh::ElementType>(static_cast<int>(shape) - static_cast<int>(Shape::triangle));
}

void MeshFile::check_lengths() const {
  const std::size_t n = n_elements();
  PERIMORPH_ASSERT(node_tags.size() == coordinates.size(), "{} nodes, {} places", node_tags.size(), coordinates.size());
  PERIMORPH_ASSERT(shapes.size() == n && element_groups.size() == n, "{} elements, {} shapes, {} groups", n,
                   shapes.size(), element_groups.size());
  PERIMORPH_ASSERT(first_node.size() == n + 1 && first_node.back() == element_nodes.size(),
                   "{} elements, {} lists of nodes up to {} of {}", n, first_node.size(), first_node.back(),
                   element_nodes.size());
}

void MeshFile::begin_element(std::int64_t tag, Shape shape, int group_list) {
  PERIMORPH_ASSERT(group_list >= 0 && group_list < static_cast<int>(group_lists.size()), "list {} of {} of groups",
                   group_list, group_lists.size());
  element_tags.push_back(tag);
  shapes.push_back(shape);
  element_groups.push_back(group_list);
}

void MeshFile::add_element(std::int64_t tag, Shape shape, int group_list, const std::vector<std::int64_t>& nodes) {
  PERIMORPH_ASSERT(static_cast<int>(nodes.size()) >= n_nodes(shape), "{} nodes of {}", nodes.size(), n_nodes(shape));
  begin_element(tag, shape, group_list);
  const auto end_of_corners = nodes.begin() + n_nodes(shape);
  element_nodes.insert(element_nodes.end(), nodes.begin(), end_of_corners);
  end_element();
  if (end_of_corners == nodes.end()) return;
  mid_nodes.insert(mid_nodes.end(), end_of_corners, nodes.end());
  ++n_second_order[static_cast<std::size_t>(dimension(shape))];
}

int MeshFile::add_group_list(std::vector<int> groups) {
  std::sort(groups.begin(), groups.end());
  groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
  group_lists.push_back(std::move(groups));
  return static_cast<int>(group_lists.size()) - 1;
}

}  // namespace perimorph::mesh_files
