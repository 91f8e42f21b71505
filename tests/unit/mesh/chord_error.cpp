#include "perimorph/mesh/chord_error.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/meshes.hpp"

namespace perimorph::mesh {
namespace {

constexpr double pi = 3.14159265358979323846;

/// A disc of radius 1 of n triangles around its middle.
Mesh<2> disc(int n) {
  Mesh<2> mesh;
  mesh.block_names = {"disc"};
  mesh.coordinates = {{0., 0.}};
  for (int i = 0; i < n; ++i) mesh.coordinates.emplace_back(std::cos(2. * pi * i / n), std::sin(2. * pi * i / n));
  for (int i = 0; i < n; ++i) {
    mesh.types.push_back(ElementType::tri3);
    mesh.blocks.push_back(0);
    mesh.corners.insert(mesh.corners.end(), {0, i + 1, (i + 1) % n + 1});
    mesh.first_corner.push_back(static_cast<int>(mesh.corners.size()));
  }
  tests::complete(mesh);
  return mesh;
}

TEST(ChordError, IsThatOfACircle) {
  for (const int n : {12, 40}) {
    const auto errors = chord_errors(disc(n));

    ASSERT_EQ(static_cast<int>(errors.size()), 2 * n);  // of each side at both of its ends
    const double exact = 1. - std::cos(pi / n);
    for (const auto& error : errors) EXPECT_NEAR(error.distance, exact, 0.05 * exact);
  }
}

TEST(ChordError, CornersAndStraightSidesHaveNone) {
  EXPECT_TRUE(chord_errors(tests::grid({4, 3})).empty());
  EXPECT_TRUE(chord_errors(tests::brick({2, 2, 2})).empty());
}

/// A block bent around an axis.
TEST(ChordError, OfACylinderIsThatOfItsCircle) {
  auto mesh = tests::brick({12, 2, 2});
  for (auto& x : mesh.coordinates) {
    const double angle = 0.15 * x[0], radius = 4. + x[1];
    x = {radius * std::sin(angle), radius * std::cos(angle), x[2]};
  }

  const auto errors = chord_errors(mesh);

  double largest = 0.;
  for (const auto& error : errors) largest = std::max(largest, error.distance);
  const double exact = 6. * (1. - std::cos(0.075));
  EXPECT_NEAR(largest, exact, 0.05 * exact);
}

}  // namespace
}  // namespace perimorph::mesh
