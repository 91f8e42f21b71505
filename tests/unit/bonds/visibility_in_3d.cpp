// Bonds across planar cracks in three dimensions, and the surface that they leave when they break.

#include <gtest/gtest.h>

#include <Teuchos_DefaultComm.hpp>
#include <Tpetra_Core.hpp>
#include <map>

#include "perimorph/bonds/crack.hpp"
#include "perimorph/mesh/distribute.hpp"
#include "support/meshes.hpp"

namespace perimorph::tests {
namespace {

constexpr double horizon = 1.5, characteristic_length = 0.3;  // spacing 1
using Cracks = std::vector<mesh::CrackFacet<3>>;
using mesh::ElementType;

/// A body with all its bonds.
struct Bonded {
  mesh::Mesh<3> mesh;
  elements::MaterialPoints<3> points{mesh};
  morphing::MorphingField<3> alpha{mesh, points, morphing::BlendingFunction::linear};
  bonds::BondFamilies<3> bonds;

  Bonded(const mesh::Mesh<3>& whole, const Cracks& pre_cracks)
      : mesh(mesh::distribute(*Tpetra::getDefaultComm(), whole, horizon)),
        bonds(mesh, points, mesh::active_elements(mesh),
              materials::calibrate<3>(materials::ElasticModel::three_dimensional, 1000., 0.25, characteristic_length,
                                      horizon),
              pre_cracks) {
    bonds.extend(alpha.add({morphing::Zone<3>::everything()}));
  }

  template <class Action>
  void for_each_bond(Action action) const {
    for (int p = 0; p < bonds.n_pairs(); ++p) {
      const auto [first, second] = bonds.pair(p);
      if (first == second) continue;
      for (auto b = bonds.first_bond(p); b < bonds.first_bond(p + 1); ++b) {
        action(points.position(points.first(first) + bonds.first_end(b)),
               points.position(points.first(second) + bonds.second_end(b)), p, b);
      }
    }
  }
};

/// Where the segment passes the plane y = height; nothing if it does not.
std::optional<Point3> passage(const Point3& a, const Point3& b, double height) {
  if ((a[1] - height) * (b[1] - height) >= 0.) return {};
  return a + (height - a[1]) / (b[1] - a[1]) * (b - a);
}

struct Census {
  int through = 0, around = 0;  ///< bonds that pass the crack's plane inside the crack, and outside of it
};

template <class IsInside>
Census census(const Bonded& body, double height, IsInside is_inside) {
  Census counts;
  body.for_each_bond([&](const Point3& a, const Point3& b, int, std::size_t) {
    const auto place = passage(a, b, height);
    if (place) ++(is_inside(*place) ? counts.through : counts.around);
  });
  return counts;
}

/// Sides of elements on so many squares: every second one is cut between pyramids, each between tetrahedra.
int n_sides(int n_squares, ElementType type) {
  if (type == ElementType::pyramid5) return n_squares * 3 / 2;
  return type == ElementType::tet4 ? 2 * n_squares : n_squares;
}

class VisibilityIn3d : public testing::TestWithParam<ElementType> {};

TEST_P(VisibilityIn3d, NoBondPassesAPolygonAndAllAroundItExist) {
  const auto is_inside = [](const Point3& x) { return x[0] + 0.5 * x[2] < 5.03; };
  const mesh::Mesh<3> whole = brick({5, 6, 4, 0., GetParam()});
  const Cracks crack = mesh::polygon({{0., 3., 0.}, {5.03, 3., 0.}, {3.03, 3., 4.}, {0., 3., 4.}});

  const Census intact = census(Bonded(whole, {}), 3., is_inside), cracked = census(Bonded(whole, crack), 3., is_inside);

  ASSERT_GT(intact.through, 200);
  ASSERT_GT(intact.around, 100);
  EXPECT_EQ(cracked.through, 0);
  EXPECT_EQ(cracked.around, intact.around);
}

TEST_P(VisibilityIn3d, ACrackAlongFacesOpensTheMeshAndItsFacesCutTheSameBonds) {
  mesh::Mesh<3> whole = brick({5, 6, 4, 0., GetParam()});
  const Cracks crack = mesh::polygon({{0., 3., 0.}, {3., 3., 0.}, {3., 3., 4.}, {0., 3., 4.}});
  ASSERT_EQ(mesh::open_along<3>(whole, crack), n_sides(12, GetParam()));
  const auto is_inside = [](const Point3& x) { return x[0] < 3. + 1e-9; };

  const Census by_faces = census(Bonded(whole, {}), 3., is_inside),
               by_both = census(Bonded(whole, crack), 3., is_inside);

  EXPECT_EQ(by_faces.through, 0);
  EXPECT_EQ(by_both.through, 0);
  EXPECT_EQ(by_faces.around, by_both.around);
  EXPECT_GT(by_faces.around, 100);
}

TEST_P(VisibilityIn3d, NoBondPassesADisc) {
  const auto is_inside = [](const Point3& x) { return (x - Point3(3., 3., 3.)).norm() < 1.5; };
  const mesh::Mesh<3> whole = brick({6, 6, 6, 0., GetParam()});

  const Census intact = census(Bonded(whole, {}), 3., is_inside);
  const Census cracked = census(Bonded(whole, mesh::disc({3., 3., 3.}, {0., 7., 0.}, 1.5)), 3., is_inside);

  ASSERT_GT(intact.through, 100);
  EXPECT_EQ(cracked.through, 0);
  EXPECT_NEAR(cracked.around, intact.around, 0.01 * intact.around);  // 0.2 % of the radius
}

TEST_P(VisibilityIn3d, NoBondLeavesTheBody) {
  // A block with a groove narrower than a horizon: no bond passes through the void.
  const auto in_groove = [](const Point3& x) { return x[0] < 3. && std::abs(x[1] - 2.5) < 0.5; };
  const Bonded body(without(brick({5, 5, 3, 0., GetParam()}), in_groove), {});

  int inside = 0, across = 0;
  body.for_each_bond([&](const Point3& a, const Point3& b, int, std::size_t) {
    for (int s = 1; s < 40; ++s) inside += in_groove(a + s / 40. * (b - a));
    across += passage(a, b, 2.5).has_value();
  });

  EXPECT_EQ(inside, 0);
  EXPECT_GT(across, 100);  // beside the groove
}

/// Pulls apart at y = 3 what lies at z < 2: its upper half moves by a horizon.
TEST_P(VisibilityIn3d, TheBrokenSurfaceIsBothFacesOfACrack) {
  Bonded body(brick({4, 6, 4, 0., GetParam()}), {});
  for (int p = 0; p < body.bonds.n_pairs(); ++p) {
    const auto [first, second] = body.bonds.pair(p);
    if (first == second) continue;
    for (auto b = body.bonds.first_bond(p); b < body.bonds.first_bond(p + 1); ++b) {
      const auto place = passage(body.points.position(body.points.first(first) + body.bonds.first_end(b)),
                                 body.points.position(body.points.first(second) + body.bonds.second_end(b)), 3.);
      if (place && (*place)[2] < 2.) body.bonds.take({{b}});
    }
  }

  const auto surface = bonds::broken_surface(body.mesh, body.bonds);

  EXPECT_EQ(static_cast<int>(surface.size()), 2 * n_sides(8, GetParam()));
  for (const auto& side : surface) {
    for (const auto& x : mesh::corner_points(body.mesh, side)) {
      EXPECT_EQ(x[1], 3.);
      EXPECT_LE(x[2], 2.);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Elements, VisibilityIn3d,
                         testing::Values(ElementType::hex8, ElementType::tet4, ElementType::wedge6,
                                         ElementType::pyramid5),
                         [](const auto& type) { return mesh::exodus_name(type.param); });

}  // namespace
}  // namespace perimorph::tests
