#pragma once

// What a MeshFile holds, in a form in which slices can be put together and compared with the whole.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "mesh_file.hpp"

namespace perimorph::mesh_files {

/// Tag, shape, number of groups, the groups, nodes.
using ElementNumbers = std::vector<std::int64_t>;

/// The elements of one dimension, in their order.
inline std::vector<ElementNumbers> elements_of(const MeshFile& file, int dimension_wanted) {
  std::vector<ElementNumbers> elements;
  for (std::size_t e = 0; e < file.n_elements(); ++e) {
    if (dimension(file.shapes[e]) != dimension_wanted) continue;
    const std::vector<int>& groups = file.group_lists.at(static_cast<std::size_t>(file.element_groups[e]));
    ElementNumbers& element = elements.emplace_back();
    element = {file.element_tags[e], static_cast<std::int64_t>(file.shapes[e]),
               static_cast<std::int64_t>(groups.size())};
    element.insert(element.end(), groups.begin(), groups.end());
    element.insert(element.end(), file.element_nodes.begin() + static_cast<std::ptrdiff_t>(file.first_node[e]),
                   file.element_nodes.begin() + static_cast<std::ptrdiff_t>(file.first_node[e + 1]));
  }
  return elements;
}

template <class T>
std::vector<T> sorted(std::vector<T> items) {
  std::sort(items.begin(), items.end());
  return items;
}

template <class T>
void append(std::vector<T>& items, const std::vector<T>& others) {
  items.insert(items.end(), others.begin(), others.end());
}

struct Contents {
  std::vector<std::int64_t> node_tags;
  std::vector<std::array<double, 3>> coordinates;
  std::array<std::vector<ElementNumbers>, 4> elements;  ///< by dimension
  std::vector<std::int64_t> mid_nodes;
  std::array<std::size_t, 4> n_second_order{};
  std::size_t n_plane_bodies = 0;
  std::vector<std::string> notes;

  void add(const MeshFile& file) {
    file.check_lengths();
    append(node_tags, file.node_tags);
    append(coordinates, file.coordinates);
    for (std::size_t d = 0; d < 4; ++d) {
      append(elements[d], elements_of(file, static_cast<int>(d)));
      n_second_order[d] += file.n_second_order[d];
    }
    append(mid_nodes, file.mid_nodes);
    n_plane_bodies += file.n_plane_bodies;
    append(notes, file.notes);
  }
};

/// @param dimensions_in_order of the elements whose order must be that of the whole file
inline void expect_alike(const Contents& together, const Contents& whole, const std::set<int>& dimensions_in_order) {
  EXPECT_EQ(together.node_tags, whole.node_tags);
  EXPECT_EQ(together.coordinates, whole.coordinates);
  for (int d = 0; d < 4; ++d) {
    const auto& found = together.elements[static_cast<std::size_t>(d)];
    const auto& expected = whole.elements[static_cast<std::size_t>(d)];
    const bool in_order = dimensions_in_order.count(d) > 0;
    EXPECT_EQ(in_order ? found : sorted(found), in_order ? expected : sorted(expected)) << "dimension " << d;
  }
  EXPECT_EQ(sorted(together.mid_nodes), sorted(whole.mid_nodes));
  EXPECT_EQ(together.n_second_order, whole.n_second_order);
  EXPECT_EQ(together.n_plane_bodies, whole.n_plane_bodies);
  EXPECT_EQ(together.notes, whole.notes);
}

/// What every slice says of the whole file.
inline void expect_same_description(const MeshFile& slice, const MeshFile& whole) {
  EXPECT_EQ(slice.group_names, whole.group_names);
  EXPECT_EQ(slice.name, whole.name);
  EXPECT_EQ(slice.advice, whole.advice);
  EXPECT_EQ(slice.sides_follow_from_node_sets, whole.sides_follow_from_node_sets);
}

/// Shares may differ by one item.
inline void expect_a_fair_share(std::size_t n, std::size_t n_of_all, int n_ranks) {
  EXPECT_GE(n, n_of_all / static_cast<std::size_t>(n_ranks));
  EXPECT_LE(n, n_of_all / static_cast<std::size_t>(n_ranks) + 1);
}

}  // namespace perimorph::mesh_files
