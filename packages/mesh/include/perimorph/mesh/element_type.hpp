#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace perimorph::mesh {

/// Linear elements. Node and side numbering are those of Shards and Exodus.
enum class ElementType : std::uint8_t { tri3, quad4, tet4, pyramid5, wedge6, hex8 };

inline constexpr int max_corners = 8;

int n_corners(ElementType type);
int dimension(ElementType type);  ///< 2 or 3
/// "TRI3", "QUAD4", "TETRA", "PYRAMID", "WEDGE", "HEX8": of the names in use, those that most readers know.
std::string exodus_name(ElementType type);

/// Corners of each side (edge in 2D, face in 3D), outward orientation: sides(quad4)[1] = {1, 2}.
const std::vector<std::vector<int>>& sides(ElementType type);
/// Corners of each edge, (n_edges, 2); in 2D the same.
const std::vector<std::vector<int>>& edges(ElementType type);

}  // namespace perimorph::mesh
