#include "perimorph/mesh/shared_sides.hpp"

#include <gtest/gtest.h>

#include "example_meshes.hpp"
#include "perimorph/mesh/pre_crack.hpp"

namespace perimorph::mesh {
namespace {

template <int dim>
std::vector<Side> all_sides(const Mesh<dim>& mesh) {
  std::vector<Side> all;
  for (int e = 0; e < mesh.n_elements(); ++e) {
    for (int s = 0; s < static_cast<int>(sides(mesh.types[e]).size()); ++s) all.push_back({e, s});
  }
  return all;
}

/// Three squares in a row, open between the first two if so wanted.
Mesh<2> row(bool is_cracked) {
  Mesh<2> mesh = grid<2>({3, 1});
  if (is_cracked) open_along<2>(mesh, polyline({{1., 0.}, {1., 1.}}));
  return mesh;
}

TEST(SharedSides, AreFoundByTheirNodesUnlessAPreCrackRunsBetween) {
  for (const bool is_cracked : {false, true}) {
    const Mesh<2> mesh = row(is_cracked);
    EXPECT_EQ(shared_side(mesh, 0, 1), is_cracked ? -1 : 1);
    EXPECT_EQ(shared_side(mesh, 1, 0), is_cracked ? -1 : 3);
    EXPECT_EQ(shared_side(mesh, 1, 2), 1);
    EXPECT_EQ(shared_side(mesh, 0, 2), -1);
  }
}

TEST(SharedSides, AreFoundByTheirPlacesAcrossAPreCrackToo) {
  for (const bool is_cracked : {false, true}) {
    const Mesh<2> mesh = row(is_cracked);
    const auto pairs = coincident_sides(mesh, all_sides(mesh));
    ASSERT_EQ(pairs.size(), 2u);
    EXPECT_EQ(pairs[0], (std::pair<Side, Side>{{0, 1}, {1, 3}}));
    EXPECT_EQ(pairs[1], (std::pair<Side, Side>{{1, 1}, {2, 3}}));
  }
}

TEST(SharedSides, OfSolidsAreFacesHoweverTheyAreNumbered) {
  Mesh<3> mesh = grid<3>({2, 1, 1});
  perturb(mesh);
  const int face = shared_side(mesh, 0, 1), other = shared_side(mesh, 1, 0);
  EXPECT_EQ(sides(mesh.types[0])[face], (std::vector<int>{1, 2, 6, 5}));

  const auto pairs = coincident_sides(mesh, all_sides(mesh));

  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0], (std::pair<Side, Side>{{0, face}, {1, other}}));
}

}  // namespace
}  // namespace perimorph::mesh
