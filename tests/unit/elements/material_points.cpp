#include "perimorph/elements/material_points.hpp"

#include <gtest/gtest.h>

#include <set>

#include "perimorph/base/errors.hpp"
#include "perimorph/elements/strain.hpp"
#include "support/meshes.hpp"

namespace perimorph::tests {
namespace {

/// Irregular quadrilaterals or triangles, 6 x 5, of area 3 x 2.
class MaterialPoints : public testing::TestWithParam<bool> {
 protected:
  mesh::Mesh<2> mesh = grid({6, 5, 3., 2., Point2(1., -1.), 0.25, GetParam()});
  elements::MaterialPoints<2> points{mesh};
};

TEST_P(MaterialPoints, WeightsSumToTheArea) {
  double area = 0.;
  Point2 moment = Point2::Zero();
  for (int p = 0; p < points.size(); ++p) {
    EXPECT_GT(points.weight(p), 0.);
    area += points.weight(p);
    moment += points.weight(p) * points.position(p);
  }
  EXPECT_NEAR(area, 6., 1e-13);
  EXPECT_LT((moment / area - Point2(2.5, 0.)).norm(), 1e-13);  // the middle of the rectangle
}

TEST_P(MaterialPoints, InterpolateALinearFieldAndItsGradientExactly) {
  const Point2 slope(0.7, -1.3);
  const auto field = [&](const Point2& x) { return 2. + slope.dot(x); };
  for (int e = 0; e < mesh.n_elements(); ++e) {
    for (int q = 0; q < points.count(e); ++q) {
      double value = 0.;
      Point2 gradient = Point2::Zero();
      const auto g = points.gradients(e, q);
      for (int k = 0; k < mesh.n_corners(e); ++k) {
        const double at_corner = field(mesh.coordinates[mesh.corners_of(e)[k]]);
        value += points.shape(e, q)(k) * at_corner;
        gradient += g.col(k) * at_corner;
      }
      EXPECT_NEAR(value, field(points.position(points.first(e) + q)), 1e-13);
      EXPECT_LT((gradient - slope).norm(), 1e-12);  // a few roundings over the element's size, 0.4
    }
  }
}

TEST_P(MaterialPoints, TheStrainMatrixGivesTheStrainOfALinearDisplacement) {
  Eigen::Matrix2d h;
  h << 0.01, 0.02, -0.03, 0.04;
  for (int e = 0; e < mesh.n_elements(); ++e) {
    elements::with_corners<2>(mesh.n_corners(e), [&](auto n) {
      Eigen::Matrix<double, 2 * n, 1> u;
      for (int k = 0; k < n; ++k) u.template segment<2>(2 * k) = h * mesh.coordinates[mesh.corners_of(e)[k]];
      const Eigen::Vector3d strain = elements::strain_matrix<2, n>(points.gradients(e, 0)) * u;
      EXPECT_LT((strain - Eigen::Vector3d(0.01, 0.04, -0.01)).norm(), 1e-13);  // engineering shear: 0.02 - 0.03
    });
  }
}

TEST_P(MaterialPoints, GlobalIdsAreUniqueAndFollowTheElementsIds) {
  std::set<base::GlobalId> ids;
  for (int e = 0; e < mesh.n_elements(); ++e) {
    for (int q = 0; q < points.count(e); ++q) ids.insert(points.global_id(e, q));
  }
  EXPECT_EQ(static_cast<int>(ids.size()), points.size());
  mesh.element_ids[3] = 1000;
  EXPECT_EQ(points.global_id(3, 1) - points.global_id(3, 0), 1);
  EXPECT_GE(points.global_id(3, 0), *ids.rbegin());
}

INSTANTIATE_TEST_SUITE_P(Types, MaterialPoints, testing::Bool(),
                         [](const auto& p) { return p.param ? "Triangles" : "Quadrilaterals"; });

TEST(MaterialPointsOfAnInvertedElement, AreABug) {
  mesh::Mesh<2> mesh = grid({2, 2});
  std::swap(mesh.corners[0], mesh.corners[2]);
  std::swap(mesh.corners[0], mesh.corners[1]);
  EXPECT_THROW(elements::MaterialPoints<2>{mesh}, base::Bug);
}

TEST(Squared, TimesStrainIsTheChangeOfLengthAlongABond) {
  const base::Point<3> xi(0.3, -0.7, 1.1);
  Eigen::Matrix3d strain;
  strain << 1., 4., 5., 4., 2., 6., 5., 6., 3.;
  base::Voigt<3> voigt;
  voigt << 1., 2., 3., 12., 10., 8.;  // xx, yy, zz, then engineering yz, xz, xy
  EXPECT_NEAR(elements::squared<3>(xi).dot(voigt), xi.dot(strain * xi), 1e-13);

  const Point2 xi2(0.3, -0.7);
  EXPECT_NEAR(elements::squared<2>(xi2).dot(base::Voigt<2>(1., 2., 8.)), xi2.dot(strain.topLeftCorner<2, 2>() * xi2),
              1e-14);
}

}  // namespace
}  // namespace perimorph::tests
