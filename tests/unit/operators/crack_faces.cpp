// Crack faces and how far they overlap, with displacements that are given.

#include "perimorph/operators/crack_faces.hpp"

#include <gtest/gtest.h>

#include "support/coupled_body.hpp"

namespace perimorph::tests {
namespace {

/// 6 x 4 squares with a slit on edges at x = 3 below y = 2; all peridynamic, and discontinuous or not.
CoupledBody plate(bool discontinuous) {
  const std::vector<mesh::CrackFacet<2>> slit = {{Point2(3., 0.), Point2(3., 2.)}};
  mesh::Mesh<2> whole = grid({6, 4, 6., 4.});
  mesh::open_along<2>(whole, slit);
  return {Setup{{}, 1.5, 0.2, {morphing::Zone<2>::everything()}, {}, discontinuous, {}, slit}, whole};
}

operators::Overlap<2> largest(const CoupledBody& body, const std::vector<double>& u) {
  const auto facing = operators::facing_sides(body.mesh, body.discontinuous);
  return operators::largest_overlap(*body.comm, body.model(), facing, base::field(u));
}

/// The displacement of every node, by an element that has it.
template <class Field>
std::vector<double> displaced(const CoupledBody& body, Field field) {
  std::vector<double> u(static_cast<std::size_t>(body.dofs->n_nodes()) * 2, 0.);
  for (int e = 0; e < body.mesh.n_elements(); ++e) {
    for (int k = 0; k < body.mesh.n_corners(e); ++k) {
      const Point2 value = field(mesh::centroid(body.mesh, e), body.mesh.coordinates[body.mesh.corners_of(e)[k]]);
      std::copy(value.begin(), value.end(), u.begin() + body.dofs->nodes_of(e)[k] * 2);
    }
  }
  return u;
}

TEST(CrackFaces, OfASlitOverlapByTheJumpAlongTheNormal) {
  for (const bool discontinuous : {false, true}) {
    const CoupledBody body = plate(discontinuous);
    const auto closed = displaced(body, [](const Point2& center, const Point2& x) -> Point2 {
      const double depth = x[1] < 2. ? 0.1 * (2. - x[1]) : 0.;  // most at the mouth
      return center[0] < 3. ? Point2(0.25 * depth, 7. * depth) : Point2(-0.75 * depth, 0.);
    });

    const auto overlap = largest(body, closed);

    EXPECT_NEAR(overlap.depth, 0.2, 1e-15);
    EXPECT_EQ(overlap.place, Point2(3., 0.));
  }
}

TEST(CrackFaces, ThatOpenOrSlideDoNotOverlap) {
  const CoupledBody body = plate(true);
  const auto open = displaced(body, [](const Point2& center, const Point2& x) -> Point2 {
    return center[0] > 3. && x[1] < 2. ? Point2(0.1, 0.3) : Point2::Zero();
  });
  EXPECT_EQ(largest(body, open).depth, 0.);
}

TEST(CrackFaces, AreThereOnceAllBondsBetweenTwoElementsAreBroken) {
  CoupledBody body = plate(true);
  const auto closed = displaced(body, [](const Point2& center, const Point2&) -> Point2 {
    return center[0] < 5. ? Point2(0.1, 0.) : Point2::Zero();  // the last column is run into
  });
  EXPECT_EQ(largest(body, closed).depth, 0.);

  for (int p = 0; p < body.bonds.n_pairs(); ++p) {
    const auto [first, second] = body.bonds.pair(p);
    const Point2 a = mesh::centroid(body.mesh, first), b = mesh::centroid(body.mesh, second);
    const bool is_broken = std::abs(a[1] - 3.5) < 0.1 && std::abs(b[1] - 3.5) < 0.1 && (a[0] < 5.) != (b[0] < 5.);
    for (auto bond = body.bonds.first_bond(p); is_broken && bond < body.bonds.first_bond(p + 1); ++bond) {
      body.topology.take({{bond}});
    }
  }
  const auto overlap = largest(body, closed);
  EXPECT_NEAR(overlap.depth, 0.1, 1e-15);
  EXPECT_EQ(overlap.place[0], 5.);
  EXPECT_GE(overlap.place[1], 3.);
}

}  // namespace
}  // namespace perimorph::tests
