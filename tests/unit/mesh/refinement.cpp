#include "perimorph/mesh/refinement.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <set>

#include "perimorph/base/errors.hpp"
#include "perimorph/mesh/pre_crack.hpp"
#include "perimorph/mesh/sorted_sides.hpp"
#include "support/meshes.hpp"

namespace perimorph::mesh {
namespace {

using tests::brick;
using tests::grid;
using tests::Point2;
using tests::Point3;

/// So many levels within a radius of a place, and one less beyond.
template <int dim>
LevelRule<dim> around(const Point<dim>& place, int levels, double within) {
  return [=](const Point<dim>& center, double radius, double) {
    return (center - place).norm() - radius <= within ? levels : 0;
  };
}

/// Of a triangle or a tetrahedron with its right-handed corners: twice or six times its size.
double content(const Point2& a, const Point2& b, const Point2& c) {
  return (b - a)[0] * (c - a)[1] - (b - a)[1] * (c - a)[0];
}
double content(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  return (b - a).cross(c - a).dot(d - a);
}

/// Smallest and sum over elements of those that they are cut into at one corner and the opposite one.
template <int dim>
std::pair<double, double> contents(const Mesh<dim>& mesh) {
  double smallest = 1e30, sum = 0.;
  const auto add = [&](double one) {
    smallest = std::min(smallest, one);
    sum += one;
  };
  for (int e = 0; e < mesh.n_elements(); ++e) {
    const auto x = [&](int k) { return mesh.coordinates[mesh.corners_of(e)[k]]; };
    if constexpr (dim == 2) {
      add(content(x(0), x(1), x(2)));
      if (mesh.n_corners(e) == 4) add(content(x(0), x(2), x(3)));
    } else if (mesh.n_corners(e) == 4) {
      add(content(x(0), x(1), x(2), x(3)));
    } else {
      constexpr int parts[5][4] = {{0, 1, 3, 4}, {1, 2, 3, 6}, {1, 3, 4, 6}, {1, 4, 5, 6}, {3, 4, 6, 7}};
      for (const auto& p : parts) add(content(x(p[0]), x(p[1]), x(p[2]), x(p[3])));
    }
  }
  return {smallest, sum};
}

/// Sides of which one is a whole side and the others are what a division makes of it, or that only the boundary has.
template <int dim>
void expect_closed(const Mesh<dim>& mesh) {
  std::map<SideKey, int> count;
  for (const auto& keyed : sorted_sides(mesh)) ++count[keyed.key];
  std::set<SideKey> boundary;
  for (const auto& side : mesh.boundary) boundary.insert(side_key(side_nodes(mesh, side)));
  std::map<int, std::set<int>> middle_of;  // parents of a hanging node
  for (const auto& [node, n, parents] : mesh.hanging_nodes) {
    middle_of[node] = {parents.begin(), parents.begin() + n};
  }
  int n_at_hanging = 0;
  for (const auto& [key, n] : count) {
    if (boundary.count(key) > 0) {
      EXPECT_EQ(n, 1);
    } else if (n == 1) {  // the larger one's nodes are parents, the smaller one's nodes hang or are parents
      const bool is_smaller = std::any_of(key.begin(), key.end(), [&](int node) { return middle_of.count(node) > 0; });
      const bool is_larger = std::any_of(middle_of.begin(), middle_of.end(), [&](const auto& entry) {
        const auto found = [&](int node) { return std::find(key.begin(), key.end(), node) != key.end(); };
        return std::all_of(entry.second.begin(), entry.second.end(), found);
      });
      EXPECT_TRUE(is_smaller || is_larger);
      ++n_at_hanging;
    } else {
      EXPECT_EQ(n, 2);
    }
  }
  EXPECT_EQ(n_at_hanging > 0, !mesh.hanging_nodes.empty());
}

template <int dim>
void expect_hanging_nodes_in_the_middle(const Mesh<dim>& mesh) {
  std::set<int> hanging;
  for (const auto& one : mesh.hanging_nodes) EXPECT_TRUE(hanging.insert(one.node).second);
  for (const auto& [node, n, parents] : mesh.hanging_nodes) {
    Point<dim> sum = Point<dim>::Zero();
    for (int i = 0; i < n; ++i) {
      sum += mesh.coordinates[parents[i]];
      EXPECT_EQ(hanging.count(parents[i]), 0);
    }
    EXPECT_LT((sum / n - mesh.coordinates[node]).norm(), 1e-14);
  }
}

template <int dim>
void expect_sound(const Mesh<dim>& root, const Point<dim>& place, int levels) {
  const auto refined = refine<dim>(root, around<dim>(place, levels, 0.1));
  const auto& mesh = refined.mesh;

  EXPECT_GT(mesh.n_elements(), root.n_elements());
  EXPECT_FALSE(mesh.hanging_nodes.empty());
  const auto [smallest, sum] = contents(mesh);
  EXPECT_GT(smallest, 0.);
  EXPECT_NEAR(sum, contents(root).second, 1e-10 * sum);
  int finest = 0;
  for (const auto& path : refined.paths) finest = std::max(finest, path.level);
  EXPECT_EQ(finest, levels);
  expect_hanging_nodes_in_the_middle(mesh);
  expect_closed(mesh);
}

TEST(Refinement, OfQuadrilateralsIsSound) { expect_sound<2>(grid({4, 3, 4., 3., Point2::Zero(), 0.2}), {1.3, 1.2}, 4); }

TEST(Refinement, OfTrianglesIsSound) {
  expect_sound<2>(grid({4, 3, 4., 3., Point2::Zero(), 0.2, true}), {1.3, 1.2}, 4);
}

TEST(Refinement, OfHexahedraIsSound) { expect_sound<3>(brick({3, 3, 3}), {1.3, 1.2, 0.4}, 3); }

TEST(Refinement, OfTetrahedraIsSound) { expect_sound<3>(brick({3, 3, 3, 0.1, ElementType::tet4}), {1.3, 1.2, 0.4}, 3); }

TEST(Refinement, KeepsTetrahedraInShape) {
  const auto root = brick({1, 1, 1, 0., ElementType::tet4});
  const auto largest_radius = [&](int levels) {
    const auto refined = refine<3>(root, [=](const Point3&, double, double) { return levels; });
    EXPECT_TRUE(refined.mesh.hanging_nodes.empty());
    double largest = 0.;
    for (int e = 0; e < refined.mesh.n_elements(); ++e) largest = std::max(largest, radius(refined.mesh, e));
    return largest;
  };

  EXPECT_NEAR(largest_radius(4), largest_radius(1) / 8., 1e-12);
}

TEST(Refinement, ElementsAtANodeDifferByOneLevel) {
  const auto refined = refine<2>(grid({2, 2, 2., 2.}), around<2>({0.01, 0.01}, 6, 0.));

  const auto& mesh = refined.mesh;
  std::vector<int> lowest(mesh.n_nodes(), 99), highest(mesh.n_nodes(), 0);
  for (int e = 0; e < mesh.n_elements(); ++e) {
    for (int k = 0; k < 4; ++k) {
      const int node = mesh.corners_of(e)[k];
      lowest[node] = std::min(lowest[node], refined.paths[e].level);
      highest[node] = std::max(highest[node], refined.paths[e].level);
    }
  }
  for (int n = 0; n < mesh.n_nodes(); ++n) EXPECT_LE(highest[n] - lowest[n], 1);
  EXPECT_LT(mesh.n_elements(), 150);
}

TEST(Refinement, GroupsAndBoundaryFollow) {
  const auto refined = refine<2>(grid({4, 3, 4., 3.}), around<2>({4., 3.}, 3, 0.5));

  const auto& mesh = refined.mesh;
  double length = 0.;
  for (const auto& side : mesh.side_sets.at("right")) {
    const auto ends = corner_points(mesh, side);
    length += (ends[1] - ends[0]).norm();
    EXPECT_EQ(ends[0][0], 4.);
  }
  EXPECT_DOUBLE_EQ(length, 3.);
  for (const char* name : {"left", "right"}) {  // without and with sides
    std::vector<int> expected;
    for (int n = 0; n < mesh.n_nodes(); ++n) {
      if (mesh.coordinates[n][0] == (name == std::string("left") ? 0. : 4.)) expected.push_back(n);
    }
    EXPECT_EQ(mesh.node_sets.at(name), expected);
  }
  EXPECT_GT(mesh.node_sets.at("right").size(), 8u);
  double around_it = 0.;
  for (const auto& side : mesh.boundary) {
    const auto ends = corner_points(mesh, side);
    around_it += (ends[1] - ends[0]).norm();
  }
  EXPECT_DOUBLE_EQ(around_it, 14.);
}

TEST(Refinement, PreCracksAlongSidesStayOpen) {
  auto root = grid({4, 4, 4., 4.});
  ASSERT_EQ(open_along<2>(root, {{Point2(0., 2.), Point2(2., 2.)}}), 2);

  const auto refined = refine<2>(root, around<2>({2., 2.}, 3, 0.3));

  double length = 0.;
  for (const auto& side : refined.mesh.boundary) {
    const auto ends = corner_points(refined.mesh, side);
    length += (ends[1] - ends[0]).norm();
  }
  EXPECT_DOUBLE_EQ(length, 16. + 2. * 2.);
  expect_closed(refined.mesh);
}

TEST(Refinement, DoesNotDivideWedges) {
  const auto root = brick({2, 2, 2, 0., ElementType::wedge6});

  EXPECT_THAT(
      [&] {
        refine<3>(root, around<3>({0.1, 0.1, 0.1}, 1, 0.));
      },
      testing::ThrowsMessage<base::UserError>(testing::HasSubstr("WEDGE at (")));
  EXPECT_EQ(refine<3>(root, [](const Point3&, double, double) { return 0; }).mesh.n_elements(), root.n_elements());
}

template <int dim>
void expect_linear_fields_descend(const Mesh<dim>& root, const Point<dim>& place) {
  const auto coarser = refine<dim>(root, around<dim>(place, 2, 0.1));
  const auto finer = refine<dim>(root, around<dim>(place, 3, 0.6));

  const auto all = descents(coarser, finer);

  ASSERT_EQ(static_cast<int>(all.size()), finer.mesh.n_elements());
  int n_same = 0;
  for (int e = 0; e < finer.mesh.n_elements(); ++e) {
    const auto& [ancestor, weights] = all[e];
    const int* corners = coarser.mesh.corners_of(ancestor);
    n_same += weights.empty();
    for (int k = 0; k < finer.mesh.n_corners(e); ++k) {
      const Point<dim> x = finer.mesh.coordinates[finer.mesh.corners_of(e)[k]];
      Point<dim> interpolated = weights.empty() ? coarser.mesh.coordinates[corners[k]] : Point<dim>::Zero();
      for (std::size_t l = 0; l < weights.size(); ++l) {
        interpolated += weights[k][l] * coarser.mesh.coordinates[corners[l]];
      }
      EXPECT_LT((interpolated - x).norm(), 1e-13);
    }
  }
  EXPECT_GT(n_same, 0);
  EXPECT_LT(n_same, finer.mesh.n_elements());
}

TEST(Refinement, FieldsDescendToFinerMeshes) {
  expect_linear_fields_descend<2>(grid({4, 3, 4., 3., Point2::Zero(), 0.2}), {1.3, 1.2});
  expect_linear_fields_descend<2>(grid({4, 3, 4., 3., Point2::Zero(), 0.2, true}), {1.3, 1.2});
  expect_linear_fields_descend<3>(brick({3, 3, 3, 0.1, ElementType::tet4}), {1.3, 1.2, 0.4});
  expect_linear_fields_descend<3>(brick({3, 3, 3}), {1.3, 1.2, 0.4});
}

}  // namespace
}  // namespace perimorph::mesh
