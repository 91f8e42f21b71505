#include "perimorph/mesh/element_type.hpp"

#include <array>

#include "perimorph/base/errors.hpp"
#include "topology.hpp"

namespace perimorph::mesh {

namespace {

constexpr int n_types = 6;

struct Properties {
  int n_corners;
  int dimension;
  const char* exodus_name;
};

/// In the order of ElementType.
constexpr std::array<Properties, n_types> properties = {
    {{3, 2, "TRI3"}, {4, 2, "QUAD4"}, {4, 3, "TETRA"}, {5, 3, "PYRAMID"}, {6, 3, "WEDGE"}, {8, 3, "HEX8"}}};

const Properties& properties_of(ElementType type) {
  const auto t = static_cast<std::size_t>(type);
  PERIMORPH_DEBUG_ASSERT(t < properties.size(), "element type {}", t);
  return properties[t];
}

using Corners = std::vector<int>;

std::vector<Corners> subcells(const shards::CellTopology& element, unsigned dimension) {
  std::vector<Corners> all;
  for (unsigned s = 0; s < element.getSubcellCount(dimension); ++s) {
    Corners& corners = all.emplace_back();
    for (unsigned c = 0; c < element.getNodeCount(dimension, s); ++c) {
      corners.push_back(static_cast<int>(element.getNodeMap(dimension, s, c)));
    }
  }
  return all;
}

/// @param of(element) dimension of the subcells
template <class Of>
std::array<std::vector<Corners>, n_types> subcells_of_all_types(Of of) {
  std::array<std::vector<Corners>, n_types> all;
  for (int t = 0; t < n_types; ++t) {
    const auto element = topology(static_cast<ElementType>(t));
    all[t] = subcells(element, of(element));
  }
  return all;
}

}  // namespace

int n_corners(ElementType type) { return properties_of(type).n_corners; }
int dimension(ElementType type) { return properties_of(type).dimension; }
std::string exodus_name(ElementType type) { return properties_of(type).exodus_name; }

const std::vector<std::vector<int>>& sides(ElementType type) {
  static const auto all = subcells_of_all_types([](const auto& element) { return element.getDimension() - 1; });
  PERIMORPH_DEBUG_ASSERT(static_cast<std::size_t>(type) < all.size(), "element type {}", static_cast<int>(type));
  return all[static_cast<int>(type)];
}

const std::vector<std::vector<int>>& edges(ElementType type) {
  static const auto all = subcells_of_all_types([](const auto&) { return 1u; });
  PERIMORPH_DEBUG_ASSERT(static_cast<std::size_t>(type) < all.size(), "element type {}", static_cast<int>(type));
  return all[static_cast<int>(type)];
}

}  // namespace perimorph::mesh
