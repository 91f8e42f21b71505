#include "perimorph/mesh/pre_crack.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "example_meshes.hpp"

namespace perimorph::mesh {
namespace {

using Segment = CrackFacet<2>;
using Triangle = CrackFacet<3>;
using testing::ElementsAre;

/// Nodes at a position, ascending.
template <int dim>
std::vector<int> nodes_at(const Mesh<dim>& mesh, const Point<dim>& position) {
  std::vector<int> found;
  for (int n = 0; n < mesh.n_nodes(); ++n) {
    if ((mesh.coordinates[n] - position).norm() < 1e-12) found.push_back(n);
  }
  return found;
}

template <int dim>
std::size_t n_nodes_at(const Mesh<dim>& mesh, const Point<dim>& position) {
  return nodes_at<dim>(mesh, position).size();
}

TEST(OpenAlong, InnerSlitHasClosedTipsAndDoubledNodesBetween) {
  Mesh<2> mesh = grid<2>({4, 4});

  const int opened = open_along<2>(mesh, {Segment{Point<2>(1, 2), Point<2>(3, 2)}});

  EXPECT_EQ(opened, 2);
  EXPECT_EQ(n_nodes_at<2>(mesh, {1, 2}), 1u);
  EXPECT_EQ(n_nodes_at<2>(mesh, {2, 2}), 2u);
  EXPECT_EQ(n_nodes_at<2>(mesh, {3, 2}), 1u);
  EXPECT_EQ(mesh.n_nodes(), 26);
}

TEST(OpenAlong, EdgeSlitIsOpenAtTheBoundaryToo) {
  Mesh<2> mesh = grid<2>({4, 4});

  const int opened = open_along<2>(mesh, {Segment{Point<2>(-1, 2), Point<2>(2, 2)}});

  EXPECT_EQ(opened, 2);
  EXPECT_EQ(n_nodes_at<2>(mesh, {0, 2}), 2u);
  EXPECT_EQ(n_nodes_at<2>(mesh, {1, 2}), 2u);
  EXPECT_EQ(n_nodes_at<2>(mesh, {2, 2}), 1u);
}

TEST(OpenAlong, TheElementsBelowKeepTheNodesAndThoseAboveGetTheNewOnes) {
  Mesh<2> mesh = grid<2>({4, 4});

  open_along<2>(mesh, {Segment{Point<2>(1, 2), Point<2>(3, 2)}});

  const int old_node = 12, new_node = 25;
  EXPECT_EQ(mesh.corners_of(5)[2], old_node);
  EXPECT_EQ(mesh.corners_of(6)[3], old_node);
  EXPECT_EQ(mesh.corners_of(9)[1], new_node);
  EXPECT_EQ(mesh.corners_of(10)[0], new_node);
}

TEST(OpenAlong, TheBoundaryGainsBothFacesOfTheSlit) {
  Mesh<2> mesh = grid<2>({4, 4});
  const std::size_t before = mesh.boundary.size();

  open_along<2>(mesh, {Segment{Point<2>(1, 2), Point<2>(3, 2)}});

  EXPECT_EQ(mesh.boundary.size(), before + 4);
  for (const Side& face : {Side{5, 2}, Side{6, 2}, Side{9, 0}, Side{10, 0}}) {
    EXPECT_THAT(mesh.boundary, testing::Contains(face));
  }
}

TEST(OpenAlong, NodeSetsGetTheNewNodesAndStayAscending) {
  Mesh<2> mesh = grid<2>({4, 4});
  mesh.node_sets["middle"] = {10, 11, 12, 13, 14};

  open_along<2>(mesh, {Segment{Point<2>(0, 2), Point<2>(3, 2)}});

  EXPECT_THAT(mesh.node_sets.at("middle"), ElementsAre(10, 11, 12, 13, 14, 25, 26, 27));
  EXPECT_THAT(mesh.node_sets.at("left"), ElementsAre(0, 5, 10, 15, 20, 25));
  EXPECT_THAT(mesh.node_sets.at("corner"), ElementsAre(0));
}

TEST(OpenAlong, TheMeshStaysConsistent) {
  Mesh<2> mesh = grid<2>({4, 4});

  open_along<2>(mesh, {Segment{Point<2>(0, 2), Point<2>(3, 2)}});

  EXPECT_EQ(mesh.n_owned_nodes, mesh.n_nodes());
  EXPECT_EQ(mesh.n_global_nodes, mesh.n_nodes());
  ASSERT_EQ(mesh.node_ids.size(), mesh.coordinates.size());
  ASSERT_EQ(mesh.node_owners.size(), mesh.coordinates.size());
  EXPECT_EQ(mesh.node_ids.back(), mesh.n_nodes() - 1);
}

TEST(OpenAlong, ACutThroughTheWholeBodyMakesTwo) {
  Mesh<2> mesh = grid<2>({3, 2});

  const int opened = open_along<2>(mesh, {Segment{Point<2>(0, 1), Point<2>(3, 1)}});

  EXPECT_EQ(opened, 3);
  EXPECT_EQ(mesh.n_nodes(), 16);
}

TEST(OpenAlong, ACrackThatCutsThroughElementsOpensNothing) {
  Mesh<2> mesh = grid<2>({4, 4});
  const auto corners = mesh.corners;

  EXPECT_EQ(open_along<2>(mesh, {Segment{Point<2>(0, 2.3), Point<2>(3, 2.3)}}), 0);
  EXPECT_EQ(open_along<2>(mesh, {Segment{Point<2>(0, 2. + 1e-5), Point<2>(3, 2. + 1e-5)}}), 0);
  EXPECT_EQ(mesh.corners, corners);
}

TEST(OpenAlong, ACrackOffByLessThanAMillionthOfASideStillRunsAlongIt) {
  Mesh<2> mesh = grid<2>({4, 4});
  EXPECT_EQ(open_along<2>(mesh, {Segment{Point<2>(0, 2. + 1e-7), Point<2>(3, 2. - 1e-7)}}), 3);
}

TEST(OpenAlong, ASingleInnerSideHasTwoTipsAndStaysClosed) {
  Mesh<2> mesh = grid<2>({4, 4});
  EXPECT_EQ(open_along<2>(mesh, {Segment{Point<2>(1, 2), Point<2>(2, 2)}}), 0);
  EXPECT_EQ(mesh.n_nodes(), 25);
}

TEST(OpenAlong, ASideThatEndsBeyondTheTipIsNotOpened) {
  Mesh<2> mesh = grid<2>({4, 4});
  EXPECT_EQ(open_along<2>(mesh, {Segment{Point<2>(0, 2), Point<2>(2.5, 2)}}), 2);
}

TEST(OpenAlong, CrossingCracksPartTheirCommonNodeInFour) {
  Mesh<2> mesh = grid<2>({4, 4});

  const int opened =
      open_along<2>(mesh, {Segment{Point<2>(1, 2), Point<2>(3, 2)}, Segment{Point<2>(2, 1), Point<2>(2, 3)}});

  EXPECT_EQ(opened, 4);
  EXPECT_EQ(n_nodes_at<2>(mesh, {2, 2}), 4u);
  EXPECT_EQ(mesh.n_nodes(), 28);
}

TEST(OpenAlong, ASideBetweenTheArmsOfAKinkIsNotOnTheCrack) {
  Mesh<2> mesh = grid<2>({2, 2});
  const std::vector<Segment> kink = {Segment{Point<2>(1, 0), Point<2>(0.5, -1)},
                                     Segment{Point<2>(0.5, -1), Point<2>(1, 1)}};
  EXPECT_EQ(open_along<2>(mesh, kink), 0);
}

TEST(OpenAlong, ACrackOfSeveralSegmentsOpensThroughTheirJoints) {
  Mesh<2> mesh = grid<2>({4, 4});

  const int opened =
      open_along<2>(mesh, {Segment{Point<2>(0, 2), Point<2>(0.5, 2)}, Segment{Point<2>(0.5, 2), Point<2>(2, 2)},
                           Segment{Point<2>(2, 2), Point<2>(2, 3)}});

  EXPECT_EQ(opened, 3);
  EXPECT_EQ(n_nodes_at<2>(mesh, {2, 2}), 2u);
  EXPECT_EQ(n_nodes_at<2>(mesh, {2, 3}), 1u);
}

/// A rectangle in the plane z = 1 as two triangles.
std::vector<Triangle> rectangle(double x0, double x1, double y0, double y1) {
  const Point<3> a(x0, y0, 1), b(x1, y0, 1), c(x1, y1, 1), d(x0, y1, 1);
  return {Triangle{a, b, c}, Triangle{a, c, d}};
}

TEST(OpenAlong, InnerSlitInASolidKeepsItsFrontClosed) {
  Mesh<3> mesh = grid<3>({4, 4, 2});

  const int opened = open_along<3>(mesh, rectangle(1, 3, 1, 3));

  EXPECT_EQ(opened, 4);
  EXPECT_EQ(mesh.n_nodes(), 5 * 5 * 3 + 1);
  EXPECT_EQ(n_nodes_at<3>(mesh, {2, 2, 1}), 2u);
  EXPECT_EQ(n_nodes_at<3>(mesh, {1, 2, 1}), 1u);
}

TEST(OpenAlong, EdgeSlitThroughTheThicknessOfASolidIsOpenOnThreeFaces) {
  Mesh<3> mesh = grid<3>({4, 2, 2});

  const int opened = open_along<3>(mesh, rectangle(0, 2, 0, 2));

  EXPECT_EQ(opened, 4);
  EXPECT_EQ(mesh.n_nodes(), 5 * 3 * 3 + 6);
  EXPECT_EQ(n_nodes_at<3>(mesh, {2, 1, 1}), 1u);
}

TEST(Disc, ItsTrianglesHoldTheRimAndLittleMore) {
  const Point<3> center(1., 2., 3.), normal(0.3, -0.4, 1.2);
  constexpr double radius = 2., pi = 3.14159265358979323846;

  const auto triangles = disc(center, normal, radius);

  double area = 0.;
  for (const auto& t : triangles) {
    area += 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm();
    for (const auto& corner : t) EXPECT_NEAR((corner - center).dot(normal), 0., 1e-12);
    EXPECT_NEAR((0.5 * (t[1] + t[2]) - center).norm(), radius, 1e-12);  // sides touch the rim from outside
  }
  EXPECT_NEAR(area, pi * radius * radius, 1e-3 * area);
}

TEST(Disc, TheFacesInsideItAreOpened) {
  Mesh<3> mesh = grid<3>({6, 6, 6});
  // Of the 16 faces around the middle, those 4 whose corners all lie within 1.5.
  EXPECT_EQ(open_along<3>(mesh, disc({3., 3., 3.}, {0., 0., 1.}, 1.5)), 4);
  EXPECT_EQ(n_nodes_at<3>(mesh, {3., 3., 3.}), 2u);
  EXPECT_EQ(n_nodes_at<3>(mesh, {4., 3., 3.}), 1u);
}

TEST(PreCrack, RefusesWhatIsNoCrackAndAMeshThatIsNotWhole) {
  EXPECT_THROW(polyline({{0., 0.}}), base::Bug);
  EXPECT_THROW(polygon({{0., 0., 0.}, {1., 0., 0.}}), base::Bug);
  EXPECT_THROW(disc({0., 0., 0.}, {0., 0., 0.}, 1.), base::Bug);
  EXPECT_THROW(disc({0., 0., 0.}, {0., 0., 1.}, 0.), base::Bug);
  Mesh<2> mesh = grid<2>({4, 4});
  EXPECT_THROW(open_along<2>(mesh, {{Point<2>(0., 2.), Point<2>(std::nan(""), 2.)}}), base::Bug);
  mesh.n_global_elements = 20;
  EXPECT_THROW(open_along<2>(mesh, {{Point<2>(0., 2.), Point<2>(2., 2.)}}), base::Bug);
}

}  // namespace
}  // namespace perimorph::mesh
