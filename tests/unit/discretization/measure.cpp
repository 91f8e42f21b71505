// A measured displacement, on every number of ranks.

#include "perimorph/discretization/measure.hpp"

#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>

#include "perimorph/base/errors.hpp"
#include "support/meshes.hpp"

namespace perimorph::tests {
namespace {

using discretization::MeasuredDisplacement;

/// With elements in the middle that have nodes of their own.
class Measure : public testing::Test {
 protected:
  Teuchos::RCP<const base::Comm> comm = Tpetra::getDefaultComm();
  mesh::Mesh<2> mesh = mesh::distribute(*comm, grid({7, 5, 7., 5.}), 1.5);
  discretization::DofMap<2> dofs{comm, mesh, discretization::corner_exchange(*comm, mesh), parted()};

  std::vector<char> parted() const {
    std::vector<char> flags(mesh.n_elements());
    for (int e = 0; e < mesh.n_elements(); ++e) flags[e] = std::abs(mesh::centroid(mesh, e)[1] - 2.5) < 1.;
    return flags;
  }

  double of(const MeasuredDisplacement<2>& measured) const {
    const auto displacement = [](const Point2& x) { return Point2(1. + 2. * x[0] - x[1], 3. * x[1] + 0.5 * x[0]); };
    std::vector<double> u;
    for (int n = 0; n < dofs.n_nodes(); ++n) {
      const Point2 here = displacement(mesh.coordinates[dofs.reference_node(n)]);
      u.insert(u.end(), here.begin(), here.end());
    }
    return discretization::Measure<2>(*comm, mesh, measured).of(*comm, dofs, base::field(u));
  }
};

TEST_F(Measure, OfAPointIsTheDisplacementThereInTheDirection) {
  EXPECT_NEAR(of({{"", Point2(1.3, 2.7)}, {}, Point2(1., 0.)}), 1. + 2.6 - 2.7, 1e-12);
  EXPECT_NEAR(of({{"", Point2(1.3, 2.7)}, {}, Point2(0.6, 0.8)}), 0.6 * 0.9 + 0.8 * (8.1 + 0.65), 1e-12);
}

TEST_F(Measure, OfAGroupIsTheMeanOverItsNodes) {
  EXPECT_NEAR(of({{"right"}, {}, Point2(1., 0.)}), 1. + 14. - 2.5, 1e-12);
  EXPECT_NEAR(of({{"all"}, {}, Point2(0., 1.)}), 7.5 + 1.75, 1e-12);
}

TEST_F(Measure, AgainstAnotherPlaceIsTheDifference) {
  EXPECT_NEAR(of({{"right"}, {{"left"}}, Point2(1., 0.)}), 14., 1e-12);
  EXPECT_NEAR(of({{"top"}, {{"", Point2(3.5, 0.)}}, Point2(0., -1.)}), -15., 1e-12);
}

/// The mean of two lips, in which each element counts alike.
TEST_F(Measure, WhereElementsHavePartedIsTheMeanOfTheirDisplacements) {
  std::vector<double> u(2 * dofs.n_nodes(), 0.);
  for (int e = 0; e < mesh.n_elements(); ++e) {
    if (mesh::centroid(mesh, e)[1] < 2.5 || !parted()[e]) continue;
    for (int k = 0; k < mesh.n_corners(e); ++k) u[2 * dofs.nodes_of(e)[k] + 1] = 1.;
  }
  mesh.node_sets["seam"] = {};
  for (int n = 0; n < mesh.n_nodes(); ++n) {
    if (mesh.coordinates[n][1] == 3.) mesh.node_sets["seam"].push_back(n);
  }

  const discretization::Measure<2> measure(*comm, mesh, {{"seam"}, {}, Point2(0., 1.)});

  EXPECT_NEAR(measure.of(*comm, dofs, base::field(u)), 0.5, 1e-12);
}

TEST_F(Measure, RefusesPointsOutsideAndGroupsWithoutNodes) {
  mesh.node_sets["none"] = {};
  EXPECT_THROW(of({{"", Point2(8., 1.)}, {}, Point2(1., 0.)}), base::UserError);
  EXPECT_THROW(of({{"none"}, {}, Point2(1., 0.)}), base::UserError);
}

}  // namespace
}  // namespace perimorph::tests
