#include "perimorph/elements/locator.hpp"

#include <gtest/gtest.h>

#include "perimorph/elements/material_points.hpp"
#include "support/meshes.hpp"

namespace perimorph::tests {
namespace {

/// Irregular quadrilaterals or triangles, 6 x 5, of area 3 x 2.
class Locator : public testing::TestWithParam<bool> {
 protected:
  mesh::Mesh<2> mesh = grid({6, 5, 3., 2., Point2(1., -1.), 0.25, GetParam()});
  elements::Locator<2> locator{mesh};
};

TEST_P(Locator, FindsEachMaterialPointInItsElementWithItsShapeFunctions) {
  const elements::MaterialPoints<2> points(mesh);
  for (int e = 0; e < mesh.n_elements(); ++e) {
    for (int q = 0; q < points.count(e); ++q) {
      const auto found = locator.find(points.position(points.first(e) + q));
      ASSERT_TRUE(found);
      EXPECT_EQ(found->element, e);
      EXPECT_LT((found->shape - points.shape(e, q)).norm(), 1e-12);
    }
  }
}

TEST_P(Locator, InterpolatesALinearFieldExactlyAlsoOnTheBoundary) {
  const Point2 slope(0.7, -1.3);
  for (const Point2& x : {Point2(1., -1.), Point2(4., 1.), Point2(1., 0.123), Point2(2.71, 1.), Point2(3.3, 0.77)}) {
    const auto found = locator.find(x);
    ASSERT_TRUE(found) << x.transpose();
    double value = 0.;
    for (int k = 0; k < mesh.n_corners(found->element); ++k) {
      value += found->shape(k) * slope.dot(mesh.coordinates[mesh.corners_of(found->element)[k]]);
    }
    EXPECT_NEAR(value, slope.dot(x), 1e-12);
  }
}

TEST_P(Locator, GivesANodeToTheElementOfTheLowestId) {
  for (int n = 0; n < mesh.n_nodes(); ++n) {
    const int* end = mesh.corners.data() + mesh.corners.size();
    const auto first = std::find(static_cast<const int*>(mesh.corners.data()), end, n) - mesh.corners.data();
    const auto found = locator.find(mesh.coordinates[n]);
    ASSERT_TRUE(found);
    EXPECT_LE(mesh.first_corner[found->element], first);
    EXPECT_LT(first, mesh.first_corner[found->element + 1]);
  }
}

TEST_P(Locator, FindsNothingOutside) {
  for (const Point2& x : {Point2(0.999, 0.), Point2(4.001, 0.), Point2(2., 1.001), Point2(1e6, 0.), Point2(-40., 3.)}) {
    EXPECT_FALSE(locator.find(x)) << x.transpose();
  }
}

INSTANTIATE_TEST_SUITE_P(Meshes, Locator, testing::Bool(),
                         [](const auto& triangles) { return triangles.param ? "Triangles" : "Quadrilaterals"; });

TEST(LocatorWithAHole, FindsNothingInIt) {
  const auto mesh = without(grid({9, 9}), [](const Point2& c) { return (c - Point2(0.5, 0.5)).norm() < 0.1; });
  const elements::Locator<2> locator(mesh);
  EXPECT_FALSE(locator.find(Point2(0.5, 0.5)));
  EXPECT_TRUE(locator.find(Point2(0.3, 0.5)));
}

TEST(ShapeInThreeDimensions, InterpolatesInAllElements) {
  using Point3 = base::Point<3>;
  const std::vector<Point3> cube = {{0., 0., 0.}, {2., 0., 0.}, {2., 1., 0.},    {0., 1., 0.},
                                    {0., 0., 1.}, {2., 0., 1.}, {2.2, 1.1, 1.3}, {0., 1., 1.}};
  const std::vector<Point3> tetrahedron = {{0., 0., 0.}, {1., 0., 0.}, {0., 1., 0.}, {0., 0., 1.}};
  const std::vector<Point3> wedge = {tetrahedron[0], tetrahedron[1], tetrahedron[2],
                                     {0., 0., 1.},   {1., 0.2, 1.3}, {0., 1., 1.}};
  const std::vector<Point3> pyramid = {cube[0], cube[1], cube[2], cube[3], {0.2, 0.3, 1.2}};
  const Point3 x(0.3, 0.2, 0.25);
  for (const auto& [type, corners] : {std::pair{mesh::ElementType::hex8, cube},
                                      {mesh::ElementType::tet4, tetrahedron},
                                      {mesh::ElementType::wedge6, wedge},
                                      {mesh::ElementType::pyramid5, pyramid}}) {
    SCOPED_TRACE(mesh::exodus_name(type));
    const auto shape = elements::shape_at<3>(type, corners, x);
    ASSERT_TRUE(shape);
    Point3 sum = Point3::Zero();
    for (std::size_t k = 0; k < corners.size(); ++k) sum += (*shape)(static_cast<int>(k)) * corners[k];
    EXPECT_LT((sum - x).norm(), 1e-12);
    EXPECT_FALSE(elements::shape_at<3>(type, corners, Point3(0.3, 0.2, -0.01)));
  }
}

TEST_P(Locator, RefusesAPointThatIsNowhere) {
  EXPECT_THROW(locator.find({std::nan(""), 0.}), base::Bug);
  EXPECT_THROW(elements::shape_at<2>(mesh::ElementType::tri3, {{0., 0.}, {1., 0.}}, {0., 0.}), base::Bug);
}

}  // namespace
}  // namespace perimorph::tests
