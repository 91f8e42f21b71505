// The splitting test, on the coarse disk of inputs/splitting_disk: the load at which it cracks, and that it splits
// once.

#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <sstream>

#include "perimorph/mesh_files/gmsh.hpp"
#include "perimorph/mesh_files/read_mesh.hpp"
#include "support/fracture_body.hpp"

namespace perimorph::tests {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double diameter = 100., size = 2.5, youngs_modulus = 20000., tensile_strength = 5.;
constexpr double arc = diameter * 8. / 180. * pi;  // half of each loaded one times two, [length]

mesh::Mesh<2> meshed_disk(bool is_regular) {
  std::ostringstream geometry;
  geometry << std::ifstream(PERIMORPH_SOURCE_DIR "/inputs/splitting_disk/splitting_disk.geo").rdbuf();
  const auto text = std::regex_replace(geometry.str(), std::regex("dx = [^;]*;"), "dx = " + std::to_string(size) + ";");
  const std::string stem = testing::TempDir() + "perimorph_splitting";
  std::ofstream(stem + ".geo") << (is_regular ? std::regex_replace(text, std::regex("regular = 0;"), "regular = 1;")
                                              : text);
  mesh_files::mesh_geometry(stem + ".geo", stem + ".msh", 2);
  return mesh_files::read_mesh<2>(stem + ".msh");
}

struct Disk {
  bool is_regular = false;
  discretization::CrackFaces faces = discretization::CrackFaces::free;
  std::optional<double> compressive_strength = {};
};

/// As the example, horizon and characteristic length by the elements; the load factor is the force P.
Specimen specimen_of(const Disk& disk) {
  Specimen specimen{meshed_disk(disk.is_regular), 4. * size, size / 3., {Zone<2>::box({-14., -20.}, {14., 20.}, 6.)}};
  specimen.displacements = {
      {"hold x", "left", 0, {0., 0.}}, {"hold y", "left", 1, {0., 0.}}, {"hold right", "right", 1, {0., 0.}}};
  specimen.tractions = {{"top", {Point2(0., -1. / arc), Point2::Zero()}},
                        {"bottom", {Point2(0., 1. / arc), Point2::Zero()}}};
  specimen.youngs_modulus = youngs_modulus;
  specimen.critical_stretch = tensile_strength / youngs_modulus;
  specimen.compressive_strength = disk.compressive_strength;
  specimen.crack_faces = disk.faces;
  specimen.tolerance = 1e-4;
  specimen.control =
      model::MeasureControl<2>{{{"", Point2(4., 0.)}, {{"", Point2(-4., 0.)}}, Point2(1., 0.)}, {1., 0.}};
  return specimen;
}

/// Where sigma / f_t + 3 sigma / f_c = 1 at the centre, sigma = 2 P / (pi D) across the load and three times that along
/// it.
double load_at_the_centre(const Disk& disk) {
  const double f_c = disk.compressive_strength.value_or(3. * tensile_strength);
  return 0.5 * pi * diameter / (1. / tensile_strength + 3. / f_c);
}

/// How many a straight crack from pole to pole severs, on rank 0.
double bonds_across(const Disk& disk) {
  Specimen specimen = specimen_of(disk);
  specimen.seeds = {Zone<2>::everything()};
  SpecimenBody test(specimen);
  test.body.update_topology();
  const auto& topology = test.body.topology();
  int severed = 0;
  topology.bonds().for_each_bond([&](const bonds::Bond<2>& bond) {
    severed += topology.points().position(bond.first_point)[0] * topology.points().position(bond.second_point)[0] < 0.;
  });
  return severed;
}

struct Course {
  double peak = 0., fallen_to = 0.;  ///< loads: the first after which it falls, and the last
  double broken = 0., width = 0.;    ///< bonds; elements that have lost a quarter of theirs, over the diameter
};

/// Small increments to the peak, and large ones until the middle has widened by so many times what it had there.
Course split(const Disk& disk) {
  constexpr double elastic = 1e-4, finally = 4.5;
  constexpr int increments = 12;
  SpecimenBody test(specimen_of(disk));
  test.advance(elastic);
  const double expected = elastic * load_at_the_centre(disk) / test.body.load_factor();
  Course course;
  double measure = 0.85 * expected;
  for (; test.body.load_factor() >= course.peak; measure += 0.01 * expected) {
    course.peak = test.body.load_factor();
    test.advance(measure);
  }
  const double step = (finally * expected - measure) / increments;
  for (int i = 1; i <= increments; ++i) test.advance(measure + i * step);
  course.fallen_to = test.body.load_factor();
  const auto& topology = test.body.topology();
  course.broken = static_cast<double>(test.body.counts().broken_bonds);
  for (int e = 0; e < test.mesh.n_elements(); ++e) {
    double volume = 0., damage = 0.;
    for (int p = topology.points().first(e); p < topology.points().first(e + 1); ++p) {
      volume += topology.points().weight(p);
      damage += topology.bonds().damage(p) / topology.points().count(e);
    }
    if (damage > 0.25) course.width += volume / (diameter * size);
  }
  return course;
}

void expect_one_split(const Disk& disk) {
  const Course course = split(disk);

  EXPECT_NEAR(course.peak / load_at_the_centre(disk), 1., 0.05);
  EXPECT_LT(course.fallen_to, 0.6 * course.peak);
  EXPECT_GT(course.broken, 0.5 * bonds_across(disk));
  EXPECT_LT(course.broken, 1.3 * bonds_across(disk));
  EXPECT_LT(course.width, 3.);
}

TEST(SplittingDisk, SplitsOnceAtTheLoadOfItsCentre) { expect_one_split({}); }

TEST(SplittingDisk, SplitsOnceOnARegularMesh) { expect_one_split({true}); }

TEST(SplittingDisk, SplitsOnceWithContactOfItsFaces) { expect_one_split({false, discretization::CrackFaces::contact}); }

TEST(SplittingDisk, WithTheCompressiveStrengthOfRockSplitsOnceAtTheLoadOfItsCentre) {
  expect_one_split({false, discretization::CrackFaces::free, 10. * tensile_strength});
}

}  // namespace
}  // namespace perimorph::tests
