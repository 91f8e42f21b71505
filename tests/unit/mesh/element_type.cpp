#include "perimorph/mesh/element_type.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "example_meshes.hpp"
#include "perimorph/mesh/mesh.hpp"

namespace perimorph::mesh {
namespace {

constexpr std::array<ElementType, 6> all_types = {ElementType::tri3,     ElementType::quad4,  ElementType::tet4,
                                                  ElementType::pyramid5, ElementType::wedge6, ElementType::hex8};

TEST(ElementType, SidesAreNumberedAsInExodus) {
  EXPECT_EQ(sides(ElementType::quad4), (std::vector<std::vector<int>>{{0, 1}, {1, 2}, {2, 3}, {3, 0}}));
  EXPECT_EQ(sides(ElementType::tri3), (std::vector<std::vector<int>>{{0, 1}, {1, 2}, {2, 0}}));
  EXPECT_EQ(sides(ElementType::tet4), (std::vector<std::vector<int>>{{0, 1, 3}, {1, 2, 3}, {0, 3, 2}, {0, 2, 1}}));
  EXPECT_EQ(sides(ElementType::pyramid5),
            (std::vector<std::vector<int>>{{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {0, 3, 2, 1}}));
  EXPECT_EQ(sides(ElementType::wedge6),
            (std::vector<std::vector<int>>{{0, 1, 4, 3}, {1, 2, 5, 4}, {0, 3, 5, 2}, {0, 2, 1}, {3, 4, 5}}));
  EXPECT_EQ(sides(ElementType::hex8),
            (std::vector<std::vector<int>>{
                {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {0, 4, 7, 3}, {0, 3, 2, 1}, {4, 5, 6, 7}}));
}

TEST(ElementType, SidesOfASolidAreOrientedConsistently) {
  for (const ElementType type : {ElementType::tet4, ElementType::pyramid5, ElementType::wedge6, ElementType::hex8}) {
    std::map<std::pair<int, int>, int> directed_edges;
    for (const auto& side : sides(type)) {
      for (std::size_t c = 0; c < side.size(); ++c) ++directed_edges[{side[c], side[(c + 1) % side.size()]}];
    }
    for (const auto& [edge, count] : directed_edges) {
      EXPECT_EQ(count, 1) << exodus_name(type);
      EXPECT_EQ(directed_edges.count({edge.second, edge.first}), 1u) << exodus_name(type);
    }
  }
}

TEST(ElementType, HasTheNamesThatExodusKnows) {
  std::vector<std::string> names;
  for (const ElementType type : all_types) names.push_back(exodus_name(type));
  EXPECT_THAT(names, testing::ElementsAre("TRI3", "QUAD4", "TETRA", "PYRAMID", "WEDGE", "HEX8"));
}

TEST(ElementType, HasAsManyCornersAsItsSidesUse) {
  for (const ElementType type : all_types) {
    int highest = 0;
    for (const auto& side : sides(type)) {
      highest = std::max(highest, *std::max_element(side.begin(), side.end()));
      EXPECT_GE(static_cast<int>(side.size()), dimension(type));
    }
    EXPECT_EQ(n_corners(type), highest + 1);
  }
}

TEST(Mesh, UnitCellsHaveUnitEdgesAndHalfTheDiagonalAsRadius) {
  const Mesh<2> plane = grid<2>({3, 2});
  const Mesh<3> solid = grid<3>({2, 2, 2});

  EXPECT_DOUBLE_EQ(mean_edge(plane), 1.);
  EXPECT_DOUBLE_EQ(mean_edge(solid), 1.);
  EXPECT_DOUBLE_EQ(radius(plane, 4), std::sqrt(2.) / 2.);
  EXPECT_DOUBLE_EQ(radius(solid, 4), std::sqrt(3.) / 2.);
  EXPECT_TRUE(centroid(plane, 4).isApprox(Point<2>(1.5, 1.5)));
  EXPECT_TRUE(centroid(solid, 7).isApprox(Point<3>(1.5, 1.5, 1.5)));
}

TEST(Mesh, BoundaryHasTheOuterSidesOnly) {
  EXPECT_EQ(grid<2>({4, 3}).boundary.size(), 14u);
  EXPECT_EQ(grid<3>({2, 3, 4}).boundary.size(), 2u * (6u + 8u + 12u));
}

TEST(Mesh, CornerPointsOfABoundarySideTurnOutward) {
  const Mesh<2> mesh = grid<2>({3, 3});
  for (const Side& side : mesh.boundary) {
    const auto points = corner_points(mesh, side);
    const Point<2> along = points[1] - points[0], normal(along[1], -along[0]);
    EXPECT_GT(normal.dot((points[0] + points[1]) / 2. - centroid(mesh, side.element)), 0.);
  }
}

}  // namespace
}  // namespace perimorph::mesh
