// Ghost forces: what is left of the forces in a body under uniform strain, where they should vanish, because the models
// change over the rim of a peridynamic zone. With PERIMORPH_TABLE=FILE in the environment the table is written there.

#include <gtest/gtest.h>

#include <fstream>

#include "perimorph/base/errors.hpp"
#include "support/coupled_body.hpp"

namespace perimorph::tests {
namespace {

using operators::PeridynamicStiffness;

constexpr double horizon = 3., strain = 1e-3;
constexpr int size = 48;  // elements along each side, of size 1

/// The largest force on a node inside, over E * strain * the element's size.
double ghost_force(double rim, PeridynamicStiffness stiffness) {
  const Point2 center(0.5 * size, 0.5 * size);
  constexpr double middle = 11.;  // of the rim, so that zones are as large
  const CoupledBody body(Setup{{size, size, size, size},
                               horizon,
                               0.2,
                               {morphing::Zone<2>::ball(center, middle - 0.5 * rim, middle + 0.5 * rim)},
                               stiffness});
  const auto& matrix = *body.stiffness->matrix();
  Tpetra::Vector<double> u(matrix.getDomainMap()), force(matrix.getRangeMap());
  for (int n = 0; n < body.dofs->n_owned_nodes(); ++n) {
    u.replaceLocalValue(2 * n, strain * body.mesh.coordinates[body.dofs->reference_node(n)][0]);
  }
  matrix.apply(u, force);
  const auto values = force.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto& boundary = body.mesh.node_sets.at("boundary");
  double largest = 0.;
  for (int n = 0; n < body.dofs->n_owned_nodes(); ++n) {
    if (std::binary_search(boundary.begin(), boundary.end(), body.dofs->reference_node(n))) continue;
    largest = std::max(largest, Point2(values(2 * n, 0), values(2 * n + 1, 0)).norm());
  }
  return largest / (CoupledBody::youngs_modulus * strain);
}

TEST(GhostForces, GrowWithTheHorizonOverTheWidthOfTheRim) {
  const std::vector<double> ratios = {0.2, 0.25, 1. / 3., 0.5, 0.75, 1., 1.5, 2., 3., 6.};
  std::vector<double> dropped, kept;
  for (const double ratio : ratios) {
    dropped.push_back(ghost_force(horizon / ratio, PeridynamicStiffness::dropped));
    kept.push_back(ghost_force(horizon / ratio, PeridynamicStiffness::kept));
  }
  if (const char* file = getenv("PERIMORPH_TABLE")) {
    std::ofstream table(file);
    table << "horizon_over_rim,dropped,kept\n";
    for (std::size_t i = 0; i < ratios.size(); ++i) {
      table << fmt::format("{:.4g},{:.4g},{:.4g}\n", ratios[i], dropped[i], kept[i]);
    }
    ASSERT_TRUE(table) << file;
  }
  // In proportion to the slope of alpha, as long as the rim is wider than the horizon; dropping E(x) has a force of its
  // own at the zone's border, which a wide rim cannot lower.
  for (std::size_t i = 1; i < ratios.size(); ++i) {
    if (ratios[i] <= 1.) {
      EXPECT_GT(kept[i], kept[i - 1]) << ratios[i];
    } else {
      EXPECT_GT(kept[i], kept[i - 1] * 0.9) << ratios[i];
    }
    EXPECT_GE(dropped[i], kept[i]) << ratios[i];
  }
  EXPECT_LT(kept.front(), 0.005);
  EXPECT_GT(kept.back(), 10. * kept.front());
  EXPECT_GT(dropped[1], 0.01);
}

}  // namespace
}  // namespace perimorph::tests
