// Where elements of different sizes meet.

#include "perimorph/mesh/refinement.hpp"

#include <gtest/gtest.h>

#include "patch.hpp"

namespace perimorph::tests {
namespace {

constexpr double rounding = 1e-10;  // the residual's tolerance, 1e-13, times the condition number, some hundreds

/// Two levels in a ball.
template <int dim>
mesh::Mesh<dim> refined(const mesh::Mesh<dim>& root, const base::Point<dim>& center, double within, int levels = 2) {
  return mesh::refine<dim>(root, [&](const base::Point<dim>& x, double radius,
                                     double) { return (x - center).norm() - radius < within ? levels : 0; })
      .mesh;
}

template <int dim>
void expect_linear_field(const mesh::Mesh<dim>& whole, const GradientIn<dim>& gradient) {
  ASSERT_FALSE(whole.hanging_nodes.empty());
  SpecimenIn<dim> specimen = patch<dim>(whole, 3., 0.2, gradient);
  specimen.tolerance = 1e-13;

  const Errors actual = solve<dim>(specimen, gradient);

  EXPECT_LT(actual.displacement, rounding);
  EXPECT_LT(actual.strain, rounding);
}

TEST(HangingNodes, LinearFieldIsReproducedToRounding) {
  const GradientIn<2> any = (GradientIn<2>() << 0.01, 0.003, -0.002, -0.004).finished();
  for (const bool triangles : {false, true}) {
    expect_linear_field<2>(refined<2>(grid({8, 8, 8., 8., Point2::Zero(), 0.2, triangles}), {3., 4.}, 1.), any);
  }
}

TEST(HangingNodes, LinearFieldIsReproducedToRoundingInThreeDimensions) {
  const GradientIn<3> any =
      (GradientIn<3>() << 0.01, 0.003, 0.001, -0.002, -0.004, 0.002, 0.001, 0.003, 0.005).finished();
  for (const auto type : {mesh::ElementType::hex8, mesh::ElementType::tet4}) {
    expect_linear_field<3>(refined<3>(brick({4, 4, 4, 0., type}), {1., 2., 1.5}, 0.5, 1), any);
  }
}

/// A zone in the fine part of a patch, 24 finest squares wide: the errors are those of the patch that is fine
/// everywhere (HybridPatch).
TEST(HangingNodes, DoNotDisturbAZone) {
  const GradientIn<2> uniaxial = (GradientIn<2>() << 0.01, 0., 0., 0.).finished();
  const auto errors_on = [&](const mesh::Mesh<2>& whole) {
    Specimen specimen = patch<2>(whole, 3., 0.2, uniaxial);
    specimen.seeds = {Zone<2>::ball({24., 24.}, 5., 9.)};
    return solve<2>(specimen, uniaxial);
  };
  const Errors fine = errors_on(grid({48, 48, 48., 48.}));

  const Errors actual = errors_on(refined<2>(grid({12, 12, 48., 48.}), {24., 24.}, 14.));

  EXPECT_GT(fine.displacement, 1e-4);
  EXPECT_LT(actual.displacement, 1.05 * fine.displacement);
  EXPECT_NEAR(actual.strain, fine.strain, 0.05 * fine.strain);
}

}  // namespace
}  // namespace perimorph::tests
