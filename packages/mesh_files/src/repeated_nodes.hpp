#pragma once

#include <optional>
#include <vector>

#include "mesh_file.hpp"

namespace perimorph::mesh_files {

/// A shape and its corners.
struct Corners {
  Shape shape;
  std::vector<int> nodes;
};

/// What an element is in which some nodes stand several times, as many programs write triangles, wedges, pyramids and
/// tetrahedra: a quadrangle or a solid of which edges have no length. Nothing if that is none of our shapes. Local.
/// @param shape of a dimension of 2 or 3
/// @param nodes of its corners, (n_nodes(shape))
std::optional<Corners> without_repeated_nodes(Shape shape, const std::vector<int>& nodes);

}  // namespace perimorph::mesh_files
