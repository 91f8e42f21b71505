// The bonds that cracks in the undeformed body keep from being.

#include "perimorph/bonds/bonds_across_faces.hpp"

#include <gtest/gtest.h>

#include <set>

#include "bonded_body.hpp"

namespace perimorph::tests {
namespace {

using Ends = std::set<std::pair<GlobalId, GlobalId>>;
constexpr double horizon = 2.3;

/// The mesh with a slit may be parted among the ranks in another way.
Ends of_all_ranks(const Ends& own) {
  std::vector<GlobalId> numbers;
  for (const auto& [first, second] : own) numbers.insert(numbers.end(), {first, second});
  const auto all = base::gather_on_all(*Tpetra::getDefaultComm(), numbers);
  Ends ends;
  for (std::size_t i = 0; i < all.size(); i += 2) ends.insert({all[i], all[i + 1]});
  return ends;
}

/// Those of all pairs of elements.
Ends ends_of_all(const mesh::Mesh<2>& whole, const std::vector<Segment>& cracks) {
  BondedBody body(whole, horizon, 0.6, cracks);
  body.grow({Zone<2>::everything()});
  Ends ends;
  body.for_each_bond([&](int pair, std::size_t b) { ends.insert(body.global_ends(pair, b)); });
  return of_all_ranks(ends);
}

Ends ends_across(const mesh::Mesh<2>& whole, const std::vector<Segment>& cracks) {
  const BondedBody body(whole, horizon, 0.6, cracks);
  Ends ends;
  for (const auto& bond : bonds::bonds_across_faces<2>(body.mesh, body.points, mesh::active_elements(body.mesh),
                                                       horizon, body.pre_cracks)) {
    EXPECT_TRUE(bond.is_broken);
    EXPECT_EQ(bond.xi, body.points.position(bond.second_point) - body.points.position(bond.first_point));
    ends.insert({body.points.global_id(bond.first_element, bond.first_end),
                 body.points.global_id(bond.second_element, bond.second_end)});
  }
  return of_all_ranks(ends);
}

void expect_what_is_missing(const mesh::Mesh<2>& closed, const mesh::Mesh<2>& open,
                            const std::vector<Segment>& cracks) {
  Ends missing;
  const auto there = ends_of_all(open, cracks);
  for (const auto& ends : ends_of_all(closed, {})) {
    if (there.count(ends) == 0) missing.insert(ends);
  }
  EXPECT_EQ(ends_across(open, cracks), missing);
  EXPECT_GT(missing.size(), 100u);
}

TEST(BondsAcrossFaces, AreThoseThatAPreCrackThroughElementsTakesAway) {
  const auto plate = grid({9, 7, 9., 7., Point2::Zero(), 0.1});
  expect_what_is_missing(plate, plate, {{Point2(2.2, 1.7), Point2(5.3, 4.1)}, {Point2(5.3, 4.1), Point2(6.4, 4.3)}});
}

TEST(BondsAcrossFaces, AreThoseThatASlitInTheMeshTakesAway) {
  const auto plate = grid({9, 7, 9., 7.});
  const std::vector<Segment> slit = {{Point2(-1., 3.), Point2(5., 3.)}};
  auto open = plate;
  mesh::open_along<2>(open, slit);
  expect_what_is_missing(plate, open, {});
  expect_what_is_missing(plate, open, slit);
}

TEST(BondsAcrossFaces, AreNoneAcrossASlotThatHasAWidth) {
  const std::vector<Segment> slit = {{Point2(-1., 3.), Point2(5., 3.)}};
  auto slot = grid({9, 7, 9., 7.});
  mesh::open_along<2>(slot, slit);
  for (const auto& side : slot.boundary) {
    const double height = mesh::centroid(slot, side.element)[1] - 3.;
    for (int k = 0; k < slot.n_corners(side.element); ++k) {
      Point2& x = slot.coordinates[slot.corners_of(side.element)[k]];
      if (x[1] == 3. && x[0] < 5.) x[1] += height > 0. ? 0.1 : -0.1;
    }
  }
  EXPECT_EQ(ends_across(slot, {}), Ends());
}

}  // namespace
}  // namespace perimorph::tests
