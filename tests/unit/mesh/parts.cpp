#include "perimorph/mesh/parts.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "example_meshes.hpp"
#include "perimorph/mesh/pre_crack.hpp"

namespace perimorph::mesh {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

/// A grid of n x n (x n) unit cells of which some are left out.
template <int dim>
Mesh<dim> grid_without(const std::array<int, dim>& n, const std::vector<int>& left_out) {
  const Mesh<dim> all = grid<dim>(n);
  Mesh<dim> mesh;
  mesh.coordinates = all.coordinates;
  for (int e = 0; e < all.n_elements(); ++e) {
    if (std::count(left_out.begin(), left_out.end(), e) != 0) continue;
    mesh.types.push_back(all.types[e]);
    mesh.corners.insert(mesh.corners.end(), all.corners_of(e), all.corners_of(e) + all.n_corners(e));
    mesh.first_corner.push_back(static_cast<int>(mesh.corners.size()));
  }
  find_boundary(mesh);
  return mesh;
}

TEST(Hinges, ASoundBodyHasNone) {
  EXPECT_THAT(hinges(grid<2>({3, 3})), IsEmpty());
  EXPECT_THAT(hinges(grid<3>({2, 2, 2})), IsEmpty());
}

TEST(Hinges, APreCrackAndAHoleMakeNone) {
  Mesh<2> mesh = grid<2>({4, 4});
  open_along<2>(mesh, polyline({{0, 2}, {2, 2}, {2, 3}}));
  EXPECT_THAT(hinges(mesh), IsEmpty());
  EXPECT_THAT(hinges(grid_without<2>({3, 3}, {4})), IsEmpty());
}

TEST(Hinges, TwoCellsThatMeetInACornerHangOnIt) {
  const auto mesh = grid_without<2>({2, 2}, {1, 2});  // on a diagonal
  const auto found = hinges(mesh);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].node, 4);
  EXPECT_THAT(found[0].groups, ElementsAre(ElementsAre(0), ElementsAre(1)));
  EXPECT_THAT(parts_of_elements(mesh), ElementsAre(0, 0));
  EXPECT_THAT(parts_of_elements(mesh, found), ElementsAre(0, 1));
}

TEST(Hinges, ARingThatACornerClosesHasOneThoughItIsOnePart) {
  const auto ring = grid_without<2>({3, 3}, {4, 6});  // without the middle and a corner's cell
  const auto found = hinges(ring);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].node, 9);
  const auto parts = parts_of_elements(ring, found);
  EXPECT_EQ(*std::max_element(parts.begin(), parts.end()), 0);
}

TEST(Hinges, InThreeDimensionsEdgesAndCornersAreHinges) {
  const auto edge = grid_without<3>({2, 2, 1}, {1, 2});
  EXPECT_EQ(hinges(edge).size(), 2u);  // both ends of the edge
  EXPECT_THAT(parts_of_elements(edge, hinges(edge)), ElementsAre(0, 1));
  const auto corner = grid_without<3>({2, 2, 2}, {1, 2, 3, 4, 5, 6});
  ASSERT_EQ(hinges(corner).size(), 1u);
  EXPECT_EQ(hinges(corner)[0].node, 13);
}

TEST(Parts, ThoseThatShareNoNodeAreNumberedByTheirLowestElement) {
  EXPECT_THAT(parts_of_elements(grid_without<2>({5, 1}, {2})), ElementsAre(0, 0, 1, 1));
}

TEST(CoincidentNodes, AreFoundAlongAnOpenSeamOnly) {
  Mesh<2> mesh = grid<2>({4, 4});
  EXPECT_THAT(coincident_nodes(mesh), IsEmpty());
  open_along<2>(mesh, polyline({{1, 2}, {3, 2}}));
  EXPECT_THAT(coincident_nodes(mesh), ElementsAre(Pair(12, 25)));
  mesh.coordinates[25][0] += 1e-9;  // as other programs write them
  EXPECT_THAT(coincident_nodes(mesh), ElementsAre(Pair(12, 25)));
  mesh.coordinates[25][0] += 0.1;
  EXPECT_THAT(coincident_nodes(mesh), IsEmpty());
}

}  // namespace
}  // namespace perimorph::mesh
