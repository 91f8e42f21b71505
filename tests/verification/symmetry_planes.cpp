// A half, a quarter or an eighth of a body with planes of symmetry is what the whole body is: cracks on the planes,
// cracks that start from them, bonds across them.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "perimorph/mesh/images.hpp"
#include "support/fracture_body.hpp"

namespace perimorph::tests {
namespace {

constexpr double round_off = 1e-7;  // of CG's tolerance, 1e-11 of the reactions, what energies have

/// The corners of a mirror image, in an order that is not inside out.
std::vector<int> corners_of_image(mesh::ElementType type) {
  switch (type) {
    case mesh::ElementType::tri3:
      return {0, 2, 1};
    case mesh::ElementType::quad4:
      return {0, 3, 2, 1};
    case mesh::ElementType::hex8:
      return {0, 3, 2, 1, 4, 7, 6, 5};
    default:
      throw std::logic_error("no image of this type");
  }
}

/// A half and its image across a plane through the origin: the half's elements come first. They share the nodes of a
/// group; groups get images too: "x-image of NAME", and "x-both of NAME" with them.
template <int dim>
mesh::Mesh<dim> doubled(const mesh::Mesh<dim>& half, int axis, const std::string& plane) {
  mesh::Mesh<dim> whole;
  whole.block_names = half.block_names;
  whole.coordinates = half.coordinates;
  whole.types = half.types;
  whole.blocks = half.blocks;
  whole.first_corner = half.first_corner;
  whole.corners = half.corners;
  whole.node_sets = half.node_sets;
  const auto& on_plane = half.node_sets.at(plane);
  std::vector<int> image(half.n_nodes());
  for (int n = 0; n < half.n_nodes(); ++n) {
    image[n] = n;
    if (std::binary_search(on_plane.begin(), on_plane.end(), n)) continue;
    image[n] = whole.n_nodes();
    whole.coordinates.push_back(half.coordinates[n]);
    whole.coordinates.back()[axis] *= -1.;
  }
  for (int e = 0; e < half.n_elements(); ++e) {
    whole.types.push_back(half.types[e]);
    whole.blocks.push_back(half.blocks[e]);
    for (const int k : corners_of_image(half.types[e])) whole.corners.push_back(image[half.corners_of(e)[k]]);
    whole.first_corner.push_back(static_cast<int>(whole.corners.size()));
  }
  const char letter = "xyz"[axis];
  for (const auto& [name, nodes] : half.node_sets) {
    auto& images = whole.node_sets[fmt::format("{}-image of {}", letter, name)];
    auto& both = whole.node_sets[fmt::format("{}-both of {}", letter, name)];
    for (const int n : nodes) images.push_back(image[n]);
    std::sort(images.begin(), images.end());
    std::set_union(nodes.begin(), nodes.end(), images.begin(), images.end(), std::back_inserter(both));
  }
  complete(whole);
  return whole;
}

/// Nodes of a set further along an axis than that, as another set.
template <int dim>
void cut_set(mesh::Mesh<dim>& mesh, const std::string& from, int axis, double beyond, const std::string& name) {
  for (const int n : mesh.node_sets.at(from)) {
    if (mesh.coordinates[n][axis] > beyond - 1e-9) mesh.node_sets[name].push_back(n);
  }
}

/// What of a body can be compared with a part of it.
struct Outcome {
  std::vector<double> elastic, dissipated;
  std::vector<std::map<base::GlobalId, double>> damage;  ///< by element, of all its points
  std::vector<base::GlobalId> broken;
  base::GlobalId first_iterations = 0;  ///< of conjugate gradients, at the first load
};

template <int dim>
std::map<base::GlobalId, double> damage_of(const base::Comm& comm, const fracture::Body<dim>& body) {
  struct One {
    base::GlobalId element;
    double damage;
  };
  std::vector<One> own;
  const auto& points = body.topology().points();
  for (int e = 0; e < body.mesh().n_owned_elements; ++e) {
    One one{body.mesh().element_ids[e], 0.};
    for (int p = points.first(e); p < points.first(e + 1); ++p) one.damage += body.topology().bonds().damage(p);
    own.push_back(one);
  }
  std::map<base::GlobalId, double> all;
  const auto gathered = base::gather_on_all(comm, own);
  for (const auto& [element, damage] : gathered) all[element] = damage;
  return all;
}

template <int dim>
Outcome pulled(const SpecimenIn<dim>& specimen, const std::vector<double>& loads) {
  const auto comm = Tpetra::getDefaultComm();
  SpecimenBodyIn<dim> test(specimen);
  Outcome outcome;
  for (const double load : loads) {
    test.advance(load);
    const auto energies = test.body.energies();
    outcome.elastic.push_back(energies.elastic);
    outcome.dissipated.push_back(energies.dissipated);
    outcome.damage.push_back(damage_of(*comm, test.body));
    outcome.broken.push_back(test.body.counts().broken_bonds);
    if (outcome.elastic.size() == 1) outcome.first_iterations = test.body.counts().cg_iterations;
  }
  return outcome;
}

/// @param parts how many times the part is in the whole
void expect_part_of(const Outcome& whole, const Outcome& part, int parts) {
  EXPECT_EQ(part.broken.front(), 0);
  EXPECT_GT(part.broken.back(), 20);
  for (std::size_t i = 0; i < part.elastic.size(); ++i) {
    const double tolerance = round_off * (whole.elastic[i] + whole.dissipated[i]);
    EXPECT_NEAR(parts * part.elastic[i], whole.elastic[i], tolerance) << "load " << i;
    EXPECT_NEAR(parts * part.dissipated[i], whole.dissipated[i], tolerance) << "load " << i;
    for (const auto& [element, damage] : part.damage[i]) {
      ASSERT_NEAR(damage, whole.damage[i].at(element), 1e-9) << "element " << element << ", load " << i;
    }
  }
  EXPECT_LE(part.first_iterations, 1.2 * static_cast<double>(whole.first_iterations));
}

template <int dim>
SpecimenIn<dim> plain(mesh::Mesh<dim> whole, double horizon) {
  SpecimenIn<dim> specimen{std::move(whole), horizon, 0.3};
  specimen.seeds = {Zone<dim>::everything()};
  specimen.critical_stretch = 0.02;
  specimen.tolerance = 1e-11;
  return specimen;
}

// ---- a crack along the plane ----

/// The upper half of a plate, cracked on the plane from its left side on.
Specimen upper_half(bool triangles = false) {
  auto half = plain(grid({12, 6, 12., 6., Point2::Zero(), triangles ? 0. : 0.1, triangles}), 2.5);
  cut_set(half.whole, "bottom", 0, 4., "ligament");
  half.seeds = {Zone<2>::ball(Point2(4., 0.), 5., 7.)};
  half.displacements = {{"pull", "top", 1, {0.1, 0.}}, {"hold", "top", 0, {0., 0.}}};
  half.symmetry_planes = {"ligament"};
  return half;
}

Specimen whole_of(Specimen half) {
  half.whole = doubled(half.whole, 1, "ligament");
  half.displacements = {{"pull", "top", 1, {0.1, 0.}},
                        {"pull down", "y-image of top", 1, {-0.1, 0.}},
                        {"hold", "y-both of top", 0, {0., 0.}}};
  half.symmetry_planes = {};
  return half;
}

void expect_half_is_whole(const Specimen& half, const std::vector<double>& loads) {
  expect_part_of(pulled(whole_of(half), loads), pulled(half, loads), 2);
}

TEST(CrackOnThePlane, RunsAsInTheWholePlate) { expect_half_is_whole(upper_half(), {0.5, 0.7, 1.}); }

TEST(CrackOnThePlane, RunsAsInTheWholePlateOfTriangles) { expect_half_is_whole(upper_half(true), {0.5, 0.7, 1.}); }

TEST(CrackOnThePlane, RunsAsInTheWholePlateWithDilatation) {
  auto half = upper_half();
  half.poissons_ratio = 0.2;
  expect_half_is_whole(half, {0.5, 0.7, 1.});
}

TEST(CrackOnThePlane, RunsAsInTheWholePlateWhereBondsSoften) {
  auto half = upper_half();
  half.law = materials::BondLaw::softening(materials::Softening::bilinear, 0.01, 3e-4);
  expect_half_is_whole(half, {0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1., 1.2, 1.4});
}

// ---- a crack away from the plane ----

TEST(CrackAwayFromThePlane, RunsToBothSides) {
  auto half = plain(grid({9, 10, 9., 10., Point2::Zero(), 0.1}), 2.5);
  half.pre_cracks = {{Point2(0., 5.1), Point2(3., 5.1)}};
  half.displacements = {
      {"pull", "top", 1, {0.1, 0.}}, {"hold y", "bottom", 1, {0., 0.}}, {"hold x", "top", 0, {0., 0.}}};
  half.symmetry_planes = {"left"};
  auto whole = half;
  whole.whole = doubled(half.whole, 0, "left");
  whole.pre_cracks.push_back({Point2(0., 5.1), Point2(-3., 5.1)});
  for (auto& one : whole.displacements) one.node_set = "x-both of " + one.node_set;
  whole.symmetry_planes = {};

  expect_part_of(pulled(whole, {0.7, 1., 1.4}), pulled(half, {0.7, 1., 1.4}), 2);
}

// ---- several planes ----

TEST(QuarterOfAPlate, CracksAsTheWholeDoes) {
  auto quarter = plain(grid({9, 7, 9., 7., Point2::Zero(), 0.1}), 2.5);
  cut_set(quarter.whole, "bottom", 0, 3., "ligament");
  quarter.displacements = {{"pull", "top", 1, {0.1, 0.}}, {"hold", "top", 0, {0., 0.}}};
  quarter.symmetry_planes = {"ligament", "left"};
  auto whole = quarter;
  whole.whole = doubled(doubled(quarter.whole, 1, "ligament"), 0, "y-both of left");
  whole.displacements = {{"pull", "x-both of top", 1, {0.1, 0.}},
                         {"pull down", "x-both of y-image of top", 1, {-0.1, 0.}},
                         {"hold", "x-both of y-both of top", 0, {0., 0.}}};
  whole.symmetry_planes = {};

  expect_part_of(pulled(whole, {0.5, 0.8, 1.}), pulled(quarter, {0.5, 0.8, 1.}), 4);
}

TEST(EighthOfABlock, CracksAsTheWholeDoes) {
  auto eighth = plain(brick({4, 3, 3, 0.1}), 1.5);
  cut_set(eighth.whole, "bottom", 0, 2., "ligament");
  eighth.displacements = {
      {"pull", "top", 1, {0.1, 0.}}, {"hold x", "top", 0, {0., 0.}}, {"hold z", "top", 2, {0., 0.}}};
  eighth.symmetry_planes = {"ligament", "left", "back"};
  auto whole = eighth;
  whole.whole =
      doubled(doubled(doubled(eighth.whole, 1, "ligament"), 0, "y-both of left"), 2, "x-both of y-both of back");
  whole.displacements = {{"pull", "z-both of x-both of top", 1, {0.1, 0.}},
                         {"pull down", "z-both of x-both of y-image of top", 1, {-0.1, 0.}},
                         {"hold x", "z-both of x-both of y-both of top", 0, {0., 0.}},
                         {"hold z", "z-both of x-both of y-both of top", 2, {0., 0.}}};
  whole.symmetry_planes = {};

  expect_part_of(pulled(whole, {0.3, 0.5, 0.6}), pulled(eighth, {0.3, 0.5, 0.6}), 8);
}

// ---- without breaking ----

TEST(HeatedHalf, ExpandsAsTheWholeDoes) {
  auto half = upper_half();
  half.critical_stretch = std::numeric_limits<double>::infinity();
  half.poissons_ratio = 0.25;
  half.thermal_expansion = 1e-3;
  half.temperature_changes = {{{10., 0.}, {}, {}}};
  const auto whole = pulled(whole_of(half), {1.}), part = pulled(half, {1.});
  EXPECT_GT(whole.elastic[0], 0.);
  EXPECT_NEAR(2. * part.elastic[0], whole.elastic[0], round_off * whole.elastic[0]);
}

TEST(SymmetryPlane, IsAMistakeWhereItIsNone) {
  const auto comm = Tpetra::getDefaultComm();
  auto specimen = upper_half();
  const auto refused = [&](const std::string& group) {
    specimen.symmetry_planes = {group};
    EXPECT_THROW(SpecimenBody{specimen}, base::UserError) << group;
  };
  refused("boundary");
  for (const int n : specimen.whole.node_sets.at("all")) {
    if (n % 13 == 4) specimen.whole.node_sets["inside"].push_back(n);
  }
  for (const int n : specimen.whole.node_sets.at("inside")) specimen.whole.coordinates[n][0] = 4.;
  refused("inside");
  specimen.whole.node_sets["point"] = {0};
  refused("point");
}

}  // namespace
}  // namespace perimorph::tests
