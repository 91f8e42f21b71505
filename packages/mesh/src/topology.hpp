#pragma once

#include <Shards_CellTopology.hpp>

#include "perimorph/mesh/element_type.hpp"

namespace perimorph::mesh {

/// Shards' description of an element: its corners, edges and sides.
inline shards::CellTopology topology(ElementType type) {
  switch (type) {
    case ElementType::tri3:
      return shards::getCellTopologyData<shards::Triangle<3>>();
    case ElementType::quad4:
      return shards::getCellTopologyData<shards::Quadrilateral<4>>();
    case ElementType::tet4:
      return shards::getCellTopologyData<shards::Tetrahedron<4>>();
    case ElementType::pyramid5:
      return shards::getCellTopologyData<shards::Pyramid<5>>();
    case ElementType::wedge6:
      return shards::getCellTopologyData<shards::Wedge<6>>();
    default:
      return shards::getCellTopologyData<shards::Hexahedron<8>>();
  }
}

}  // namespace perimorph::mesh
