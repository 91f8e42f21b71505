// A cracked slab in three dimensions that cannot strain across its thickness is the plate in plane strain.

#include <gtest/gtest.h>

#include "support/fracture_body.hpp"

namespace perimorph::tests {
namespace {

constexpr double horizon = 2., characteristic_length = 0.25;
constexpr int width = 12, height = 12, depth = 3, crack_length = 5;

/// Pulled at the top, with a crack along elements from the left edge at mid-height.
template <int dim>
SpecimenIn<dim> cracked(mesh::Mesh<dim> whole, const std::vector<mesh::CrackFacet<dim>>& crack,
                        materials::ElasticModel model, const Zone<dim>& seed) {
  EXPECT_GT(mesh::open_along<dim>(whole, crack), 0);
  SpecimenIn<dim> specimen{std::move(whole), horizon, characteristic_length};
  specimen.pre_cracks = crack;
  specimen.elastic_model = model;
  specimen.seeds = {seed};
  specimen.peridynamic_stiffness = PeridynamicStiffness::kept;  // bonds are missing at the faces of the slab
  specimen.critical_stretch = 0.01;
  specimen.displacements = {
      {"hold y", "bottom", 1, {0., 0.}}, {"hold x", "right", 0, {0., 0.}}, {"pull", "top", 1, {1., 0.}}};
  specimen.tolerance = 1e-7;
  return specimen;
}

SpecimenIn<2> plate() {
  const double middle = height / 2., tip = crack_length;
  return cracked<2>(grid({width, height, width, height}), mesh::polyline({{0., middle}, {tip, middle}}),
                    materials::ElasticModel::plane_strain, Zone<2>::ball({tip, middle}, 3.2, 5.5));
}

SpecimenIn<3> slab() {
  const double middle = height / 2., tip = crack_length, t = depth;
  auto specimen = cracked<3>(brick({width, height, depth}),
                             mesh::polygon({{0., middle, 0.}, {tip, middle, 0.}, {tip, middle, t}, {0., middle, t}}),
                             materials::ElasticModel::three_dimensional,
                             Zone<3>::cylinder({tip, middle, -10.}, {tip, middle, t + 10.}, 3.2, 5.5));
  specimen.displacements.push_back({"plane strain", "all", 2, {0., 0.}});
  return specimen;
}

struct Outcome {
  double stiffness;   ///< force on the top over its displacement, per thickness
  double break_load;  ///< displacement of the top at the first broken bond
};

template <int dim>
Outcome pull(const SpecimenIn<dim>& specimen, double thickness) {
  constexpr double start = 0.02, factor = 1.02;
  SpecimenBodyIn<dim> test(specimen);
  test.advance(start);
  EXPECT_EQ(test.body.counts().broken_bonds, 0);
  double force = 0.;
  for (int n = 0; n < test.body.model().dofs.n_owned_nodes(); ++n) {
    const auto& top = test.mesh.node_sets.at("top");
    if (std::binary_search(top.begin(), top.end(), test.body.model().dofs.reference_node(n))) {
      force += test.body.reaction(n)[1];
    }
  }
  double load = start;
  while (test.body.counts().broken_bonds == 0 && load < 100. * start) {
    load *= factor;
    test.body.apply_load(load);
    test.body.solve(fracture::Accuracy::accepted);
    test.body.break_bonds();
  }
  return {force / start / thickness, load};
}

/// With the same critical stretch. For the same fracture energy it is smaller in three dimensions, by the root of
/// (8/3 I6/I5) / (5/4 pi I7/I6), since bonds across a crack are longer on average.
TEST(Slab, InPlaneStrainIsAsStiffAsThePlateAndStretchesBondsAtTheTipAlike) {
  const Outcome in_2d = pull(plate(), 1.), in_3d = pull(slab(), depth);

  EXPECT_NEAR(in_3d.stiffness / in_2d.stiffness, 1., 0.004);    // 1.002
  EXPECT_NEAR(in_3d.break_load / in_2d.break_load, 1., 0.021);  // in the same step of 2 %
}

}  // namespace
}  // namespace perimorph::tests
