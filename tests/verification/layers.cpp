// Bodies of two materials: exact solutions of two layers, and cracks that meet an interface.

#include <gtest/gtest.h>

#include "patch.hpp"

namespace perimorph::tests {
namespace {

constexpr auto plane_stress = materials::ElasticModel::plane_stress;

/// Makes the elements on one side of a line a block of its own, "other".
template <int dim, class IsOther>
void set_apart(mesh::Mesh<dim>& whole, IsOther is_other) {
  whole.block_names.push_back("other");
  for (int e = 0; e < whole.n_elements(); ++e) whole.blocks[e] = is_other(mesh::centroid(whole, e)) ? 1 : 0;
}

/// 40 x 40 squares, l = dx/3, a horizon of 4 dx, stiffer for y > 0 by a factor; a zone across the interface.
Specimen layers(double factor) {
  Specimen specimen{grid({40, 40, 40., 40., {-20., -20.}}), 4., 1. / 3.};
  set_apart(specimen.whole, [](const Point2& x) { return x[1] > 0.; });
  specimen.others = {materials::elastic_material<2>(plane_stress, 1000. * factor, 1. / 3., 1. / 3., 4.)};
  specimen.material_of_block = {{"other", 1}};
  specimen.peridynamic_stiffness = PeridynamicStiffness::kept;
  specimen.seeds = {Zone<2>::ball({0., 0.}, 9., 17.)};
  specimen.tolerance = 1e-8;
  return specimen;
}

struct Layered {
  const char* name;
  Point2 (*displacement)(const Point2& x, double share);  ///< share: 1 below, one over the factor above
  double largest_error;                                   ///< of the largest displacement
};

class Layers : public testing::TestWithParam<Layered> {};

/// Stiffness ten times another's: bonds across the interface are the harmonic mean, E(x) is clipped.
TEST_P(Layers, AreAsTheExactSolutionSays) {
  constexpr double factor = 10.;
  const auto exact = [](const Point2& x) { return GetParam().displacement(x, x[1] > 0. ? 1. / factor : 1.); };
  Specimen specimen = layers(factor);
  for (const int n : std::vector<int>(specimen.whole.node_sets.at("boundary"))) {
    const std::string name = "boundary " + std::to_string(n);
    specimen.whole.node_sets[name] = {n};
    const Point2 u = exact(specimen.whole.coordinates[n]);
    for (int c = 0; c < 2; ++c) specimen.displacements.push_back({name, name, c, {u[c], 0.}});
  }
  SpecimenBody test(specimen);
  test.body.apply_load(1.);
  test.body.update_topology();
  test.body.solve(fracture::Accuracy::accepted);

  double error = 0., largest = 0.;
  const auto model = test.body.model();
  for (int n = 0; n < model.dofs.n_nodes(); ++n) {
    const Point2 u = exact(model.mesh.coordinates[model.dofs.reference_node(n)]);
    largest = std::max(largest, u.norm());
    error = std::max(error, (base::at_node<2>(test.body.displacement(), n) - u).norm());
  }
  EXPECT_LT(error, GetParam().largest_error * largest);
  EXPECT_GT(error, 1e-4 * largest);  // the zone is there
}

INSTANTIATE_TEST_SUITE_P(
    Loads, Layers,
    testing::Values(Layered{"Parallel", [](const Point2& x, double) { return Point2(x[0], -x[1] / 3.); }, 0.006},
                    Layered{"Series", [](const Point2& x, double share) { return Point2(0., share * x[1]); }, 0.013},
                    Layered{"Shear", [](const Point2& x, double share) { return Point2(share * x[1], 0.); }, 0.007}),
    [](const auto& p) { return p.param.name; });

/// A crack from the left edge runs towards an interface across its way, x = 20, between two materials that differ in
/// nothing else. Returns how far it has run along the interface and beyond it.
struct Way {
  double along = 0., beyond = 0.;
};

Way way_of_a_crack(double toughness_of_interface) {
  constexpr double horizon = 3., length = 1. / 3., energy = 0.1;
  Specimen specimen{grid({36, 40, 36., 40., {0., -20.}}), horizon, length};
  set_apart(specimen.whole, [](const Point2& x) { return x[0] > 20.; });
  specimen.pre_cracks = {{Point2(0., 0.), Point2(14., 0.)}};
  mesh::open_along<2>(specimen.whole, specimen.pre_cracks);
  auto material = materials::elastic_material<2>(plane_stress, 1000., 1. / 3., length, horizon);
  const double stretch = materials::critical_stretch<2>(material.micromodulus, energy);
  material.toughness = {stretch, energy};
  specimen.others = {material};
  specimen.material_of_block = {{"other", 1}};
  specimen.critical_stretch = stretch;
  specimen.interface = {std::sqrt(toughness_of_interface) * stretch, toughness_of_interface * energy};
  specimen.seeds = {Zone<2>::box({8., -14.}, {30., 14.}, 4.)};
  specimen.displacements = {
      {"hold", "bottom", 1, {0., 0.}}, {"side", "right", 0, {0., 0.}}, {"pull", "top", 1, {1., 0.}}};
  specimen.tolerance = 1e-6;
  SpecimenBody test(specimen);
  Way way;
  for (double load = 0.02; way.along < 4. && way.beyond < 4. && load < 2.; load *= 1.02) {
    test.advance(load);
    const auto model = test.body.model();
    model.bonds.for_each_bond([&](const bonds::Bond<2>& bond) {
      if (!bond.is_broken) return;
      const Point2 middle = model.points.position(bond.first_point) + 0.5 * bond.xi;
      const bool crosses =
          (model.points.position(bond.first_point)[0] < 20.) != (model.points.position(bond.second_point)[0] < 20.);
      if (crosses) way.along = std::max(way.along, std::abs(middle[1]));
      if (std::abs(middle[1]) < 0.5) way.beyond = std::max(way.beyond, middle[0] - 20.);
    });
  }
  return way;
}

/// He and Hutchinson 1989: across the way of a crack, between like solids, an interface deflects it if its fracture
/// energy is below a quarter of the solids'.
TEST(Interface, ThatIsWeakDeflectsACrackAndOneThatIsToughLetsItPass) {
  const Way weak = way_of_a_crack(0.1), perfect = way_of_a_crack(1.), tough = way_of_a_crack(2.);
  EXPECT_GT(weak.along, 4.);
  EXPECT_LT(weak.beyond, 2.);
  EXPECT_GT(perfect.beyond, 4.);
  EXPECT_LT(perfect.along, 2.);
  EXPECT_LT(tough.along, 2.);
}

}  // namespace
}  // namespace perimorph::tests
