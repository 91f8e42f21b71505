// Increments that prescribe a measured displacement: the load follows, past its peak and back.

#include <gtest/gtest.h>

#include "perimorph/model/calibration.hpp"
#include "support/fracture_body.hpp"

namespace perimorph::tests {
namespace {

using model::MeasureControl;

constexpr double youngs_modulus = 37000., fracture_energy = 0.02;

MeasureControl<2> between(const Point2& x, const Point2& other, const Point2& direction) {
  return {{{"", x}, {{"", other}}, direction}, {1., 0.}};
}

double load_of(const SpecimenBody& test) { return test.body.load_factor(); }

// ---- without breaks ----

Specimen plate() {
  Specimen specimen{grid({10, 10, 10., 10., Point2::Zero(), 0.1}), 3., 0.3, {Zone<2>::ball({5., 5.}, 3., 6.)}};
  specimen.displacements = {{"hold x", "bottom", 0, {0., 0.}}, {"hold y", "bottom", 1, {0., 0.}}};
  specimen.tractions = {{"top", {Point2(0.3, 1.), Point2::Zero()}}};
  return specimen;
}

void expect_the_same_as_under_its_load(Specimen specimen) {
  specimen.control = between({7.3, 9.1}, {4.2, 2.5}, {0.6, 0.8});
  SpecimenBody controlled(specimen);
  specimen.control.reset();
  SpecimenBody loaded(specimen);

  for (const double value : {0.02, 0.03, 0.01}) {
    controlled.advance(value);
    loaded.advance(load_of(controlled));

    EXPECT_NEAR(controlled.body.measured(), value, 1e-8 * value);
    const auto u = controlled.body.displacement(), other = loaded.body.displacement();
    for (int dof = 0; dof < u.size(); ++dof) EXPECT_NEAR(u[dof], other[dof], 1e-8 * 0.03);
    const auto energies = controlled.body.energies();
    EXPECT_NEAR(energies.external_work, energies.elastic, 1e-6 * energies.elastic);
  }
}

TEST(Measure, GivesTheStateThatItsLoadGives) { expect_the_same_as_under_its_load(plate()); }

TEST(Measure, GivesTheStateThatItsLoadGivesBesideAConstantLoad) {
  Specimen specimen = plate();
  specimen.tractions.push_back({"right", {Point2::Zero(), Point2(0.5, -0.2)}});
  specimen.is_proportional = false;
  expect_the_same_as_under_its_load(specimen);
}

TEST(Measure, GivesTheStateThatItsLoadGivesAlsoWithPrescribedDisplacementsAndDilatation) {
  Specimen specimen = plate();
  specimen.tractions.clear();
  specimen.displacements.push_back({"pull", "top", 1, {0.001, 0.002}});
  specimen.is_proportional = false;
  specimen.poissons_ratio = 0.2;
  expect_the_same_as_under_its_load(specimen);
}

TEST(Measure, InThreeDimensionsToo) {
  SpecimenIn<3> specimen{brick({6, 4, 4}), 2., 0.3, {Zone<3>::everything()}};
  specimen.displacements = {{"hold x", "left", 0, {0., 0.}},
                            {"hold y", "left", 1, {0., 0.}},
                            {"hold z", "left", 2, {0., 0.}},
                            {"pull", "right", 0, {2., 0.}}};
  specimen.control =
      MeasureControl<3>{{{"", Point3(4.5, 2., 2.)}, {{"", Point3(1.5, 2., 2.)}}, Point3(1., 0., 0.)}, {1., 0.}};
  SpecimenBodyIn<3> test(specimen);

  test.advance(0.03);
  const double load = test.body.load_factor();
  test.advance(0.06);

  EXPECT_NEAR(test.body.measured(), 0.06, 1e-9);
  EXPECT_NEAR(test.body.load_factor(), 2. * load, 1e-6 * load);
}

TEST(Measure, ThatShrinksWithTheLoadStopsTheRunAndChangesNothing) {
  Specimen specimen = plate();
  specimen.control = between({7.3, 9.1}, {4.2, 2.5}, {-0.6, -0.8});
  SpecimenBody test(specimen);

  try {
    test.advance(0.02);
    FAIL() << "at load " << load_of(test);
  } catch (const fracture::UnfinishedIncrement& error) {
    EXPECT_NE(std::string(error.what()).find("does its Direction point against the load"), std::string::npos)
        << error.what();
  }
  EXPECT_EQ(test.position.increment, 0);
}

// ---- a strip with two notches, longer than wide: its grips spring back when it breaks ----

Specimen notched_strip() {
  mesh::Mesh<2> whole = grid({16, 48, 16., 48.});
  const std::vector<mesh::CrackFacet<2>> slits = {{Point2(-1., 24.), Point2(4., 24.)},
                                                  {Point2(17., 24.), Point2(12., 24.)}};
  mesh::open_along<2>(whole, slits);
  Specimen specimen{std::move(whole), 3., 1. / 3., {Zone<2>::box({0., 20.}, {16., 28.}, 4.)}};
  specimen.pre_cracks = slits;
  specimen.displacements = {
      {"hold x", "bottom", 0, {0., 0.}}, {"hold y", "bottom", 1, {0., 0.}}, {"pull", "top", 1, {1., 0.}}};
  specimen.critical_stretch = 0.002;
  specimen.tolerance = 1e-6;
  return specimen;
}

struct Course {
  double largest_fall = 0.;  ///< of the reaction from one increment to the next, over the largest
  double loss = 0.;          ///< in jumps, over what was dissipated
  base::GlobalId broken = 0;
};

Course run(const Specimen& specimen, double last, int increments) {
  SpecimenBody test(specimen);
  Course course;
  double before = 0., peak = 0., fall = 0.;
  for (int i = 1; i <= increments; ++i) {
    test.advance(last * i / increments);
    double reaction = 0.;
    const auto& dofs = test.body.topology().dofs();
    for (int n = 0; n < dofs.n_owned_nodes(); ++n) {
      if (test.mesh.coordinates[dofs.reference_node(n)][1] == 48.) reaction += test.body.reaction(n)[1];
    }
    reaction = base::sum(*Tpetra::getDefaultComm(), reaction);
    peak = std::max(peak, reaction);
    fall = std::max(fall, before - reaction);
    before = reaction;
  }
  const auto energies = test.body.energies();
  course.largest_fall = fall / peak;
  course.broken = test.body.counts().broken_bonds;
  course.loss = (energies.external_work - energies.elastic - energies.dissipated) / energies.dissipated;
  return course;
}

TEST(DoubleNotch, IsFollowedWhereUnderLoadItJumps) {
  const Course jump = run(notched_strip(), 0.06, 40);
  Specimen specimen = notched_strip();
  specimen.control = between({8., 25.}, {8., 23.}, {0., 1.});

  const Course path = run(specimen, 0.012, 60);

  EXPECT_GT(jump.broken, 1000);
  EXPECT_GT(path.broken, 1000);
  EXPECT_GT(jump.largest_fall, 0.9);
  EXPECT_LT(path.largest_fall, 0.35);
  EXPECT_GT(jump.loss, 0.5);
  EXPECT_LT(path.loss, 0.15);
}

// ---- a brittle beam in three-point bending, against fracture mechanics ----

constexpr double span = 125., length = 175., height = 50., size = 2.5;

Specimen beam(double notch) {
  mesh::Mesh<2> whole = grid({70, 20, length, height, Point2(-0.5 * length, 0.)});
  const std::vector<mesh::CrackFacet<2>> slit = {{Point2(0., -1.), Point2(0., notch)}};
  mesh::open_along<2>(whole, slit);
  for (int n = 0; n < whole.n_nodes(); ++n) {
    if (whole.coordinates[n] == Point2(-0.5 * span, 0.)) whole.node_sets["left support"] = {n};
    if (whole.coordinates[n] == Point2(0.5 * span, 0.)) whole.node_sets["right support"] = {n};
  }
  for (const auto& side : whole.side_sets.at("top")) {
    if (std::abs(mesh::centroid(whole, side.element)[0]) < 5.) whole.side_sets["platen"].push_back(side);
  }
  Specimen specimen{std::move(whole), 3. * size, size / 3., {Zone<2>::ball({0., notch}, 15., 30.)}};
  specimen.pre_cracks = slit;
  specimen.displacements = {{"pin x", "left support", 0, {0., 0.}},
                            {"pin y", "left support", 1, {0., 0.}},
                            {"roller", "right support", 1, {0., 0.}}};
  specimen.tractions = {{"platen", {Point2(0., -0.1), Point2::Zero()}}};  // a force of the load factor
  specimen.youngs_modulus = youngs_modulus;
  specimen.tolerance = 1e-6;
  specimen.control = between({0.01, 0.}, {-0.01, 0.}, {1., 0.});
  return specimen;
}

/// The critical stretch at which a crack runs at that fracture energy on this mesh.
double critical_stretch(const Specimen& specimen) {
  auto problem = make_problem(specimen);
  auto& toughness = problem.materials[0].toughness;
  const double of_unit_stretch = materials::fracture_energy<2>(problem.materials[0].micromodulus, 1., 0.);
  toughness = {std::sqrt(fracture_energy / of_unit_stretch), fracture_energy};
  problem.calibration = model::Calibration::mesh_consistent;
  EXPECT_TRUE(model::calibrate_to_mesh(problem, make_options(specimen), size));
  return toughness.critical_stretch();
}

/// Openings of the mouth at which cracks of growing length run, and their forces: from the energy that a crack's growth
/// releases, G = F^2 / 2 dC / da, by finite elements. Notches are a multiple of the elements' size long.
struct LinearElasticFracture {
  std::vector<double> openings, forces;

  LinearElasticFracture() {
    double compliance = 0., opening = 0.;
    for (double notch = 7.5; notch < 45.; notch += size) {
      Specimen specimen = beam(notch);
      specimen.seeds.clear();
      SpecimenBody test(specimen);
      test.advance(1e-3);
      const double force = load_of(test);
      const double next_compliance = 2. * test.body.energies().elastic / (force * force), next_opening = 1e-3 / force;
      if (compliance > 0.) {
        forces.push_back(std::sqrt(2. * fracture_energy * size / (next_compliance - compliance)));
        openings.push_back(0.5 * (opening + next_opening) * forces.back());
      }
      compliance = next_compliance;
      opening = next_opening;
    }
  }

  double force_at(double opening) const {
    const auto after = std::upper_bound(openings.begin(), openings.end(), opening);
    const auto i = after - openings.begin();
    const double share = (opening - openings[i - 1]) / (openings[i] - openings[i - 1]);
    return forces[i - 1] + share * (forces[i] - forces[i - 1]);
  }
};

TEST(BrittleBeam, FollowsFractureMechanicsAtEqualOpening) {
  const LinearElasticFracture theory;
  Specimen specimen = beam(10.);
  specimen.critical_stretch = critical_stretch(specimen);
  SpecimenBody test(specimen);
  constexpr double step = 7e-4;
  double sum = 0., before = 0., fall = 0.;
  std::vector<double> ratios;
  for (int i = 1; i <= 55; ++i) {
    test.advance(i * step);
    const double force = load_of(test);
    fall = std::max(fall, before - force);
    before = force;
    if (i * step <= theory.openings.front() || i * step >= theory.openings.back()) continue;
    ratios.push_back(force / theory.force_at(i * step));
    sum += ratios.back();
  }
  const auto energies = test.body.energies();
  const double loss = (energies.external_work - energies.elastic - energies.dissipated) / energies.dissipated;

  EXPECT_GT(ratios.size(), 30u);
  EXPECT_NEAR(sum / static_cast<double>(ratios.size()), 1., 0.07);
  EXPECT_LT(*std::max_element(ratios.begin(), ratios.end()), 1.2);
  EXPECT_LT(fall, 0.15 * theory.forces.front());
  EXPECT_LT(loss, 0.12);
}

}  // namespace
}  // namespace perimorph::tests
