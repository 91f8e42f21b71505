#include "perimorph/base/point_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace perimorph::base {
namespace {

template <int dim>
std::vector<Point<dim>> scattered(int n) {
  std::vector<Point<dim>> points(n);
  for (int i = 0; i < n; ++i) {
    for (int c = 0; c < dim; ++c) points[i][c] = std::sin(12.9898 * i + 78.233 * c + 0.1 * i * i);
  }
  return points;
}

template <class Dimension>
class PointTreeOf : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(PointTreeOf, Dimensions);

TYPED_TEST(PointTreeOf, FindsThePointsThatBruteForceFinds) {
  constexpr int dim = TypeParam::value;
  const auto points = scattered<dim>(300);
  const PointTree<dim> tree(points);
  for (const double radius : {1e-6, 0.1, 0.7, 5.}) {
    std::vector<int> expected;
    for (int i = 0; i < 300; ++i) {
      if ((points[i] - points[7]).norm() <= radius) expected.push_back(i);
    }

    EXPECT_EQ(tree.within(points[7], radius), expected);
  }
}

TYPED_TEST(PointTreeOf, IncludesPointsOnTheSphere) {
  constexpr int dim = TypeParam::value;
  const PointTree<dim> tree({Point<dim>::Zero(), Point<dim>::Unit(0), 2. * Point<dim>::Unit(1)});
  EXPECT_EQ(tree.within(Point<dim>::Zero(), 1.), (std::vector<int>{0, 1}));
}

TYPED_TEST(PointTreeOf, EndsASearchForAnyAtTheFirstThatHolds) {
  constexpr int dim = TypeParam::value;
  const PointTree<dim> tree(scattered<dim>(300));
  for (const double radius : {1e-6, 0.1, 0.7, 5.}) {
    const Point<dim> center = scattered<dim>(300)[7];
    for (const int wanted : {7, 20, 299}) {
      int n_asked_after_it = 0;
      bool was_it = false;
      const bool is_found = tree.any_within(center, radius, [&](int i) {
        n_asked_after_it += was_it;
        return was_it = i == wanted;
      });
      const auto near = tree.within(center, radius);
      EXPECT_EQ(is_found, std::count(near.begin(), near.end(), wanted) == 1);
      EXPECT_EQ(n_asked_after_it, 0);
    }
  }
}

TYPED_TEST(PointTreeOf, RefusesARadiusThatIsNoLength) {
  constexpr int dim = TypeParam::value;
  const PointTree<dim> tree(scattered<dim>(3));
  EXPECT_THROW(tree.within(Point<dim>::Zero(), std::nan("")), Bug);
  EXPECT_THROW(tree.any_within(Point<dim>::Zero(), -1., [](int) { return true; }), Bug);
}

TYPED_TEST(PointTreeOf, MayBeEmpty) {
  constexpr int dim = TypeParam::value;
  EXPECT_TRUE(PointTree<dim>({}).within(Point<dim>::Zero(), 1.).empty());
  EXPECT_FALSE(PointTree<dim>({}).any_within(Point<dim>::Zero(), 1., [](int) { return true; }));
}

}  // namespace
}  // namespace perimorph::base
