#include "mesh_file.hpp"

#include <algorithm>

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
  return static_cast<mesh::ElementType>(static_cast<int>(shape) - static_cast<int>(Shape::triangle));
}

void MeshFile::begin_element(std::int64_t tag, Shape shape, int group_list) {
  element_tags.push_back(tag);
  shapes.push_back(shape);
  element_groups.push_back(group_list);
}

void MeshFile::add_element(std::int64_t tag, Shape shape, int group_list, const std::vector<std::int64_t>& nodes) {
  begin_element(tag, shape, group_list);
  element_nodes.insert(element_nodes.end(), nodes.begin(), nodes.end());
  end_element();
}

int MeshFile::add_group_list(std::vector<int> groups) {
  std::sort(groups.begin(), groups.end());
  groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
  group_lists.push_back(std::move(groups));
  return static_cast<int>(group_lists.size()) - 1;
}

}  // namespace perimorph::mesh_files
