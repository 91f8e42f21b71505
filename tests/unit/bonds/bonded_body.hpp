#pragma once

// A mesh with material points and bonds, and the plain way to list its bonds, for the tests of this folder.

#include <Tpetra_Core.hpp>
#include <array>
#include <map>

#include "perimorph/bonds/bond_families.hpp"
#include "support/meshes.hpp"

namespace perimorph::tests {

using base::GlobalId;
using morphing::Zone;
using Segment = mesh::CrackFacet<2>;

/// The spring stiffness of every bond by the global ids of the points at its two ends, in the order of the bond.
using BondList = std::map<std::pair<GlobalId, GlobalId>, double>;

struct BondedBody {
  Teuchos::RCP<const base::Comm> comm = Tpetra::getDefaultComm();
  mesh::Mesh<2> whole;  ///< on all ranks, to compare with
  std::vector<Segment> pre_cracks;
  materials::Micromodulus c0;
  mesh::Mesh<2> mesh;
  elements::MaterialPoints<2> points;
  morphing::MorphingField<2> alpha;
  bonds::BondFamilies<2> bonds;

  /// tau0 = 100; without zones there are no bonds yet: grow() makes them.
  BondedBody(const mesh::Mesh<2>& whole_mesh, double horizon, double characteristic_length,
             std::vector<Segment> cracks = {}, const materials::BondLaw& law = {})
      : whole(whole_mesh),
        pre_cracks(std::move(cracks)),
        c0{100., characteristic_length, horizon},
        mesh(mesh::distribute(*comm, whole, horizon)),
        points(mesh),
        alpha(mesh, points, morphing::BlendingFunction::linear),
        bonds(mesh, points, mesh::active_elements(mesh), {c0, law}, pre_cracks) {}

  void grow(const std::vector<Zone<2>>& zones) { bonds.extend(alpha.add(zones)); }

  /// Returns the bonds that it breaks.
  std::vector<std::size_t> break_overstretched(const std::vector<Point2>& displacements,
                                               const std::vector<morphing::ElementClass>& classes) {
    const auto broken = bonds.overstretched(displacements, classes);
    bonds.take({broken});
    return broken;
  }

  std::pair<int, int> ends(int pair, std::size_t b) const {
    const auto [first, second] = bonds.pair(pair);
    return {points.first(first) + bonds.first_end(b), points.first(second) + bonds.second_end(b)};
  }
  std::pair<GlobalId, GlobalId> global_ends(int pair, std::size_t b) const {
    const auto [first, second] = bonds.pair(pair);
    return {points.global_id(first, bonds.first_end(b)), points.global_id(second, bonds.second_end(b))};
  }

  /// Calls function(pair, bond) for every bond.
  template <class Function>
  void for_each_bond(Function&& function) const {
    for (int p = 0; p < bonds.n_pairs(); ++p) {
      for (auto b = bonds.first_bond(p); b < bonds.first_bond(p + 1); ++b) function(p, b);
    }
  }

  BondList list() const {
    BondList all;
    for_each_bond([&](int p, std::size_t b) { all.emplace(global_ends(p, b), bonds.stiffness(bonds.bond(p, b))); });
    return all;
  }
};

/// Twice the signed area of a triangle.
inline double orientation(const Point2& a, const Point2& b, const Point2& c) {
  return (b - a)[0] * (c - a)[1] - (b - a)[1] * (c - a)[0];
}

/// Whether the segments a-b and c-d meet; touching counts. Coordinates are of order 1 to 10: an area below 1e-11 is
/// zero.
inline bool segments_meet(const Point2& a, const Point2& b, const Segment& s) {
  constexpr double zero = 1e-11;
  const auto apart = [](double one, double other) {
    return (one > zero && other > zero) || (one < -zero && other < -zero);
  };
  return !apart(orientation(a, b, s[0]), orientation(a, b, s[1])) &&
         !apart(orientation(s[0], s[1], a), orientation(s[0], s[1], b));
}

struct PlainPoint {
  GlobalId id;
  int element;
  Point2 x;
  double weight;
};

inline std::vector<PlainPoint> plain_points(const mesh::Mesh<2>& whole) {
  const elements::MaterialPoints<2> points(whole);
  std::vector<PlainPoint> all;
  for (int e = 0; e < whole.n_elements(); ++e) {
    for (int q = 0; q < points.count(e); ++q) {
      const int p = points.first(e) + q;
      all.push_back({points.global_id(e, q), e, points.position(p), points.weight(p)});
    }
  }
  return all;
}

/// Boundary sides and pre-cracks of the whole body.
inline std::vector<Segment> plain_obstacles(const BondedBody& body) {
  std::vector<Segment> obstacles = body.pre_cracks;
  for (const auto& side : body.whole.boundary) {
    const auto corners = mesh::corner_points(body.whole, side);
    obstacles.push_back({corners[0], corners[1]});
  }
  return obstacles;
}

/// All pairs of points of the whole body at most a horizon apart that see each other and of which is_wanted(element,
/// element) says that they count.
template <class Predicate>
BondList plain_bonds(const BondedBody& body, Predicate is_wanted) {
  const auto points = plain_points(body.whole);
  const auto obstacles = plain_obstacles(body);
  BondList all;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      const auto &x = points[i], &p = points[j];
      const double distance = (p.x - x.x).norm();
      if (distance > body.c0.horizon || !is_wanted(x.element, p.element)) continue;
      const bool is_cut = x.element != p.element && std::any_of(obstacles.begin(), obstacles.end(), [&](const auto& s) {
                            return segments_meet(x.x, p.x, s);
                          });
      if (is_cut) continue;
      const double c0 = body.c0.tau0 * std::exp(-distance / body.c0.characteristic_length);
      all.emplace(std::make_pair(x.id, p.id), c0 * x.weight * p.weight);
    }
  }
  return all;
}

}  // namespace perimorph::tests
