#include "division.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

#include "perimorph/base/algebra.hpp"
#include "perimorph/base/errors.hpp"

namespace perimorph::mesh {

namespace {

using Corners = Division::Corners;

bool holds(const Corners& set, int corner) { return std::find(set.begin(), set.end(), corner) != set.end(); }

bool is_in(const Corners& part, const Corners& set) {
  return std::all_of(part.begin(), part.end(), [&](int corner) { return holds(set, corner); });
}

/// Corners, edges, and the middles of quadrilateral faces and of the element itself, unless it is a simplex.
std::vector<Corners> nodes_of(ElementType type) {
  std::vector<Corners> nodes;
  for (int c = 0; c < n_corners(type); ++c) nodes.push_back({c});
  nodes.insert(nodes.end(), edges(type).begin(), edges(type).end());
  if (type == ElementType::tri3 || type == ElementType::tet4) return nodes;
  if (type == ElementType::hex8) nodes.insert(nodes.end(), sides(type).begin(), sides(type).end());
  Corners all(n_corners(type));
  std::iota(all.begin(), all.end(), 0);
  nodes.push_back(std::move(all));
  return nodes;
}

/// Its k-th corner is the middle of the smallest part of the element that has both its own corner and the k-th.
Corners child_at(int corner, int n_corners, const std::vector<Corners>& nodes) {
  Corners child;
  for (int k = 0; k < n_corners; ++k) {
    const auto smallest = std::find_if(nodes.begin(), nodes.end(),
                                       [&](const Corners& set) { return holds(set, corner) && holds(set, k); });
    child.push_back(static_cast<int>(smallest - nodes.begin()));
  }
  return child;
}

/// Of a tetrahedron, by the places of the corners' middles among its nodes, so that its volume is positive.
Corners oriented(Corners child, const std::vector<Corners>& nodes) {
  const auto position = [&](int node) {
    base::Point<3> x = base::Point<3>::Zero();
    for (const int corner : nodes[node]) {
      if (corner > 0) x[corner - 1] += 1.;
    }
    return base::Point<3>(x / static_cast<double>(nodes[node].size()));
  };
  const auto origin = position(child[0]);
  const auto arm = [&](int k) { return base::Point<3>(position(child[k]) - origin); };
  if (arm(1).cross(arm(2)).dot(arm(3)) < 0.) std::swap(child[2], child[3]);
  return child;
}

/// What is left of a tetrahedron without its children at corners is an octahedron between the middles of its edges:
/// four children around one of its three diagonals, between opposite edges.
void add_inner_tetrahedra(Division& division) {
  const auto& nodes = division.nodes;
  const auto opposite = [&](int edge) {
    int other = 4;
    while (holds(nodes[edge], nodes[other][0]) || holds(nodes[edge], nodes[other][1])) ++other;
    return other;
  };
  for (int edge = 4; edge < 10; ++edge) {
    if (opposite(edge) > edge) division.diagonals.push_back({edge, opposite(edge)});
  }
  for (std::size_t d = 0; d < 3; ++d) {
    const auto& [begin, end] = division.diagonals[d];
    const auto& one = division.diagonals[(d + 1) % 3];
    const auto& other = division.diagonals[(d + 2) % 3];
    const std::array<int, 5> around = {one[0], other[0], one[1], other[1], one[0]};
    for (int k = 0; k < 4; ++k) {
      division.children.push_back(oriented({begin, end, around[k], around[k + 1]}, nodes));
    }
  }
}

Division make(ElementType type) {
  Division division;
  division.nodes = nodes_of(type);
  for (int c = 0; c < n_corners(type); ++c) {
    division.children.push_back(child_at(c, n_corners(type), division.nodes));
  }
  if (type == ElementType::tri3) division.children.push_back({3, 4, 5});
  if (type == ElementType::tet4) add_inner_tetrahedra(division);
  const auto& all = sides(type);
  for (const auto& child : division.children) {
    auto& sides_of_child = division.sides.emplace_back();
    for (const auto& side : all) {
      const auto found = std::find_if(all.begin(), all.end(), [&](const Corners& of_element) {
        return std::all_of(side.begin(), side.end(),
                           [&](int corner) { return is_in(division.nodes[child[corner]], of_element); });
      });
      sides_of_child.push_back(found == all.end() ? -1 : static_cast<int>(found - all.begin()));
    }
  }
  return division;
}

}  // namespace

std::vector<int> Division::children_around(int diagonal) const {
  const int n_all = static_cast<int>(children.size());
  const int n_outer = diagonals.empty() ? n_all : 4;
  std::vector<int> places(n_outer);
  std::iota(places.begin(), places.end(), 0);
  for (int k = 0; k < n_all - n_outer && k < 4; ++k) places.push_back(n_outer + 4 * diagonal + k);
  return places;
}

const Division* division_of(ElementType type) {
  static const Division triangle = make(ElementType::tri3), quadrilateral = make(ElementType::quad4),
                        tetrahedron = make(ElementType::tet4), hexahedron = make(ElementType::hex8);
  switch (type) {
    case ElementType::tri3:
      return &triangle;
    case ElementType::quad4:
      return &quadrilateral;
    case ElementType::tet4:
      return &tetrahedron;
    case ElementType::hex8:
      return &hexahedron;
    default:
      return nullptr;
  }
}

}  // namespace perimorph::mesh
