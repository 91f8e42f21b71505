#include "perimorph/mesh/perturbation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "perimorph/mesh/orientation.hpp"
#include "perimorph/mesh/refinement.hpp"
#include "perimorph/mesh/sorted_sides.hpp"
#include "support/meshes.hpp"

namespace perimorph::mesh {
namespace {

using tests::brick;
using tests::grid;
using tests::Point2;

std::vector<char> all_of(int n) { return std::vector<char>(n, 1); }

template <int dim>
void expect_inner_nodes_move(Mesh<dim> whole, double share) {
  const std::vector<int> boundary = whole.node_sets.at("boundary");
  whole.node_sets = {{"some", {whole.corners_of(whole.n_elements() / 2)[0]}}};
  const Mesh<dim> before = whole;

  perturb(whole, share, node_keys(whole.n_nodes()), all_of(whole.n_elements()));

  double largest = 0.;
  Point<dim> sum = Point<dim>::Zero();
  for (int n = 0; n < whole.n_nodes(); ++n) {
    const Point<dim> move = whole.coordinates[n] - before.coordinates[n];
    const bool stays = std::binary_search(boundary.begin(), boundary.end(), n) || n == whole.node_sets.at("some")[0];
    EXPECT_TRUE(!stays || move.norm() == 0.);
    largest = std::max(largest, move.cwiseAbs().maxCoeff());
    sum += move;
  }
  EXPECT_LE(largest, share);
  EXPECT_GT(largest, 0.8 * share);
  EXPECT_LT(sum.norm() / whole.n_nodes(), 0.1 * share);
  for (int e = 0; e < whole.n_elements(); ++e) {
    EXPECT_GE(smallest_corner_volume(whole, e), 0.5 * smallest_corner_volume(before, e));
  }
}

TEST(Perturbation, MovesInnerNodesOnly) {
  expect_inner_nodes_move<2>(grid({20, 20, 20., 20.}), 0.2);
  expect_inner_nodes_move<2>(grid({20, 20, 20., 20.}), 0.4);
  expect_inner_nodes_move<2>(grid({20, 20, 20., 20., Point2::Zero(), 0., true}), 0.2);
  expect_inner_nodes_move<3>(brick({8, 8, 8}), 0.2);
}

TEST(Perturbation, LeavesNodesBetweenBlocks) {
  auto whole = grid({6, 6, 6., 6.});
  whole.node_sets.clear();
  whole.block_names = {"left", "right"};
  for (int e = 0; e < whole.n_elements(); ++e) whole.blocks[e] = centroid(whole, e)[0] < 3. ? 0 : 1;

  perturb(whole, 0.3, node_keys(whole.n_nodes()), all_of(whole.n_elements()));

  for (int j = 0; j <= 6; ++j) EXPECT_EQ(whole.coordinates[7 * j + 3][0], 3.);
}

TEST(Perturbation, IsTheSameOnAFinerMesh) {
  const auto root = grid({8, 8, 8., 8.});
  const auto within = [](double radius) {
    return [=](const Point2& center, double reach, double) {
      return (center - Point2(3.2, 4.1)).norm() - reach < radius ? 2 : 0;
    };
  };
  const auto moves = [&](double radius) {
    auto refined = refine<2>(root, within(radius));
    refined.mesh.node_sets.clear();
    std::vector<char> are_finest;
    for (const auto& path : refined.paths) are_finest.push_back(static_cast<char>(path.level == 2));
    const auto before = refined.mesh.coordinates;
    perturb(refined.mesh, 0.2, refined.node_keys, are_finest);
    std::map<std::pair<double, double>, Point2> by_place;
    for (std::size_t n = 0; n < before.size(); ++n) {
      const Point2 move = refined.mesh.coordinates[n] - before[n];
      if (move.norm() > 0.) by_place[{before[n][0], before[n][1]}] = move;
    }
    return by_place;
  };

  const auto coarser = moves(1.), finer = moves(2.);

  EXPECT_GT(coarser.size(), 50u);
  EXPECT_GT(finer.size(), coarser.size());
  for (const auto& [place, move] : coarser) EXPECT_EQ(finer.at(place), move);
}

}  // namespace
}  // namespace perimorph::mesh
