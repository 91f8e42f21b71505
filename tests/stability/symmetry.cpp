// What must not matter: units, which way is up, how the mesh is numbered and parted. The bonds that break are the same.

#include <gmock/gmock.h>

#include <Eigen/LU>
#include <array>

#include "watched_run.hpp"

namespace perimorph::tests {
namespace {

/// A plate with an oblique load and an irregular mesh, so that nothing breaks at the same stretch as anything else.
struct Plate {
  mesh::Mesh<2> whole = grid({16, 12, 16., 12., Point2::Zero(), 0.1});
  std::vector<mesh::CrackFacet<2>> slit = {{Point2(0., 6.3), Point2(6.2, 5.8)}};
  Point2 tip{6.2, 5.8}, mouth{0., 6.};
  Point2 load{0.2, 1.};  ///< displacement of the upper edge for a load factor of 1
  double length = 1.;    ///< unit
  double youngs_modulus = 1000.;
  std::vector<double> costs = {};  ///< of elements, by which they are parted among the ranks
  /// Where a point of this plate lies in the first one.
  std::function<Point2(const Point2&)> back = [](const Point2& x) { return x; };
};

Specimen specimen_of(const Plate& plate) {
  Specimen specimen{plate.whole, 2.5 * plate.length, 0.25 * plate.length};
  specimen.pre_cracks = plate.slit;
  specimen.seeds = {Zone<2>::box(plate.tip.cwiseMin(plate.mouth), plate.tip.cwiseMax(plate.mouth), 2. * plate.length)};
  specimen.seeds[0].inner_radius = 5. * plate.length;
  specimen.critical_stretch = 0.03;
  specimen.youngs_modulus = plate.youngs_modulus;
  specimen.costs = plate.costs;
  for (int c = 0; c < 2; ++c) {
    specimen.displacements.push_back({"hold", "bottom", c, {0., 0.}});
    specimen.displacements.push_back({"pull", "top", c, {plate.load[c], 0.}});
  }
  return specimen;
}

using Ends = std::array<long, 4>;

/// Broken bonds by the places of their ends in the first plate, to a millionth of an element; on rank 0.
std::vector<Ends> broken_bonds(const WatchedRun& run, const Plate& plate) {
  const auto model = run.body().model();
  const auto end = [&](const Point2& x) {
    const Point2 y = plate.back(x) * 1e6;
    return std::array<long, 2>{std::lround(y[0]), std::lround(y[1])};
  };
  std::vector<Ends> own;
  for (int p = 0; p < model.bonds.n_pairs(); ++p) {
    const auto [first, second] = model.bonds.pair(p);
    if (first >= run.body().mesh().n_owned_elements) continue;
    for (auto b = model.bonds.first_bond(p); b < model.bonds.first_bond(p + 1); ++b) {
      if (!model.bonds.broken(b)) continue;
      auto a = end(model.points.position(model.points.first(first) + model.bonds.first_end(b)));
      auto c = end(model.points.position(model.points.first(second) + model.bonds.second_end(b)));
      if (c < a) std::swap(a, c);
      own.push_back({a[0], a[1], c[0], c[1]});
    }
  }
  auto all = base::gather_on_root(run.comm(), own);
  std::sort(all.begin(), all.end());
  return all;
}

/// Runs both into the plate's failure; the broken bonds are the same after every increment.
void expect_same_crack(const Plate& plate) {
  const Plate first;
  WatchedRun run(specimen_of(plate), "top", 1), other(specimen_of(first), "top", 1);
  for (const double load : {0.05, 0.15, 0.2, 0.25}) {
    run.advance(load);
    other.advance(load);
    EXPECT_EQ(run.rows.back().broken, other.rows.back().broken) << "load factor " << load;
    EXPECT_EQ(broken_bonds(run, plate), broken_bonds(other, first)) << "load factor " << load;
  }
  EXPECT_EQ(run.rows.front().broken, 0);
  EXPECT_GT(run.rows.back().broken, 50);
}

/// The plate moved by a linear map that keeps lengths up to the unit.
Plate moved(const Eigen::Matrix2d& map, double length) {
  Plate plate;
  const auto move = [&](const Point2& x) -> Point2 { return map * x; };
  for (auto& x : plate.whole.coordinates) x = move(x);
  for (auto& facet : plate.slit) facet = {move(facet[0]), move(facet[1])};
  plate.tip = move(plate.tip);
  plate.mouth = move(plate.mouth);
  plate.load = move(plate.load);
  plate.length = length;
  const Eigen::Matrix2d inverse = map.inverse();
  plate.back = [inverse](const Point2& x) -> Point2 { return inverse * x; };
  return plate;
}

/// A mirrored mesh's elements would be inside out.
void turn_elements(mesh::Mesh<2>& whole) {
  for (int e = 0; e < whole.n_elements(); ++e) {
    std::reverse(whole.corners.begin() + whole.first_corner[e] + 1, whole.corners.begin() + whole.first_corner[e + 1]);
  }
  whole.side_sets.clear();  // their numbers have changed
  whole.boundary.clear();
  mesh::find_boundary(whole);
}

TEST(Symmetry, MillimetresAndMetresGiveTheSameBrokenBonds) {
  Plate plate = moved(1e-3 * Eigen::Matrix2d::Identity(), 1e-3);
  plate.youngs_modulus *= 1e6;
  expect_same_crack(plate);
}

TEST(Symmetry, AMirroredPlateGivesTheMirroredCrack) {
  Eigen::Matrix2d mirror;
  mirror << -1., 0., 0., 1.;
  Plate plate = moved(mirror, 1.);
  turn_elements(plate.whole);
  expect_same_crack(plate);
}

TEST(Symmetry, APlateTurnedByNinetyDegreesGivesTheTurnedCrack) {
  Eigen::Matrix2d turn;
  turn << 0., -1., 1., 0.;
  expect_same_crack(moved(turn, 1.));
}

TEST(Symmetry, AMeshNumberedBackwardsGivesTheSameCrack) {
  Plate plate;
  auto& whole = plate.whole;
  const int last_node = whole.n_nodes() - 1;
  std::reverse(whole.coordinates.begin(), whole.coordinates.end());
  for (int& corner : whole.corners) corner = last_node - corner;
  std::vector<int> corners;
  for (int e = whole.n_elements() - 1; e >= 0; --e) {
    corners.insert(corners.end(), whole.corners_of(e), whole.corners_of(e) + whole.n_corners(e));
  }
  whole.corners = corners;  // all elements have as many
  for (auto& [name, nodes] : whole.node_sets) {
    for (int& node : nodes) node = last_node - node;
    std::sort(nodes.begin(), nodes.end());
  }
  whole.side_sets.clear();
  whole.boundary.clear();
  mesh::find_boundary(whole);
  expect_same_crack(plate);
}

TEST(Symmetry, APlatePartedOtherwiseGivesTheSameCrack) {
  Plate plate;
  for (int e = 0; e < plate.whole.n_elements(); ++e)
    plate.costs.push_back(1. + 0.2 * e);  // the lowest elements are cheap
  const auto comm = Tpetra::getDefaultComm();
  const SpecimenBody equal(specimen_of(Plate())), uneven(specimen_of(plate));
  const auto n_moved =
      base::sum(*comm, static_cast<base::GlobalId>(equal.mesh.n_owned_elements != uneven.mesh.n_owned_elements));
  EXPECT_EQ(n_moved > 0, comm->getSize() > 1);
  expect_same_crack(plate);
}

}  // namespace
}  // namespace perimorph::tests
