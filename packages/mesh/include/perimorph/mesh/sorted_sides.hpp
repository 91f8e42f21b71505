#pragma once

#include <array>
#include <vector>

#include "perimorph/mesh/mesh.hpp"

namespace perimorph::mesh {

/// What identifies a side whichever element sees it: its local nodes, ascending, after -1 in each unused place.
using SideKey = std::array<int, 4>;

/// A side of an element with its key.
struct KeyedSide {
  SideKey key;
  Side side;
};

inline bool operator<(const Side& a, const Side& b) {
  return a.element != b.element ? a.element < b.element : a.side < b.side;
}

/// The key of a side with these local nodes, (2 in 2D, 3 or 4 in 3D), in any order.
SideKey side_key(const std::vector<int>& nodes);

/// The local nodes of a side, in its outward order, (n_corners of the side).
template <int dim>
std::vector<int> side_nodes(const Mesh<dim>& mesh, const Side& side);

/// All sides of all local elements by ascending key; where elements share one, the lower element is first.
template <int dim>
std::vector<KeyedSide> sorted_sides(const Mesh<dim>& mesh);

}  // namespace perimorph::mesh
