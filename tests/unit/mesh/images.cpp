#include "perimorph/mesh/images.hpp"

#include <gtest/gtest.h>

#include <Teuchos_DefaultSerialComm.hpp>
#include <algorithm>

#include "perimorph/mesh/sorted_sides.hpp"
#include "support/meshes.hpp"

namespace perimorph::tests {
namespace {

const Teuchos::SerialComm<int> alone;

/// 4 x 3 squares of size 1.
mesh::Mesh<2> mirrored(const std::vector<std::string>& groups, double width) {
  auto mesh = grid({4, 3, 4., 3.});
  std::vector<mesh::SymmetryPlane> planes;
  for (const auto& group : groups) planes.push_back(mesh::symmetry_plane(alone, mesh, group));
  mesh::add_images(mesh, std::move(planes), width);
  return mesh;
}

TEST(SymmetryPlane, IsAcrossTheAxisOfItsNodes) {
  const auto mesh = grid({4, 3, 4., 3.});
  const auto right = mesh::symmetry_plane(alone, mesh, "right"), bottom = mesh::symmetry_plane(alone, mesh, "bottom");
  EXPECT_EQ(right.axis, 0);
  EXPECT_EQ(right.place, 4.);
  EXPECT_EQ(right.nodes, mesh.node_sets.at("right"));
  EXPECT_EQ(bottom.axis, 1);
}

TEST(Images, AreThoseOfTheElementsInReach) {
  const auto mesh = mirrored({"left"}, 1.5);  // two columns
  ASSERT_EQ(mesh.n_elements(), 12 + 6);
  EXPECT_EQ(mesh.n_real_elements(), 12);
  EXPECT_EQ(mesh.n_owned_elements, 12);
  EXPECT_EQ(mesh.n_nodes(), 20 + 8);  // those on the plane are shared
  for (int e = 12; e < 18; ++e) {
    const int source = mesh.image(e).element;
    EXPECT_EQ(mesh.element_ids[e], mesh.element_ids[source] + 12);
    EXPECT_EQ(mesh.image(e).signs, Point2(-1., 1.));
    for (int k = 0; k < 4; ++k) {
      const auto &x = mesh.coordinates[mesh.corners_of(source)[k]], &y = mesh.coordinates[mesh.corners_of(e)[k]];
      EXPECT_EQ(y, Point2(-x[0], x[1]));
    }
  }
}

TEST(Images, HaveImagesAcrossAnotherPlane) {
  const auto mesh = mirrored({"right", "top"}, 1.);  // two columns and two rows: a side that is just as far counts
  EXPECT_EQ(mesh.n_elements(), 12 + 6 + 8 + 4);
  std::vector<base::GlobalId> ids = mesh.element_ids;
  std::sort(ids.begin(), ids.end());
  EXPECT_EQ(std::adjacent_find(ids.begin(), ids.end()), ids.end());
  const auto at_corner = [](const mesh::Image<2>& image) { return image.signs == Point2(-1., -1.); };
  EXPECT_EQ(std::count_if(mesh.images.begin(), mesh.images.end(), at_corner), 4);
}

TEST(Images, HaveABoundaryOfTheirOwnAndNoneOnThePlane) {
  const auto mesh = mirrored({"left"}, 1.5);
  const auto before = grid({4, 3, 4., 3.}).boundary.size();
  EXPECT_EQ(mesh.boundary.size(), before - 3 + 4);  // two columns, above and below
  for (const auto& side : mesh.boundary) {
    const auto corners = mesh::corner_points(mesh, side);
    EXPECT_FALSE(corners[0][0] == 0. && corners[1][0] == 0.);
  }
}

TEST(Images, OfFacetsAreOnTheOtherSide) {
  const auto mesh = mirrored({"left"}, 1.5);
  const auto facets = mesh::with_images<2>({{Point2(0., 1.), Point2(2., 1.5)}}, mesh.symmetry_planes);
  ASSERT_EQ(facets.size(), 2u);
  EXPECT_EQ(facets[1][1], Point2(-2., 1.5));
}

}  // namespace
}  // namespace perimorph::tests
