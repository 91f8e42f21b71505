// Probes measure a field that is known: uniform strain, in a classical body and across a morphing zone.

#include "perimorph/output/probes.hpp"

#include <gtest/gtest.h>

#include "perimorph/cases/geometry.hpp"
#include "support/fracture_body.hpp"

namespace perimorph::tests {
namespace {

/// A plate of 24 x 24, irregular, pulled along x and free to contract: strain 0.001, stress E * 0.001 = 1.
Specimen pulled(std::vector<Zone<2>> seeds) {
  Specimen specimen{grid({24, 24, 24., 24., Point2::Zero(), 0.15}), 3., 0.2, std::move(seeds)};
  specimen.whole.node_sets["corner"] = {0};
  specimen.displacements = {
      {"hold x", "left", 0, {0., 0.}}, {"hold y", "corner", 1, {0., 0.}}, {"pull", "right", 0, {0.024, 0.}}};
  specimen.peridynamic_stiffness = PeridynamicStiffness::kept;
  specimen.tolerance = 1e-12;
  return specimen;
}

struct Errors {
  double displacement = 0., stress = 0.;
};

/// The largest errors at the places, over the largest displacement and the stress; on rank 0.
Errors errors_at(const std::vector<cases::Probe>& probes, std::vector<Zone<2>> seeds, int points_per_direction) {
  auto specimen = pulled(std::move(seeds));
  specimen.points_per_direction = points_per_direction;
  SpecimenBody test(specimen);
  test.body.apply_load(1.);
  test.body.update_topology();
  test.body.solve(fracture::Accuracy::accepted);
  const auto comm = Tpetra::getDefaultComm();
  const output::Probes<2> all(*comm, test.mesh, probes);

  const auto samples = all.measure(*comm, test.body);

  Errors errors;
  EXPECT_EQ(samples.size(), comm->getRank() == 0 ? all.places().size() : 0u);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    EXPECT_EQ(samples[i].place, static_cast<int>(i));
    const Point2& x = all.places()[i].position;
    const Point2 u(0.001 * x[0], -0.001 / 3. * x[1]);
    errors.displacement =
        std::max(errors.displacement, (Eigen::Map<const Point2>(samples[i].displacement.data()) - u).norm() / 0.024);
    const Eigen::Map<const Eigen::Vector3d> stress(samples[i].stress.data());
    errors.stress = std::max(errors.stress, (stress - Eigen::Vector3d(1., 0., 0.)).norm());
  }
  return errors;
}

const std::vector<cases::Probe> lines = {{"across", {0., 11.3, 24., 12.9}, 40},
                                         {"corners", {0., 0., 24., 0., 24., 24., 0., 24.}, 1},
                                         {"node", {12., 24.}, 1}};

TEST(Probes, MeasureALinearFieldOfAClassicalBodyToRounding) {
  for (const int points_per_direction : {2, 3}) {
    const auto errors = errors_at(lines, {}, points_per_direction);
    EXPECT_LT(errors.displacement, 1e-9);
    EXPECT_LT(errors.stress, 1e-9);
  }
}

/// What the patch test finds of the model itself: some per mille.
TEST(Probes, MeasureItAcrossAMorphingZoneAsWellAsTheModelHasIt) {
  for (const int points_per_direction : {2, 3}) {
    const auto errors = errors_at(lines, {Zone<2>::ball({12., 12.}, 4., 8.)}, points_per_direction);
    EXPECT_LT(errors.displacement, 0.005);
    EXPECT_LT(errors.stress, 0.05);
  }
}

TEST(ProbePlaces, AreTheGivenPointsAndTheDivisionsBetween) {
  const auto places = cases::places_of<2>({"line", {0., 0., 2., 0., 2., 4.}, 2});
  ASSERT_EQ(places.size(), 5u);
  EXPECT_EQ(places[1], Point2(1., 0.));
  EXPECT_EQ(places[3], Point2(2., 2.));
  EXPECT_EQ(places[4], Point2(2., 4.));
  EXPECT_EQ(cases::places_of<2>({"point", {3., 1.}, 7}), std::vector<Point2>{Point2(3., 1.)});
}

}  // namespace
}  // namespace perimorph::tests
