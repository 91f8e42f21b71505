#include "perimorph/mesh/distribute.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>
#include <algorithm>
#include <set>

#include "example_meshes.hpp"
#include "perimorph/base/errors.hpp"
#include "perimorph/mesh/fingerprint.hpp"
#include "perimorph/mesh/images.hpp"
#include "perimorph/mesh/parts.hpp"
#include "perimorph/mesh/pre_crack.hpp"

namespace perimorph::mesh {
namespace {

constexpr double horizon = 1.7;

/// What all ranks know of one element or node of the whole mesh once their parts are gathered.
struct Copy {
  GlobalId id;
  int owner;
  int holder;
};

template <int dim>
std::array<int, dim> many_cells() {
  std::array<int, dim> n;
  n.fill(dim == 2 ? 12 : 6);
  n[0] += 3;
  return n;
}

template <int dim>
struct Parted {
  Teuchos::RCP<const base::Comm> comm = Tpetra::getDefaultComm();
  Mesh<dim> whole;  // on every rank, to compare with
  Mesh<dim> part;

  explicit Parted(const std::array<int, dim>& cells, const std::vector<double>& weights = {}) {
    whole = grid<dim>(cells);
    perturb(whole);
    part = distribute(*comm, comm->getRank() == 0 ? whole : Mesh<dim>(), horizon,
                      comm->getRank() == 0 ? weights : std::vector<double>());
  }

  std::vector<Copy> all_elements() const { return gathered(part.element_ids, part.element_owners); }
  std::vector<Copy> all_nodes() const { return gathered(part.node_ids, part.node_owners); }

  std::vector<Copy> gathered(const std::vector<GlobalId>& ids, const std::vector<int>& owners) const {
    std::vector<Copy> mine;
    for (std::size_t i = 0; i < ids.size(); ++i) mine.push_back({ids[i], owners[i], part.rank});
    return base::gather_on_all(*comm, mine);
  }

  /// Owner of each element of the whole.
  std::vector<int> element_owners() const {
    std::vector<int> owners(whole.n_elements(), -1);
    for (const Copy& copy : all_elements()) {
      if (copy.owner == copy.holder) owners[copy.id] = copy.owner;
    }
    return owners;
  }
};

/// The lowest rank that owns an element around each node of the whole.
template <int dim>
std::vector<int> lowest_owners(const Mesh<dim>& whole, const std::vector<int>& element_owners) {
  std::vector<int> lowest(whole.n_nodes(), 1000);
  for (int e = 0; e < whole.n_elements(); ++e) {
    for (int c = 0; c < whole.n_corners(e); ++c) {
      int& owner = lowest[whole.corners_of(e)[c]];
      owner = std::min(owner, element_owners[e]);
    }
  }
  return lowest;
}

template <int dim>
std::set<GlobalId> active_by_definition(const Mesh<dim>& whole, const std::vector<int>& element_owners, int rank) {
  const std::vector<int> node_owners = lowest_owners(whole, element_owners);
  std::set<GlobalId> active;
  for (int e = 0; e < whole.n_elements(); ++e) {
    if (element_owners[e] == rank) active.insert(e);
    for (int c = 0; c < whole.n_corners(e); ++c) {
      if (node_owners[whole.corners_of(e)[c]] == rank) active.insert(e);
    }
  }
  return active;
}

/// Every element against every active one.
template <int dim>
std::set<GlobalId> needed_by_definition(const Mesh<dim>& whole, const std::set<GlobalId>& active) {
  std::set<GlobalId> needed = active;
  for (int e = 0; e < whole.n_elements(); ++e) {
    for (const GlobalId id : active) {
      const int a = static_cast<int>(id);
      const double distance = (centroid(whole, e) - centroid(whole, a)).norm();
      if (distance <= horizon + radius(whole, e) + radius(whole, a)) needed.insert(e);
    }
  }
  return needed;
}

template <class Dimension>
class Distribute : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Distribute, Dimensions);

TYPED_TEST(Distribute, EveryElementIsOwnedOnceAndAllCopiesAgreeOnTheOwner) {
  const Parted<TypeParam::value> parted(many_cells<TypeParam::value>());
  const std::vector<int> owners = parted.element_owners();

  EXPECT_EQ(base::sum(*parted.comm, GlobalId{parted.part.n_owned_elements}), parted.whole.n_elements());
  EXPECT_THAT(owners, testing::Not(testing::Contains(-1)));
  for (const Copy& copy : parted.all_elements()) EXPECT_EQ(copy.owner, owners[copy.id]);
}

TYPED_TEST(Distribute, EveryNodeIsOwnedByTheLowestRankAroundIt) {
  const Parted<TypeParam::value> parted(many_cells<TypeParam::value>());
  const std::vector<int> expected = lowest_owners(parted.whole, parted.element_owners());

  EXPECT_EQ(base::sum(*parted.comm, GlobalId{parted.part.n_owned_nodes}), parted.whole.n_nodes());
  for (const Copy& copy : parted.all_nodes()) EXPECT_EQ(copy.owner, expected[copy.id]);
}

TYPED_TEST(Distribute, AnOwnedNodeHasAllItsElements) {
  const Parted<TypeParam::value> parted(many_cells<TypeParam::value>());
  const auto count = [](const auto& mesh) {
    std::vector<int> n_around(mesh.n_nodes(), 0);
    for (const int node : mesh.corners) ++n_around[node];
    return n_around;
  };

  const std::vector<int> here = count(parted.part), everywhere = count(parted.whole);
  for (int n = 0; n < parted.part.n_owned_nodes; ++n) EXPECT_EQ(here[n], everywhere[parted.part.node_ids[n]]);
}

TYPED_TEST(Distribute, TheHaloIsWhatMayLieWithinAHorizonOfAnActiveElement) {
  const Parted<TypeParam::value> parted(many_cells<TypeParam::value>());
  const auto active = active_by_definition(parted.whole, parted.element_owners(), parted.part.rank);

  const std::set<GlobalId> held(parted.part.element_ids.begin(), parted.part.element_ids.end());

  EXPECT_EQ(held, needed_by_definition(parted.whole, active));
}

TYPED_TEST(Distribute, ActiveElementsAreTheOwnedOnesAndThoseAroundOwnedNodes) {
  const Parted<TypeParam::value> parted(many_cells<TypeParam::value>());

  std::set<GlobalId> active;
  const std::vector<char> is_active = active_elements(parted.part);
  for (int e = 0; e < parted.part.n_elements(); ++e) {
    if (is_active[e]) active.insert(parted.part.element_ids[e]);
  }

  EXPECT_EQ(active, active_by_definition(parted.whole, parted.element_owners(), parted.part.rank));
}

TYPED_TEST(Distribute, OwnedComeFirstAndAllIsByAscendingId) {
  const auto part = Parted<TypeParam::value>(many_cells<TypeParam::value>()).part;
  const auto check = [&](const std::vector<GlobalId>& ids, const std::vector<int>& owners, int n_owned) {
    for (int i = 0; i < static_cast<int>(ids.size()); ++i) EXPECT_EQ(owners[i] == part.rank, i < n_owned);
    EXPECT_TRUE(std::is_sorted(ids.begin(), ids.begin() + n_owned));
    EXPECT_TRUE(std::is_sorted(ids.begin() + n_owned, ids.end()));
  };

  check(part.element_ids, part.element_owners, part.n_owned_elements);
  check(part.node_ids, part.node_owners, part.n_owned_nodes);
}

TYPED_TEST(Distribute, EachPartIsTheWholeRestricted) {
  const Parted<TypeParam::value> parted(many_cells<TypeParam::value>());
  const auto &part = parted.part, &whole = parted.whole;

  EXPECT_EQ(part.rank, parted.comm->getRank());
  EXPECT_EQ(part.n_global_nodes, whole.n_nodes());
  EXPECT_EQ(part.n_global_elements, whole.n_elements());
  EXPECT_EQ(part.block_names, whole.block_names);
  for (int n = 0; n < part.n_nodes(); ++n) EXPECT_EQ(part.coordinates[n], whole.coordinates[part.node_ids[n]]);
  for (int e = 0; e < part.n_elements(); ++e) {
    const int id = static_cast<int>(part.element_ids[e]);
    EXPECT_EQ(part.types[e], whole.types[id]);
    EXPECT_EQ(part.blocks[e], whole.blocks[id]);
    ASSERT_EQ(part.n_corners(e), whole.n_corners(id));
    for (int c = 0; c < part.n_corners(e); ++c) {
      EXPECT_EQ(part.node_ids[part.corners_of(e)[c]], whole.corners_of(id)[c]);
    }
  }
}

using SideIds = std::set<std::pair<GlobalId, int>>;

template <int dim>
SideIds ids_of(const Mesh<dim>& mesh, const std::vector<Side>& some) {
  SideIds ids;
  for (const Side& side : some) ids.insert({mesh.element_ids[side.element], side.side});
  return ids;
}

/// The sides of the whole whose element a part holds.
template <int dim>
SideIds held_sides(const Mesh<dim>& part, const Mesh<dim>& whole, const std::vector<Side>& some) {
  const std::set<GlobalId> held(part.element_ids.begin(), part.element_ids.end());
  SideIds kept;
  for (const auto& id : ids_of(whole, some)) {
    if (held.count(id.first) == 1) kept.insert(id);
  }
  return kept;
}

TYPED_TEST(Distribute, TheBoundaryIsTheBodysAndNotTheHalosRim) {
  const Parted<TypeParam::value> parted(many_cells<TypeParam::value>());
  const auto &part = parted.part, &whole = parted.whole;
  EXPECT_EQ(ids_of(part, part.boundary), held_sides(part, whole, whole.boundary));
}

TYPED_TEST(Distribute, SetsAreRestrictedAndTheirNamesKnownEverywhere) {
  const Parted<TypeParam::value> parted(many_cells<TypeParam::value>());
  const auto &part = parted.part, &whole = parted.whole;

  ASSERT_EQ(part.node_sets.size(), whole.node_sets.size());
  ASSERT_EQ(part.side_sets.size(), whole.side_sets.size());
  for (const auto& [name, nodes] : whole.node_sets) {
    std::vector<int> expected;
    for (int n = 0; n < part.n_nodes(); ++n) {
      if (std::count(nodes.begin(), nodes.end(), part.node_ids[n]) == 1) expected.push_back(n);
    }
    EXPECT_EQ(part.node_sets.at(name), expected) << name;
  }
  for (const auto& [name, set] : whole.side_sets) {
    EXPECT_EQ(ids_of(part, part.side_sets.at(name)), held_sides(part, whole, set)) << name;
  }
}

TYPED_TEST(Distribute, TheSameMeshIsAlwaysPartedInTheSameWay) {
  const Parted<TypeParam::value> first(many_cells<TypeParam::value>()), second(many_cells<TypeParam::value>());

  EXPECT_EQ(first.part.element_ids, second.part.element_ids);
  EXPECT_EQ(first.part.element_owners, second.part.element_owners);
}

template <int dim>
void expect_same_part(const Mesh<dim>& one, const Mesh<dim>& other) {
  expect_same(one, other, std::numeric_limits<double>::min());
  EXPECT_EQ(one.rank, other.rank);
  EXPECT_EQ(one.node_ids, other.node_ids);
  EXPECT_EQ(one.node_owners, other.node_owners);
  EXPECT_EQ(one.element_ids, other.element_ids);
  EXPECT_EQ(one.element_owners, other.element_owners);
  EXPECT_EQ(one.n_owned_nodes, other.n_owned_nodes);
  EXPECT_EQ(one.n_owned_elements, other.n_owned_elements);
  EXPECT_EQ(one.n_global_nodes, other.n_global_nodes);
  EXPECT_EQ(one.n_global_elements, other.n_global_elements);
}

TYPED_TEST(Distribute, PartsArePartedAsTheWhole) {
  constexpr int dim = TypeParam::value;
  const auto costs = [](const Mesh<dim>& part) {
    std::vector<double> weights;
    for (int e = 0; e < part.n_owned_elements; ++e) weights.push_back(part.blocks[e] == 0 ? 20. : 1.);
    return weights;
  };
  const Parted<dim> plain(many_cells<dim>());
  const Parted<dim> expected(many_cells<dim>(), costs(plain.whole));

  const auto again = distribute(*plain.comm, plain.part, horizon, costs(plain.part));

  expect_same_part(again, expected.part);
  expect_same_part(distribute(*plain.comm, again, horizon), plain.part);
}

TYPED_TEST(Distribute, WhatOneRankKnowsOfANodeAllRanksLearn) {
  constexpr int dim = TypeParam::value;
  const Parted<dim> parted(many_cells<dim>());
  auto part = parted.part;
  for (auto& [name, nodes] : part.node_sets) {
    nodes.erase(std::lower_bound(nodes.begin(), nodes.end(), part.n_owned_nodes), nodes.end());
  }

  expect_same_part(distribute(*parted.comm, part, horizon), parted.part);
}

TYPED_TEST(Distribute, ImagesLeaveNoTrace) {
  constexpr int dim = TypeParam::value;
  const Parted<dim> parted(many_cells<dim>());
  auto part = parted.part;
  SymmetryPlane plane{0, 0., {}};
  for (int n = 0; n < part.n_nodes(); ++n) {
    if (part.node_ids[n] % 7 == 0) plane.nodes.push_back(n);
  }
  add_images(part, {plane}, 1e3);
  ASSERT_GE(part.n_elements(), 2 * parted.part.n_elements());

  expect_same_part(distribute(*parted.comm, part, horizon), parted.part);
}

TYPED_TEST(Distribute, GatheredPartsAreTheWhole) {
  constexpr int dim = TypeParam::value;
  const Parted<dim> parted(many_cells<dim>());

  for (const auto& part : {parted.part, parted.whole}) {
    const auto again = gather(*parted.comm, part);
    if (parted.comm->getRank() == 0) {
      expect_same_part(again, parted.whole);
    } else {
      EXPECT_EQ(again.n_elements(), 0);
    }
  }
}

/// Straight through most of the grid between two rows of cells, or all of it.
template <int dim>
std::vector<CrackFacet<dim>> crack_through(const Mesh<dim>& whole, double share) {
  Point<dim> corner = whole.coordinates.front(), other = corner;
  for (const auto& x : whole.coordinates) {
    corner = corner.cwiseMin(x);
    other = other.cwiseMax(x);
  }
  constexpr int across = dim - 1;
  const auto& levels = whole.coordinates;
  const auto middle = std::min_element(levels.begin(), levels.end(), [&](const auto& a, const auto& b) {
    const double height = 0.5 * (corner[across] + other[across]);
    return std::abs(a[across] - height) < std::abs(b[across] - height);
  });
  corner[across] = other[across] = (*middle)[across];
  other[0] = corner[0] + share * (other[0] - corner[0]);
  if constexpr (dim == 2) return polyline({corner, other});
  if constexpr (dim == 3) {
    const Point<3> second(other[0], corner[1], corner[2]), fourth(corner[0], other[1], corner[2]);
    return polygon({corner, second, other, fourth});
  }
}

/// A regular grid in parts, and the same grid opened as a whole.
template <int dim>
struct Opened {
  Teuchos::RCP<const base::Comm> comm = Tpetra::getDefaultComm();
  Mesh<dim> whole = grid<dim>(many_cells<dim>());
  Mesh<dim> part = distribute(*comm, whole, 0.);
  int n_open_of_whole;
  GlobalId n_open;

  explicit Opened(double share) {
    const auto crack = crack_through(whole, share);
    n_open_of_whole = open_along<dim>(whole, crack);
    n_open = open_along<dim>(*comm, part, crack);
  }
};

TYPED_TEST(Distribute, PartsAreOpenedAsTheWhole) {
  constexpr int dim = TypeParam::value;
  for (const double share : {0.6, 1.}) {
    const Opened<dim> opened(share);
    ASSERT_GT(opened.n_open_of_whole, 0);
    EXPECT_EQ(opened.n_open, opened.n_open_of_whole);
    expect_same_part(distribute(*opened.comm, opened.part, horizon), distribute(*opened.comm, opened.whole, horizon));
  }
}

TYPED_TEST(Distribute, AFingerprintDoesNotDependOnWhoHasWhat) {
  constexpr int dim = TypeParam::value;
  const Opened<dim> opened(0.6), closed(0.);
  const auto fingerprint_of = [&](const Mesh<dim>& part) { return fingerprint(*opened.comm, part); };

  EXPECT_EQ(fingerprint_of(opened.part), fingerprint_of(opened.whole));
  EXPECT_EQ(fingerprint_of(closed.part), fingerprint_of(closed.whole));
  EXPECT_NE(fingerprint_of(opened.whole), fingerprint_of(closed.whole));
  auto moved = closed.whole, renamed = closed.whole, in_no_set = closed.whole, with_fewer_sides = closed.whole;
  moved.coordinates[3][0] += 1e-9;
  renamed.block_names[0] += "'";
  in_no_set.node_sets.begin()->second.pop_back();
  with_fewer_sides.side_sets.begin()->second.pop_back();
  for (const auto& other : {moved, renamed, in_no_set, with_fewer_sides}) {
    EXPECT_NE(fingerprint_of(other), fingerprint_of(closed.whole));
  }
}

TYPED_TEST(Distribute, PartsOfTheBodyAreCountedWhicheverRanksTheyAreOn) {
  constexpr int dim = TypeParam::value;
  for (const double share : {0., 0.6, 1.}) {
    const Opened<dim> opened(share);
    for (const auto& part : {opened.whole, distribute(*opened.comm, opened.part, 0.)}) {
      const auto [n_parts, n_hinges] = connections(*opened.comm, part);
      EXPECT_EQ(n_parts, share == 1. ? 2 : 1);
      EXPECT_EQ(n_hinges, 0);
    }
  }
}

/// Two blocks of cells that share one node, or in three dimensions the nodes of an edge.
template <int dim>
Mesh<dim> diagonal_blocks() {
  const Mesh<dim> all = grid<dim>(many_cells<dim>());
  Point<dim> middle = Point<dim>::Zero();
  for (const auto& x : all.coordinates) middle += x / all.n_nodes();
  const auto node = std::min_element(all.coordinates.begin(), all.coordinates.end(), [&](const auto& a, const auto& b) {
    return (a - middle).norm() < (b - middle).norm();
  });
  Mesh<dim> some = all;
  some.types.clear();
  some.blocks.clear();
  some.corners.clear();
  some.first_corner = {0};
  for (int e = 0; e < all.n_elements(); ++e) {
    const Point<dim> from = centroid(all, e) - *node;
    if ((from[0] > 0.) != (from[1] > 0.)) continue;
    some.types.push_back(all.types[e]);
    some.blocks.push_back(all.blocks[e]);
    some.corners.insert(some.corners.end(), all.corners_of(e), all.corners_of(e) + all.n_corners(e));
    some.first_corner.push_back(static_cast<int>(some.corners.size()));
  }
  some.n_owned_elements = some.n_elements();
  some.n_global_elements = some.n_elements();
  some.element_ids.resize(some.n_elements());
  some.element_owners.resize(some.n_elements());
  for (auto& entry : some.side_sets) entry.second.clear();
  find_boundary(some);
  return some;
}

TYPED_TEST(Distribute, HingesAreCountedAndConnectNothing) {
  constexpr int dim = TypeParam::value;
  const auto comm = Tpetra::getDefaultComm();
  const auto whole = diagonal_blocks<dim>();
  const auto n_hinges = static_cast<GlobalId>(hinges(whole).size());
  ASSERT_EQ(n_hinges, dim == 2 ? 1 : 7);
  for (const auto& part : {whole, distribute(*comm, whole, 0.)}) {
    const auto found = connections(*comm, part);
    EXPECT_EQ(found.n_parts, 2);
    EXPECT_EQ(found.n_hinges, n_hinges);
  }
}

TYPED_TEST(Distribute, EqualCostsGiveEqualParts) {
  const Parted<TypeParam::value> parted(many_cells<TypeParam::value>());
  const double ideal = static_cast<double>(parted.whole.n_elements()) / parted.comm->getSize();

  EXPECT_NEAR(parted.part.n_owned_elements, ideal, 0.06 * ideal + 1.);
}

TYPED_TEST(Distribute, CostlyElementsAreSharedOut) {
  constexpr int dim = TypeParam::value;
  const Mesh<dim> whole = grid<dim>(many_cells<dim>());
  std::vector<double> weights;
  for (int e = 0; e < whole.n_elements(); ++e) weights.push_back(whole.blocks[e] == 0 ? 20. : 1.);

  const Parted<dim> parted(many_cells<dim>(), weights);

  double cost = 0.;
  for (int e = 0; e < parted.part.n_owned_elements; ++e) cost += weights[parted.part.element_ids[e]];
  const double ideal = std::accumulate(weights.begin(), weights.end(), 0.) / parted.comm->getSize();
  EXPECT_NEAR(cost, ideal, 0.15 * ideal);
}

TYPED_TEST(Distribute, FewerElementsThanRanksLeavesSomeRanksWithout) {
  constexpr int dim = TypeParam::value;
  std::array<int, dim> one_row;
  one_row.fill(1);
  for (const int n : {1, 2, 3}) {
    one_row[0] = n;
    const Parted<dim> parted(one_row);

    EXPECT_EQ(base::sum(*parted.comm, GlobalId{parted.part.n_owned_elements}), n);
    EXPECT_EQ(base::sum(*parted.comm, GlobalId{parted.part.n_owned_nodes}), parted.whole.n_nodes());
    EXPECT_EQ(parted.part.block_names, parted.whole.block_names);
    EXPECT_EQ(parted.part.first_corner.front(), 0);
    if (n <= parted.comm->getSize()) {
      EXPECT_LE(parted.part.n_owned_elements, 1);
    }
  }
}

TYPED_TEST(Distribute, AnErrorOnRankZeroReachesAllRanks) {
  constexpr int dim = TypeParam::value;
  const auto comm = Tpetra::getDefaultComm();
  const Mesh<dim> whole = grid<dim>(many_cells<dim>());

  EXPECT_THROW(distribute(*comm, whole, horizon, {1., 2.}), base::Bug);
  EXPECT_THROW(distribute(*comm, whole, std::nan("")), base::Bug);
  std::vector<double> weights(whole.n_elements(), 1.);
  weights[2] = -1.;
  EXPECT_THROW(distribute(*comm, whole, horizon, weights), base::Bug);
}

TYPED_TEST(Distribute, RefusesAMeshOfWhichTheListsDoNotFitEachOther) {
  constexpr int dim = TypeParam::value;
  const auto comm = Tpetra::getDefaultComm();
  const Mesh<dim> whole = grid<dim>(many_cells<dim>());
  Mesh<dim> without_an_owner = whole, without_a_node = whole, in_disorder = whole, in_no_block = whole;
  without_an_owner.element_owners.pop_back();
  --without_a_node.n_global_nodes;
  std::swap(in_disorder.element_ids[0], in_disorder.element_ids[1]);
  in_no_block.blocks[0] = 2;

  EXPECT_THROW(distribute(*comm, without_an_owner, horizon), base::Bug);
  EXPECT_THROW(distribute(*comm, without_a_node, horizon), base::Bug);
  ++without_a_node.n_global_elements;
  EXPECT_THROW(distribute(*comm, without_a_node, horizon), base::Bug);
  EXPECT_NO_THROW(check_consistency(whole));
#ifdef PERIMORPH_DEBUG_ASSERTIONS
  EXPECT_THROW(check_consistency(in_disorder), base::Bug);
  EXPECT_THROW(check_consistency(in_no_block), base::Bug);
#endif
}

}  // namespace
}  // namespace perimorph::mesh
