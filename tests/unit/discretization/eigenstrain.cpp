// What changes of temperature make of material points.

#include "perimorph/discretization/eigenstrain.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "perimorph/base/errors.hpp"
#include "support/meshes.hpp"

namespace perimorph::tests {
namespace {

using discretization::Amplitude;
using discretization::Eigenstrain;
using discretization::PiecewiseLinear;
using discretization::Profile;
using discretization::TemperatureChange;

/// Two blocks beside each other, of which the right one expands twice as much.
class EigenstrainOfTwoBlocks : public testing::Test {
 protected:
  mesh::Mesh<2> mesh = [] {
    auto two = grid({4, 2, 4., 2.});
    two.block_names.emplace_back("right");
    for (int e = 0; e < two.n_elements(); ++e) two.blocks[e] = is_right(mesh::centroid(two, e)) ? 1 : 0;
    return two;
  }();
  elements::MaterialPoints<2> points{mesh};
  std::vector<double> expansion = [this] {
    std::vector<double> of_elements;
    for (const int block : mesh.blocks) of_elements.push_back(1e-5 * (1 + block));
    return of_elements;
  }();

  static bool is_right(const Point2& x) { return x[0] > 2.; }
};

TEST_F(EigenstrainOfTwoBlocks, IsTheSumOfAllChangesInABlockAlongTheirProfiles) {
  const Profile<2> upward{Point2(0., 1.), PiecewiseLinear({{0.5, 0.}, {1.5, 1.}})};
  const TemperatureChange<2> everywhere{{3., 1.}}, on_the_right{{-10., 0.}, {"right"}, upward};
  Eigenstrain<2> eigenstrain(mesh, points, {everywhere, on_the_right}, expansion);
  EXPECT_EQ(eigenstrain.at_points(), std::vector<double>(points.size(), 0.));

  eigenstrain.apply_load(2.);

  for (int p = 0; p < points.size(); ++p) {
    const Point2& x = points.position(p);
    const double share = std::clamp(x[1] - 0.5, 0., 1.);
    const double exact = is_right(x) ? 2e-5 * (7. - 20. * share) : 7e-5;
    EXPECT_NEAR(eigenstrain.at_points()[p], exact, 1e-18);
    EXPECT_NEAR(eigenstrain.rates(1.)[p], is_right(x) ? 2e-5 * (3. - 10. * share) : 3e-5, 1e-18);
  }
}

TEST_F(EigenstrainOfTwoBlocks, FollowsItsAmplitudeAndEndsWithIt) {
  const Amplitude amplitude({{0., 0.}, {2., 6.}, {4., 0.}});
  const TemperatureChange<2> change{{10., 0., &amplitude, 3.}, {"right"}};
  Eigenstrain<2> eigenstrain(mesh, points, {change}, expansion);
  const int last = points.size() - 1;
  eigenstrain.apply_load(3.);
  EXPECT_NEAR(eigenstrain.at_points()[last], 2e-5 * 30., 1e-16);
  EXPECT_NEAR(eigenstrain.rates(1.)[last], 2e-5 * -30., 1e-16);
  EXPECT_EQ(eigenstrain.at_points()[0], 0.);
  eigenstrain.apply_load(4.);
  EXPECT_EQ(eigenstrain.at_points()[last], 0.);
}

TEST_F(EigenstrainOfTwoBlocks, WithoutAChangeThereIsNone) {
  const std::vector<TemperatureChange<2>> changes;
  const Eigenstrain<2> none(mesh, points, changes, expansion);
  EXPECT_FALSE(none.exists());
  EXPECT_TRUE(none.at_points().empty());
  EXPECT_TRUE(none.rates(1.).empty());
  expansion.pop_back();
  EXPECT_THROW(Eigenstrain<2>(mesh, points, changes, expansion), base::Bug);
}

}  // namespace
}  // namespace perimorph::tests
