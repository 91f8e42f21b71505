#include "perimorph/elements/reference_element.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "perimorph/base/errors.hpp"

namespace perimorph::elements {
namespace {

using mesh::ElementType;

constexpr double rounding = 1e-14;  // values of order 1

template <int dim>
void expect_partition_of_unity(ElementType type, double volume) {
  for (int n = 1; n <= 3; ++n) {
    SCOPED_TRACE(mesh::exodus_name(type) + " with rule " + std::to_string(n));
    const auto& table = reference_element<dim>(type, n);
    EXPECT_EQ(table.n_corners, mesh::n_corners(type));
    EXPECT_NEAR(std::accumulate(table.weights.begin(), table.weights.end(), 0.), volume, 8. * rounding);
    for (int q = 0; q < table.n_points; ++q) {
      EXPECT_NEAR(table.shape[q].sum(), 1., rounding);
      EXPECT_LT(table.gradients[q].rowwise().sum().cwiseAbs().maxCoeff(), rounding);
    }
  }
}

TEST(ReferenceElement, ShapeFunctionsSumToOneAndWeightsToTheVolume) {
  expect_partition_of_unity<2>(ElementType::quad4, 4.);
  expect_partition_of_unity<2>(ElementType::tri3, 0.5);
  expect_partition_of_unity<3>(ElementType::hex8, 8.);
  expect_partition_of_unity<3>(ElementType::tet4, 1. / 6.);
  expect_partition_of_unity<3>(ElementType::pyramid5, 4. / 3.);
  expect_partition_of_unity<3>(ElementType::wedge6, 1.);
}

TEST(ReferenceElement, RulesHaveTheNumberOfPointsTheySay) {
  const int squares[] = {1, 4, 9}, cubes[] = {1, 8, 27}, triangles[] = {1, 3, 6}, tetrahedra[] = {1, 4, 11},
            wedges[] = {1, 6, 18};
  for (int n = 1; n <= 3; ++n) {
    EXPECT_EQ(reference_element<2>(ElementType::quad4, n).n_points, squares[n - 1]);
    EXPECT_EQ(reference_element<3>(ElementType::hex8, n).n_points, cubes[n - 1]);
    EXPECT_EQ(reference_element<2>(ElementType::tri3, n).n_points, triangles[n - 1]);
    EXPECT_EQ(reference_element<3>(ElementType::tet4, n).n_points, tetrahedra[n - 1]);
    EXPECT_EQ(reference_element<3>(ElementType::pyramid5, n).n_points, cubes[n - 1]);
    EXPECT_EQ(reference_element<3>(ElementType::wedge6, n).n_points, wedges[n - 1]);
  }
}

/// Int x^2 over the reference element, x taken from the corners: exact for every rule from the second on.
template <int dim>
double second_moment(ElementType type, const std::vector<double>& corner_x) {
  const auto& table = reference_element<dim>(type);
  double sum = 0.;
  for (int q = 0; q < table.n_points; ++q) {
    double x = 0.;
    for (int k = 0; k < table.n_corners; ++k) x += table.shape[q](k) * corner_x[k];
    sum += table.weights[q] * x * x;
  }
  return sum;
}

TEST(ReferenceElement, TheUsualRuleIntegratesSquaresExactly) {
  EXPECT_NEAR(second_moment<2>(ElementType::quad4, {-1, 1, 1, -1}), 4. / 3., 4. * rounding);
  EXPECT_NEAR(second_moment<2>(ElementType::tri3, {0, 1, 0}), 1. / 12., rounding);
  EXPECT_NEAR(second_moment<3>(ElementType::hex8, {-1, 1, 1, -1, -1, 1, 1, -1}), 8. / 3., 8. * rounding);
  EXPECT_NEAR(second_moment<3>(ElementType::tet4, {0, 1, 0, 0}), 1. / 60., rounding);
  EXPECT_NEAR(second_moment<3>(ElementType::pyramid5, {-1, 1, 1, -1, 0}), 4. / 15., rounding);
  EXPECT_NEAR(second_moment<3>(ElementType::wedge6, {0, 1, 0, 0, 1, 0}), 1. / 6., rounding);
}

TEST(ReferenceElement, IsMadeOncePerTypeAndRule) {
  const auto& table = reference_element<2>(ElementType::quad4, 2);
  EXPECT_EQ(&table, &reference_element<2>(ElementType::quad4, 2));
  EXPECT_NE(&table, &reference_element<2>(ElementType::quad4, 3));
}

TEST(ReferenceElement, RefusesATypeOfAnotherDimensionAndAnUnknownRule) {
  EXPECT_THROW(reference_element<2>(ElementType::hex8), base::Bug);
  EXPECT_THROW(reference_element<2>(ElementType::quad4, 4), base::Bug);
}

}  // namespace
}  // namespace perimorph::elements
