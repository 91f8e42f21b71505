// Crack faces that are pressed together: a closed slit in a plate whose edge moves by a uniform strain.

#include <gtest/gtest.h>

#include <map>

#include "patch.hpp"
#include "perimorph/mesh/shared_sides.hpp"

namespace perimorph::tests {
namespace {

using discretization::CrackFaces;
using Gradient = GradientIn<2>;
using Corners = std::vector<Point2>;

constexpr int half_width = 20;
constexpr double strain_size = 1e-3;

struct Slit {
  double distortion;  ///< of the mesh
  Corners corners;    ///< of the pre-crack
  double angle;       ///< of its course, [rad]
  /// How far its faces may overlap where they close, and where they slide too, in units of strain and elements.
  double overlap = 0.1, overlap_of_sliding = 0.1;
};

mesh::Mesh<2> plate(double distortion) {
  constexpr double width = 2. * half_width;
  return grid({2 * half_width, 2 * half_width, width, width, Point2(-half_width, -half_width), distortion});
}

/// A slit from node to node, in steps of one element along x or y.
Corners staircase(const mesh::Mesh<2>& whole, int n, double slope) {
  Corners corners;
  const auto add = [&](int i, int j) {
    corners.push_back(whole.coordinates[(j + half_width) * (2 * half_width + 1) + i + half_width]);
  };
  const auto height = [&](int i) { return static_cast<int>(std::floor(slope * i + 0.25)); };
  for (int i = -n; i <= n; ++i) {
    add(i, height(i));
    if (i < n && height(i + 1) != height(i)) add(i, height(i + 1));
  }
  return corners;
}

/// Normal strain across the slit's course, with the contraction along it, and shear along it.
Gradient gradient(const Slit& slit, double closing, double shear) {
  Gradient own;
  own << closing / 3., shear, shear, -closing;
  Gradient turn;
  turn << std::cos(slit.angle), -std::sin(slit.angle), std::sin(slit.angle), std::cos(slit.angle);
  return turn * own * turn.transpose();
}

struct Result {
  double energy = 0., gap = 0.;  ///< smallest opening of the faces along the course's normal, [length]
  base::GlobalId solves = 0;
};

/// How far the upper face of a slit along sides of elements moves against the lower one, at most, along a direction.
/// @param up the normal that says which is the upper one
template <int dim>
double largest_jump(const SpecimenBodyIn<dim>& test, const base::Point<dim>& up, const base::Point<dim>& direction) {
  const auto& mesh = test.mesh;
  double largest = -std::numeric_limits<double>::infinity();
  for (auto [upper, lower] : mesh::coincident_sides(mesh, mesh.boundary)) {
    const auto height = [&](const mesh::Side& side) { return up.dot(mesh::centroid(mesh, side.element)); };
    if (height(upper) < height(lower)) std::swap(upper, lower);
    for (const auto& x : mesh::corner_points(mesh, upper)) {
      const auto displacement = [&](int element) -> base::Point<dim> {
        int k = 0;
        while (mesh.coordinates[mesh.corners_of(element)[k]] != x) ++k;
        return base::at_node<dim>(test.body.displacement(), test.body.topology().dofs().nodes_of(element)[k]);
      };
      largest = std::max(largest, direction.dot(displacement(upper.element) - displacement(lower.element)));
    }
  }
  return base::max(*Tpetra::getDefaultComm(), largest);
}

template <int dim>
Result deform(mesh::Mesh<dim> whole, const std::vector<mesh::CrackFacet<dim>>& cut, const GradientIn<dim>& gradient,
              const base::Point<dim>& normal, CrackFaces faces, std::optional<double> poissons_ratio = {}) {
  mesh::open_along<dim>(whole, cut);
  SpecimenIn<dim> specimen = patch<dim>(std::move(whole), dim == 2 ? 4. : 2., dim == 2 ? 1. / 3. : 0.25, gradient);
  specimen.seeds = {dim == 2 ? Zone<dim>::ball(base::Point<dim>::Zero(), 13., 18.) : Zone<dim>::everything()};
  specimen.pre_cracks = cut;
  specimen.crack_faces = faces;
  specimen.poissons_ratio = poissons_ratio;
  specimen.tolerance = 1e-6;
  SpecimenBodyIn<dim> test(specimen);
  test.advance(1.);
  return {test.body.energies().elastic, -largest_jump<dim>(test, normal, -normal), test.body.counts().linear_solves};
}

// ---- in two dimensions ----

/// The solutions for closing and shearing add up where faces slide freely: closed faces do not know of the shear, and
/// open ones that are sheared do not press.
void expect_that_it_carries_and_slides(const Slit& slit, std::optional<double> poissons_ratio = {}) {
  const auto cut = mesh::polyline(slit.corners);
  const Point2 normal(-std::sin(slit.angle), std::cos(slit.angle));
  const auto deformed = [&](double closing, double shear, bool is_cut, CrackFaces faces) {
    return deform<2>(plate(slit.distortion), is_cut ? cut : std::vector<mesh::CrackFacet<2>>(),
                     gradient(slit, closing, shear), normal, faces, poissons_ratio);
  };
  const auto whole = deformed(strain_size, 0., false, CrackFaces::free);
  const auto through = deformed(strain_size, 0., true, CrackFaces::free);
  const auto closed = deformed(strain_size, 0., true, CrackFaces::contact);
  const auto sheared = deformed(0., strain_size, true, CrackFaces::free);
  const auto stuck = deformed(0., strain_size, false, CrackFaces::free);
  const auto both = deformed(strain_size, strain_size, true, CrackFaces::contact);

  EXPECT_LT(through.energy, 0.92 * whole.energy);
  EXPECT_NEAR(closed.energy, whole.energy, 0.005 * whole.energy);
  EXPECT_GT(closed.gap, -slit.overlap * strain_size);
  EXPECT_GT(stuck.energy, 1.04 * sheared.energy);
  EXPECT_NEAR(both.energy - whole.energy, sheared.energy, 0.015 * sheared.energy);
  EXPECT_GT(both.gap, -slit.overlap_of_sliding * strain_size);
  EXPECT_LE(std::max(closed.solves, both.solves), 10);
}

TEST(ClosedSlit, AlongSidesOfElementsCarriesAndSlides) {
  for (const double poissons_ratio : {1. / 3., 0.2}) {
    expect_that_it_carries_and_slides({0., {{-8., 0.}, {8., 0.}}, 0.}, poissons_ratio);
  }
}

TEST(ClosedSlit, ThroughElementsCarriesAndSlides) {
  constexpr double angle = M_PI / 6.;
  const Point2 along(std::cos(angle), std::sin(angle));
  for (const double distortion : {0., 0.1}) {
    expect_that_it_carries_and_slides({distortion, {-8. * along, 8. * along}, angle});
  }
}

TEST(ClosedSlit, InStepsFollowsItsCourse) {
  for (const double distortion : {0., 0.15}) {
    constexpr double slope = 0.5;  // it slides by 24
    expect_that_it_carries_and_slides({distortion, staircase(plate(distortion), 8, slope), std::atan(slope), 0.2, 2.});
  }
}

// ---- with friction ----

struct Slid {
  double slip;  ///< at most, in the middle of the slit, [length]
  discretization::Energies energies;
  base::GlobalId solves;
};

constexpr double half_length = 8., inclination = M_PI / 4.;

/// A slit in a plate that is pressed along a line at an angle to it, by these shares of the strain one after the other.
std::vector<Slid> press(double friction, const std::vector<double>& loads) {
  const auto cut = mesh::polyline({{-half_length, 0.}, {half_length, 0.}});
  auto whole = plate(0.);
  mesh::open_along<2>(whole, cut);
  const Slit turned{0., {}, inclination};
  Specimen specimen = patch<2>(std::move(whole), 4., 1. / 3., gradient(turned, strain_size, 0.));
  specimen.seeds = {Zone<2>::ball({0., 0.}, 13., 18.)};
  specimen.pre_cracks = cut;
  specimen.crack_faces = CrackFaces::contact;
  specimen.friction = friction;
  specimen.tolerance = 1e-6;
  SpecimenBody test(specimen);
  std::vector<Slid> course;
  for (const double load : loads) {
    test.advance(load);
    const auto slip = [&](double sense) { return largest_jump<2>(test, {0., 1.}, {sense, 0.}); };
    course.push_back({std::max(slip(1.), slip(-1.)), test.body.energies(), test.body.counts().linear_solves});
  }
  return course;
}

/// Under a stress sigma along a line at an angle to the slit its faces press on each other by sigma cos^2 and are
/// sheared by sigma sin cos; friction takes its coefficient times the former off the latter. In an infinite plate in
/// plane stress the middle slides by 4 a / E times what is left: without friction, at 45 degrees, by this.
constexpr double free_slip = 4. * half_length * 0.5 * strain_size, accuracy = 0.05 * free_slip;

TEST(Friction, OfAnInclinedSlitLeavesWhatTheShearExceedsIt) {
  for (const double friction : {0., 0.3, 0.6, 2.}) {
    const auto at_once = press(friction, {1.}).back(), in_steps = press(friction, {0.25, 0.5, 0.75, 1.}).back();
    EXPECT_NEAR(at_once.slip, std::max(0., 1. - friction / std::tan(inclination)) * free_slip, accuracy);
    EXPECT_NEAR(in_steps.slip, at_once.slip, 1e-3 * free_slip);
    EXPECT_EQ(in_steps.energies.friction > 0., friction > 0.);
    const auto& [elastic, dissipated, work, rubbed] = in_steps.energies;
    EXPECT_NEAR(work, elastic + rubbed, 1e-6 * elastic);
    EXPECT_LE(std::max(at_once.solves, in_steps.solves), 12);
  }
}

/// Let go down to a share of the load, the faces stick until friction is as large the other way, at a share of
/// (1 - f) / (1 + f), and then slide back to (1 + f) times it; loaded again they come to where they were.
TEST(Friction, HoldsWhatHasSlidUntilItIsAsLargeTheOtherWay) {
  constexpr double friction = 0.3;
  const auto course = press(friction, {1., 0.7, 0.2, 1.});
  EXPECT_NEAR(course[1].slip, course[0].slip, accuracy);
  EXPECT_NEAR(course[2].slip, 0.2 * (1. + friction) * free_slip, accuracy);
  EXPECT_NEAR(course[3].slip, course[0].slip, accuracy);
  for (const int slides : {2, 3}) {
    EXPECT_GT(course[slides].energies.friction, 1.1 * course[slides - 1].energies.friction);
    const auto& [elastic, dissipated, work, rubbed] = course[slides].energies;
    EXPECT_NEAR(work, elastic + rubbed, 1e-4 * elastic);
  }
}

// ---- in three dimensions ----

TEST(ClosedSlit, InABlockCarries) {
  const auto cut = mesh::polygon({{2., 2., 4.}, {6., 2., 4.}, {6., 6., 4.}, {2., 6., 4.}});
  GradientIn<3> closing = GradientIn<3>::Zero();
  closing.diagonal() << 0.25 * strain_size, 0.25 * strain_size, -strain_size;
  const auto deformed = [&](const std::vector<mesh::CrackFacet<3>>& facets, CrackFaces faces) {
    return deform<3>(brick({8, 8, 8}), facets, closing, {0., 0., 1.}, faces);
  };
  const auto whole = deformed({}, CrackFaces::free), through = deformed(cut, CrackFaces::free),
             closed = deformed(cut, CrackFaces::contact);
  EXPECT_LT(through.energy, 0.97 * whole.energy);
  EXPECT_LT(through.gap, -2. * strain_size);
  EXPECT_NEAR(closed.energy, whole.energy, 0.01 * whole.energy);
  EXPECT_GT(closed.gap, -0.1 * strain_size);
  EXPECT_LE(closed.solves, 10);
}

// ---- a crack that has grown ----

TEST(ClosedCrack, CarriesAndReturnsToItsPath) {
  const discretization::Amplitude program({{0., 0.}, {4., 8.}, {6., 0.}, {8., -8.}, {10., 0.}, {12., 8.}, {14., 12.}});
  const auto cracked = [&](const discretization::Amplitude* amplitude, bool breaks) {
    mesh::Mesh<2> whole = grid({12, 12, 12., 12.});
    const std::vector<mesh::CrackFacet<2>> slit = {{Point2(-1., 6.), Point2(4., 6.)}};
    if (breaks) mesh::open_along<2>(whole, slit);
    Specimen specimen{whole, 3., 0.3};
    if (breaks) specimen.pre_cracks = slit;
    specimen.displacements = {{"hold x", "bottom", 0, {0., 0.}},
                              {"hold y", "bottom", 1, {0., 0.}},
                              {"pull", "top", 1, {0.01, 0., amplitude}}};
    specimen.is_proportional = false;
    specimen.seeds = {Zone<2>::everything()};
    if (breaks) specimen.critical_stretch = 0.01;
    specimen.crack_faces = CrackFaces::contact;
    return specimen;
  };
  SpecimenBody test(cracked(&program, true)), monotone(cracked(nullptr, true)), whole(cracked(nullptr, false));
  std::map<int, discretization::Energies> energies;
  std::map<int, base::GlobalId> broken;
  for (int k = 1; k <= 14; ++k) {
    test.advance(k);
    energies[k] = test.body.energies();
    broken[k] = test.body.counts().broken_bonds;
  }
  whole.advance(-8.);
  for (const int load : {2, 4, 6, 8, 10, 12}) monotone.advance(load);

  EXPECT_GT(broken[4], 50);
  EXPECT_EQ(broken[12], broken[4]);
  EXPECT_NEAR(energies[8].elastic, whole.body.energies().elastic, 0.05 * whole.body.energies().elastic);
  for (const int pressed : {7, 8}) {  // nothing breaks any more, and no energy is lost
    const auto& [elastic, dissipated, work, friction] = energies[pressed];
    EXPECT_EQ(dissipated, energies[4].dissipated);
    EXPECT_EQ(friction, 0.);
    EXPECT_NEAR(work - elastic, energies[4].external_work - energies[4].elastic, 1e-6 * elastic);
  }
  EXPECT_NEAR(energies[12].elastic, energies[4].elastic, 1e-6 * energies[4].elastic);
  EXPECT_GT(broken[14], broken[12]);
  EXPECT_EQ(broken[14], monotone.body.counts().broken_bonds);
  EXPECT_NEAR(energies[14].elastic, monotone.body.energies().elastic, 1e-6 * energies[14].elastic);
}

}  // namespace
}  // namespace perimorph::tests
