// A ring under inner pressure, against Lame's solution.

#include <gtest/gtest.h>

#include "support/fracture_body.hpp"

namespace perimorph::tests {
namespace {

constexpr double inner = 1., outer = 3.;

/// A quarter of it, of as many elements along the radius, twice as many around. Side set "hole".
mesh::Mesh<2> quarter(int n) {
  mesh::Mesh<2> mesh = grid({n, 2 * n});
  for (auto& x : mesh.coordinates) {
    const double radius = inner + (outer - inner) * x[0], angle = 0.5 * M_PI * x[1];
    x = radius * Point2(std::cos(angle), std::sin(angle));
  }
  for (const auto& side : mesh.boundary) {
    const auto corners = mesh::corner_points(mesh, side);
    const auto is_inner = [](const Point2& x) { return x.norm() < inner * (1. + 1e-9); };
    if (std::all_of(corners.begin(), corners.end(), is_inner)) mesh.side_sets["hole"].push_back(side);
  }
  return mesh;
}

/// In plane stress the hole widens by p a / E ((b² + a²) / (b² - a²) + nu).
double widening_error(int n) {
  Specimen specimen{quarter(n), 0.3, 0.1};
  specimen.displacements = {{"symmetry y", "bottom", 1, {0., 0.}}, {"symmetry x", "top", 0, {0., 0.}}};
  specimen.pressures = {{"hole", {2., 0.}}};
  SpecimenBody test(specimen);
  test.advance(3.);
  double widening = 0.;
  const auto& dofs = test.body.topology().dofs();
  for (int node = 0; node < dofs.n_owned_nodes(); ++node) {
    const Point2& x = test.mesh.coordinates[dofs.reference_node(node)];
    if (x.norm() > inner * (1. + 1e-9)) continue;
    widening = std::max(widening, base::at_node<2>(test.body.displacement(), node).dot(x.normalized()));
  }
  widening = base::max(*Tpetra::getDefaultComm(), widening);
  const double a = inner * inner, b = outer * outer;
  return widening / (6. * inner / specimen.youngs_modulus * ((b + a) / (b - a) + 1. / 3.)) - 1.;
}

TEST(Ring, WidensUnderItsPressureAsLameSays) {
  const double coarse = widening_error(10), fine = widening_error(20);
  EXPECT_NEAR(coarse, 0., 0.02);
  EXPECT_NEAR(fine, 0., 0.005);
}

}  // namespace
}  // namespace perimorph::tests
