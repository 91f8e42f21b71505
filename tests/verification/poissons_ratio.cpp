// Bodies of any Poisson's ratio: uniform strain across a morphing zone, and stiffness against a classical body.

#include <gtest/gtest.h>

#include "patch.hpp"

namespace perimorph::tests {
namespace {

using materials::ElasticModel;
using morphing::BlendingFunction;

constexpr auto plane_stress = ElasticModel::plane_stress, plane_strain = ElasticModel::plane_strain;

struct Row {
  ElasticModel model;
  double poissons_ratio;
  BlendingFunction function;
  Errors prototype;  ///< its displacement and strain
};

class PatchOfAnyRatio : public testing::TestWithParam<Row> {};

/// 40 x 40 squares, l = dx/3, a horizon of 4 dx, a rim of nearly three horizons. What the bonds and the dilatation
/// carry differs from E0 by their discrete sums, hardly more than at 1/3; near 0.5 the strains where E(x) ends grow.
TEST_P(PatchOfAnyRatio, LinearFieldIsReproducedAcrossTheMorphingZone) {
  const Row& row = GetParam();
  const auto extension = (GradientIn<2>() << 0.01, 0., 0., 0.).finished();
  const auto shear = (GradientIn<2>() << 0., 0.005, 0.005, 0.).finished();
  for (const auto& gradient : {extension, shear}) {
    Specimen specimen = patch<2>(grid({40, 40, 40., 40., {-20., -20.}}), 4., 1. / 3., gradient);
    specimen.seeds = {Zone<2>::ball({0., 0.}, 6., 17.)};
    specimen.elastic_model = row.model;
    specimen.poissons_ratio = row.poissons_ratio;
    specimen.blending_function = row.function;
    specimen.tolerance = 1e-8;

    const Errors actual = solve<2>(specimen, gradient);

    EXPECT_LT(actual.displacement, 1.1 * row.prototype.displacement);
    EXPECT_LT(actual.strain, 1.1 * row.prototype.strain);
    EXPECT_GT(actual.strain, 1e-4);  // the zone is there
  }
}

INSTANTIATE_TEST_SUITE_P(Rows, PatchOfAnyRatio,
                         testing::Values(Row{plane_stress, 0.1, BlendingFunction::linear, {0.0022, 0.014}},
                                         Row{plane_stress, 0.2, BlendingFunction::linear, {0.0019, 0.014}},
                                         Row{plane_stress, 0.3, BlendingFunction::linear, {0.0016, 0.015}},
                                         Row{plane_stress, 0.4, BlendingFunction::linear, {0.0013, 0.016}},
                                         Row{plane_stress, 0.45, BlendingFunction::linear, {0.0013, 0.017}},
                                         Row{plane_strain, 0.1, BlendingFunction::linear, {0.0021, 0.014}},
                                         Row{plane_strain, 0.2, BlendingFunction::linear, {0.0017, 0.015}},
                                         Row{plane_strain, 0.3, BlendingFunction::linear, {0.0013, 0.016}},
                                         Row{plane_strain, 0.4, BlendingFunction::cubic, {0.0015, 0.010}},
                                         Row{plane_strain, 0.45, BlendingFunction::cubic, {0.0012, 0.019}}));

template <int dim>
struct Loading {
  const char* name;
  base::Point<dim> (*displacement)(
      const base::Point<dim>&);  ///< of the far end, by the place; the near end stands still
};

/// A beam with a zone across it, its ends moved.
template <int dim>
double energy(SpecimenIn<dim> specimen, const Loading<dim>& loading, double length) {
  for (int n = 0; n < specimen.whole.n_nodes(); ++n) {
    const base::Point<dim>& x = specimen.whole.coordinates[n];
    if (x[0] > 1e-6 && x[0] < length - 1e-6) continue;
    const std::string name = "end " + std::to_string(n);
    specimen.whole.node_sets[name] = {n};
    const base::Point<dim> u = x[0] < 1e-6 ? base::Point<dim>(base::Point<dim>::Zero()) : loading.displacement(x);
    for (int c = 0; c < dim; ++c) specimen.displacements.push_back({name, name, c, {u[c], 0.}});
  }
  SpecimenBodyIn<dim> test(specimen);
  test.body.apply_load(1.);
  test.body.update_topology();
  test.body.solve(fracture::Accuracy::accepted);
  return test.body.energies().elastic;
}

/// The zone is softened by missing bonds where E(x) is dropped, and everywhere a little by bending within a horizon.
template <int dim>
void expect_the_classical_stiffness(SpecimenIn<dim> specimen, const Loading<dim>& loading, double length) {
  SpecimenIn<dim> classical = specimen;
  classical.seeds.clear();
  const double expected = energy(classical, loading, length);
  for (const auto policy : {PeridynamicStiffness::kept, PeridynamicStiffness::dropped}) {
    specimen.peridynamic_stiffness = policy;
    const bool is_kept = policy == PeridynamicStiffness::kept;
    const double actual = energy(specimen, loading, length);
    EXPECT_NEAR(actual / expected, 1., is_kept ? 0.005 : 0.02) << loading.name << ", kept: " << is_kept;
  }
}

struct Kind {
  ElasticModel model;
  double poissons_ratio;
};

class Beam : public testing::TestWithParam<Kind> {};

TEST_P(Beam, IsAsStiffAsAClassicalOneInTensionBendingAndShear) {
  const Loading<2> loadings[] = {{"tension", [](const Point2&) { return Point2(0.01, 0.); }},
                                 {"bending", [](const Point2& x) { return Point2(1e-3 * (x[1] - 8.), 0.); }},
                                 {"shear", [](const Point2&) { return Point2(0., 0.01); }}};
  for (const auto& loading : loadings) {
    Specimen specimen{grid({48, 16, 48., 16.}), 4., 1. / 3.};
    specimen.seeds = {Zone<2>::box({16., -20.}, {32., 36.}, 8.)};
    specimen.elastic_model = GetParam().model;
    specimen.poissons_ratio = GetParam().poissons_ratio;
    expect_the_classical_stiffness<2>(specimen, loading, 48.);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Beam,
                         testing::Values(Kind{plane_stress, 0.15}, Kind{plane_stress, 0.4}, Kind{plane_strain, 0.15},
                                         Kind{plane_strain, 0.4}));

TEST(BeamIn3d, IsAsStiffAsAClassicalOneInTensionBendingAndShear) {
  const Loading<3> loadings[] = {{"tension", [](const Point3&) { return Point3(0.01, 0., 0.); }},
                                 {"bending", [](const Point3& x) { return Point3(1e-3 * (x[1] - 7.), 0., 0.); }},
                                 {"shear", [](const Point3&) { return Point3(0., 0.01, 0.); }}};
  for (const double ratio : {0.15, 0.4}) {
    for (const auto& loading : loadings) {
      SpecimenIn<3> specimen{brick({24, 14, 5}), 1.6, 0.2};
      specimen.seeds = {Zone<3>::box({8., -9., -9.}, {16., 23., 15.}, 2.)};
      specimen.poissons_ratio = ratio;
      specimen.tolerance = 1e-7;
      expect_the_classical_stiffness<3>(specimen, loading, 24.);
    }
  }
}

}  // namespace
}  // namespace perimorph::tests
