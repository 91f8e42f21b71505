// A state that is gathered and shared out again is the same, and in a checkpoint it stands as it always has.

#include "perimorph/output/state_transfer.hpp"

#include <gmock/gmock.h>

#include <Tpetra_Core.hpp>

#include "support/meshes.hpp"

namespace perimorph::tests {
namespace {

using base::GlobalId;
using discretization::SavedState;
using testing::ElementsAre;

/// What is alike on all ranks, with a different number in each place.
SavedState<2> history() {
  SavedState<2> state;
  state.load_factor = 1.5;
  state.load_step = 0.75;
  state.force_scale = 2.5;
  state.energies = {0., 3.5, 4.5, 5.5};
  state.counts.broken_bonds = 11;
  state.counts.damaged_elements = 12;
  state.counts.dgfe_elements = 13;
  state.counts.unknowns = 14;
  state.counts.linear_solves = 15;
  state.counts.cg_iterations = 16;
  state.counts.topologies = 17;
  state.break_calls = 18;
  state.break_calls_before_topology = 19;
  state.flag_points = {{21, 1, {0.25, 0.5}}, {22, 2, {0.75, 1.}}};
  return state;
}

double value(GlobalId element, int k) { return static_cast<double>(100 * element + k); }

/// With displacements of these elements that tell which element they belong to.
SavedState<2> state_of(const std::vector<GlobalId>& elements) {
  auto state = history();
  for (const GlobalId id : elements) {
    for (int k = 0; k < SavedState<2>::values_per_element; ++k) state.displacement.push_back(value(id, k));
  }
  return state;
}

struct Parts {
  Teuchos::RCP<const base::Comm> comm = Tpetra::getDefaultComm();
  mesh::Mesh<2> mesh = distributed_grid(*comm, {8, 4, 8., 4.}, 1.5);
  std::vector<GlobalId> owned = output::owned_ids(mesh);

  io::Checkpoint gathered() const {
    auto state = state_of(owned);
    const GlobalId rank = comm->getRank();
    state.broken = {{rank, rank + 1, rank + 2}};
    state.softened = {{rank, rank + 10, {0.25, 0.5}}};
    state.slips = {{rank, rank + 20, {0.1, 0.2, 0.3, 0.4}}};
    return output::gather_state(*comm, state, owned);
  }
};

TEST(StateTransfer, GivesEachRankTheDisplacementOfItsElementsAndAllElse) {
  const Parts parts;
  const auto shared = output::share_state<2>(*parts.comm, parts.gathered(), parts.mesh);

  EXPECT_EQ(shared.displacement, state_of(parts.mesh.element_ids).displacement);
  ASSERT_EQ(shared.broken.size(), static_cast<std::size_t>(parts.comm->getSize()));
  EXPECT_EQ(shared.broken.back().call, parts.comm->getSize() + 1);
  ASSERT_EQ(shared.softened.size(), shared.broken.size());
  EXPECT_EQ(shared.softened.back().second, parts.comm->getSize() + 9);
  EXPECT_THAT(shared.softened.back().largest_stretches, ElementsAre(0.25, 0.5));
  ASSERT_EQ(shared.slips.size(), shared.broken.size());
  EXPECT_EQ(shared.slips.back().second, parts.comm->getSize() + 19);
  EXPECT_THAT(shared.slips.back().values, ElementsAre(0.1, 0.2, 0.3, 0.4));
  const auto expected = history();
  EXPECT_EQ(shared.load_factor, expected.load_factor);
  EXPECT_EQ(shared.load_step, expected.load_step);
  EXPECT_EQ(shared.energies.external_work, expected.energies.external_work);
  EXPECT_EQ(shared.counts.topologies, expected.counts.topologies);
  EXPECT_EQ(shared.break_calls_before_topology, expected.break_calls_before_topology);
  ASSERT_EQ(shared.flag_points.size(), 2u);
  EXPECT_EQ(shared.flag_points[1].growth, 2);
  EXPECT_EQ(shared.flag_points[1].centroid, expected.flag_points[1].centroid);
}

TEST(StateTransfer, DataSetsHaveTheirOrder) {
  const Parts parts;
  const auto gathered = parts.gathered();
  if (parts.comm->getRank() != 0) {
    EXPECT_TRUE(gathered.numbers.empty());
    return;
  }
  EXPECT_THAT(gathered.numbers.at("body"), ElementsAre(1.5, 0.75, 2.5, 3.5, 4.5, 5.5));
  EXPECT_THAT(gathered.integers.at("body_counts"), ElementsAre(11, 12, 13, 14, 15, 16, 17, 18, 19));
  EXPECT_THAT(gathered.integers.at("flagged_elements"), ElementsAre(21, 1, 22, 2));
  EXPECT_THAT(gathered.numbers.at("flag_points"), ElementsAre(0.25, 0.5, 0.75, 1.));
  EXPECT_EQ(gathered.integers.at("broken_bonds").size(), 3u * parts.comm->getSize());
  EXPECT_EQ(gathered.integers.at("softened_bonds").size(), 2u * parts.comm->getSize());
  EXPECT_EQ(gathered.numbers.at("largest_stretches").size(), 2u * parts.comm->getSize());
  EXPECT_EQ(gathered.integers.at("slips").size(), 2u * parts.comm->getSize());
  EXPECT_EQ(gathered.numbers.at("slips_and_friction").size(), 4u * parts.comm->getSize());
  const auto& displacement = gathered.numbers.at("displacement");
  ASSERT_EQ(displacement.size(), 32u * SavedState<2>::values_per_element);
  EXPECT_EQ(displacement[5 * SavedState<2>::values_per_element + 3], value(5, 3));
}

}  // namespace
}  // namespace perimorph::tests
