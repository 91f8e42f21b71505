#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace perimorph::mesh {

/// Linear elements. Node and side numbering are those of Shards and Exodus.
enum class ElementType : std::uint8_t { tri3, quad4, tet4, pyramid5, wedge6, hex8 };

inline constexpr int max_corners = 8;

int n_corners(ElementType type);
int dimension(ElementType type);            ///< 2 or 3
std::string exodus_name(ElementType type);  ///< "TRI3", "QUAD4", "TETRA4", "PYRAMID5", "WEDGE6", "HEX8"

/// Corners of each side (edge in 2D, face in 3D), outward orientation: sides(quad4)[1] = {1, 2}.
const std::vector<std::vector<int>>& sides(ElementType type);

}  // namespace perimorph::mesh
