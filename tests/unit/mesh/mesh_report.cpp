#include "perimorph/mesh/mesh_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "example_meshes.hpp"

namespace perimorph::mesh {
namespace {

/// Unit squares, the last of which is half of one: a triangle.
Mesh<2> squares_and_a_triangle() {
  Mesh<2> mesh = grid<2>({6, 3});
  mesh.types.back() = ElementType::tri3;
  mesh.corners.pop_back();
  --mesh.first_corner.back();
  return mesh;
}

TEST(MeshReport, NamesKindsGroupsSizesAndQuality) {
  const std::string report = describe(squares_and_a_triangle());

  for (const char* piece :
       {"1 TRI3, 17 QUAD4 on 28 nodes", "block          \"west\": 9 elements", "block          \"east\": 9 elements",
        "group          \"corner\": 1 node\n", "group          \"left\": 4 nodes, 3 sides",
        "bounding box     (0, 0) to (6, 3)", "edge lengths     1 to 1.414, 1.006 on average",
        "scaled Jacobian 0.707 at worst, in the element around (5.66667, 2.33333)"}) {
    EXPECT_THAT(report, testing::HasSubstr(piece));
  }
}

}  // namespace
}  // namespace perimorph::mesh
