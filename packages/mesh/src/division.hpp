#pragma once

#include <array>
#include <vector>

#include "perimorph/mesh/element_type.hpp"

namespace perimorph::mesh {

/// How a triangle or a quadrilateral is divided into four, a tetrahedron or a hexahedron into eight, each edge in half.
struct Division {
  using Corners = std::vector<int>;

  std::vector<Corners> nodes;  ///< the corners whose mean each node is: corners themselves, edges, faces, the element
  std::vector<Corners> children;  ///< among the nodes: one at each corner, in that order, and then the inner ones
  std::vector<Corners> sides;     ///< per child, per side of it: the element's side that it lies on, or -1
  /// Of a tetrahedron, whose inner children lie around a diagonal: the nodes at the ends of the three that there are.
  std::vector<std::array<int, 2>> diagonals;

  /// The places among the children of those that an element is divided into. @param diagonal 0 but for tetrahedra
  std::vector<int> children_around(int diagonal) const;
};

/// @return null for wedges and pyramids, which are not divided
const Division* division_of(ElementType type);

}  // namespace perimorph::mesh
