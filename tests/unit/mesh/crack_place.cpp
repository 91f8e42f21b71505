#include "perimorph/mesh/crack_place.hpp"

#include <gtest/gtest.h>

#include "example_meshes.hpp"

namespace perimorph::mesh {
namespace {

/// In the unit cells of a grid of 4 x 4.
CrackPlace place_of_line(std::vector<Point<2>> corners) { return place_of<2>(grid<2>({4, 4}), polyline(corners)); }

TEST(CrackPlace, ACrackIsInTheBodyAlongSidesThroughElementsAndAtAnEdge) {
  EXPECT_EQ(place_of_line({{1, 2}, {3, 2}}), CrackPlace::inside);
  EXPECT_EQ(place_of_line({{1.3, 1.1}, {2.7, 3.4}}), CrackPlace::inside);
  EXPECT_EQ(place_of_line({{-1, 2}, {1, 2}}), CrackPlace::inside);
  EXPECT_EQ(place_of_line({{0, 2.5}, {0.5, 2.5}}), CrackPlace::inside);  // ends in the first element
  EXPECT_EQ(place_of_line({{-5, 9}, {-1, 9}, {2, 1}}), CrackPlace::inside);
}

TEST(CrackPlace, ACrackBesideTheBodyOrOnItsSurfaceIsOutside) {
  EXPECT_EQ(place_of_line({{5, 2}, {9, 2}}), CrackPlace::outside);
  EXPECT_EQ(place_of_line({{-2, 5}, {6, 5}}), CrackPlace::outside);
  EXPECT_EQ(place_of_line({{-1, 1}, {1, -1}}), CrackPlace::outside);  // past the corner, within its box
  EXPECT_EQ(place_of_line({{1, 0}, {3, 0}}), CrackPlace::outside);    // along the lower edge
  EXPECT_EQ(place_of_line({{-2, 0}, {6, 0}}), CrackPlace::outside);
  EXPECT_EQ(place_of_line({{-2, 2}, {0, 2}}), CrackPlace::outside);  // ends on the edge
  EXPECT_EQ(place_of_line({{-1, 1}, {1, -1.00001}}), CrackPlace::outside);
}

TEST(CrackPlace, ACrackMuchShorterThanElementsIsTooShortWhereverItLies) {
  EXPECT_EQ(place_of_line({{2.4, 2.5}, {2.45, 2.5}}), CrackPlace::too_short);
  EXPECT_EQ(place_of_line({{1.98, 2.5}, {2.02, 2.5}}), CrackPlace::too_short);  // through a side
  EXPECT_EQ(place_of_line({{2.4, 2}, {2.45, 2}}), CrackPlace::too_short);       // along one
  EXPECT_EQ(place_of_line({{2.4, 2.5}, {2.8, 2.5}}), CrackPlace::inside);
}

TEST(CrackPlace, AlongACrackThatTheMeshHasAlreadyItIsInside) {
  Mesh<2> mesh = grid<2>({4, 4});
  const auto crack = polyline({{1, 2}, {3, 2}});
  open_along<2>(mesh, crack);
  EXPECT_EQ(place_of<2>(mesh, crack), CrackPlace::inside);
}

TEST(CrackPlace, InThreeDimensionsFacesAndPlanesAreToldApart) {
  const Mesh<3> mesh = grid<3>({3, 3, 3});
  const auto square = [&](double z, double from, double to) {
    return place_of<3>(mesh, polygon({{from, from, z}, {to, from, z}, {to, to, z}, {from, to, z}}));
  };
  EXPECT_EQ(square(1, 1, 2), CrackPlace::inside);      // on an inner face
  EXPECT_EQ(square(1.4, 0.2, 2), CrackPlace::inside);  // through elements
  EXPECT_EQ(square(1.4, -2, 0.5), CrackPlace::inside);
  EXPECT_EQ(square(0, 1, 2), CrackPlace::outside);  // on the body's surface
  EXPECT_EQ(square(3, -1, 5), CrackPlace::outside);
  EXPECT_EQ(square(4, 1, 2), CrackPlace::outside);
  EXPECT_EQ(square(1, 3, 5), CrackPlace::outside);  // touches an edge
  EXPECT_EQ(square(1.4, 1.4, 1.5), CrackPlace::too_short);
  EXPECT_EQ(place_of<3>(mesh, disc({1.5, 1.5, 1.5}, {1, 1, 1}, 1.)), CrackPlace::inside);
  EXPECT_EQ(place_of<3>(mesh, disc({1.5, 1.5, 1500}, {1, 1, 1}, 1.)), CrackPlace::outside);
}

}  // namespace
}  // namespace perimorph::mesh
