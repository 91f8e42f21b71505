// A state that is gathered and shared out again is the same, and in a checkpoint it stands as it always has.

#include "perimorph/output/state_transfer.hpp"

#include <gmock/gmock.h>

#include <Tpetra_Core.hpp>
#include <fstream>
#include <numeric>

#include "perimorph/base/errors.hpp"
#include "support/meshes.hpp"
#include "support/temporary_directory.hpp"

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

constexpr GlobalId n_elements = 32;

GlobalId point(GlobalId element, int q) { return element % n_elements * elements::max_points + q; }

/// With two broken bonds, a softened one and a slip that begin in each of these elements.
void add_bonds(SavedState<2>& state, const std::vector<GlobalId>& elements) {
  for (const GlobalId id : elements) {
    const auto number = static_cast<double>(id);
    state.broken.push_back({point(id, 3), point(id + 2, 0), 100 + id});
    state.broken.push_back({point(id, 1), point(id + 1, 2), 200 + id});
    state.softened.push_back({point(id, 4), point(id + 1, 5), {0.25 + number, 0.5}});
    state.slips.push_back({point(id, 6), point(id + 1, 7), {0.1, 0.2, 0.3, 0.4 + number}});
  }
}

std::vector<GlobalId> counted(std::size_t n) {
  std::vector<GlobalId> all(n);
  std::iota(all.begin(), all.end(), 0);
  return all;
}

/// A body's state on some ranks.
struct Parts {
  Teuchos::RCP<const base::Comm> comm;
  mesh::Mesh<2> mesh = distributed_grid(*comm, {8, 4, 8., 4.}, 1.5);
  std::vector<GlobalId> owned = output::owned_ids(mesh);

  explicit Parts(const Teuchos::RCP<const base::Comm>& some = Tpetra::getDefaultComm()) : comm(some) {}

  io::Checkpoint sliced(bool has_starts = false) const {
    auto state = state_of(owned);
    if (has_starts) {
      for (const double number : state.displacement) state.starts.push_back(-number);
    }
    auto backwards = owned;
    std::reverse(backwards.begin(), backwards.end());
    add_bonds(state, backwards);
    return output::slice_state(*comm, state, owned);
  }

  void expect_shared(const SavedState<2>& shared, bool has_starts = false) const {
    const auto expected_displacement = state_of(mesh.element_ids).displacement;
    EXPECT_EQ(shared.displacement, expected_displacement);
    ASSERT_EQ(shared.starts.size(), has_starts ? expected_displacement.size() : 0);
    for (std::size_t i = 0; i < shared.starts.size(); ++i) ASSERT_EQ(shared.starts[i], -expected_displacement[i]);
    expect_bonds(shared);
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

  /// Those that begin in local elements, in order.
  void expect_bonds(const SavedState<2>& shared) const {
    SavedState<2> expected;
    auto local = mesh.element_ids;
    std::sort(local.begin(), local.end());
    add_bonds(expected, local);
    ASSERT_EQ(shared.broken.size(), expected.broken.size());
    for (std::size_t i = 0; i < shared.broken.size(); i += 2) {
      EXPECT_EQ(shared.broken[i].second, expected.broken[i + 1].second);  // point 1 comes before point 3
      EXPECT_EQ(shared.broken[i].call, expected.broken[i + 1].call);
      EXPECT_EQ(shared.broken[i + 1].first, expected.broken[i].first);
    }
    ASSERT_EQ(shared.softened.size(), expected.softened.size());
    ASSERT_EQ(shared.slips.size(), expected.slips.size());
    for (std::size_t i = 0; i < shared.slips.size(); ++i) {
      EXPECT_EQ(shared.softened[i].second, expected.softened[i].second);
      EXPECT_EQ(shared.softened[i].largest_stretches, expected.softened[i].largest_stretches);
      EXPECT_EQ(shared.slips[i].first, expected.slips[i].first);
      EXPECT_EQ(shared.slips[i].values, expected.slips[i].values);
    }
  }
};

TEST(StateTransfer, GivesEachRankTheDisplacementOfItsElementsTheirBondsAndAllElse) {
  const Parts parts;
  parts.expect_shared(output::share_state<2>(*parts.comm, parts.sliced(), parts.mesh));
}

TEST(StateTransfer, NoRankHasMoreThanItsSlice) {
  const Parts parts;
  const std::size_t n_ranks = parts.comm->getSize(), rank = parts.comm->getRank();
  const auto sliced = parts.sliced();
  const auto n_rows = [&](std::size_t n) { return n * (rank + 1) / n_ranks - n * rank / n_ranks; };
  EXPECT_EQ(sliced.number_rows.at("displacement").n_rows(), n_rows(n_elements));
  EXPECT_LE(sliced.integer_rows.at("broken_bonds").n_rows(), 2 * n_rows(2 * n_elements));
}

TEST(StateTransfer, MoreElementsThanAreSentAtOnce) {
  const auto comm = Tpetra::getDefaultComm();
  const auto mesh = distributed_grid(*comm, {512, 300, 512., 300.}, 1.5);
  const auto owned = output::owned_ids(mesh);
  const auto sliced = output::slice_state(*comm, state_of(owned), owned);
  const auto shared = output::share_state<2>(*comm, sliced, mesh);
  EXPECT_TRUE(shared.displacement == state_of(mesh.element_ids).displacement);
}

TEST(StateTransfer, BondsOfOneRankAreSharedByAll) {
  const Parts parts;
  const std::size_t n_ranks = parts.comm->getSize(), n = 100000;
  auto state = state_of(parts.owned);
  if (parts.comm->getRank() == parts.comm->getSize() - 1) {
    for (std::size_t i = 0; i < n; ++i) state.broken.push_back({static_cast<GlobalId>(i * 7919 % n), 0, 1});
  } else {
    state.broken = {{5, parts.comm->getRank(), 1}};
  }
  const auto sliced = output::slice_state(*parts.comm, state, parts.owned);
  EXPECT_LT(sliced.integer_rows.at("broken_bonds").n_rows(), 2 * n / n_ranks + n_ranks);
}

TEST(StateTransfer, FromAnyNumberOfRanksToAnyOtherByAFileThatTellsNothingOfThem) {
  const Parts parts;
  const TemporaryDirectory directory;
  const io::CheckpointFolder folder(base::broadcast(*parts.comm, directory.file("")));
  std::string bytes_of_one;
  for (const int n : {1, 2, 4}) {
    if (n > parts.comm->getSize()) break;
    std::vector<int> ranks(n);
    std::iota(ranks.begin(), ranks.end(), 0);
    const auto some = parts.comm->createSubcommunicator(ranks);
    if (!some.is_null()) folder.write(*some, {n}, Parts(some).sliced(true));
    parts.comm->barrier();
    const auto read = folder.read(*parts.comm, {n});
    parts.expect_shared(output::share_state<2>(*parts.comm, read, parts.mesh), true);
    std::ifstream stream(folder.file({n}), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    if (n == 1) bytes_of_one = bytes;
    EXPECT_EQ(bytes, bytes_of_one) << n;
    parts.comm->barrier();  // before rank 0 removes the file
  }
}

TEST(StateTransfer, AStateOnAFinerMeshGoesToAllRanks) {
  const Parts parts;
  std::vector<mesh::Descent> descents;
  if (parts.comm->getRank() == 0) {
    for (int element = 0; element < n_elements; ++element) descents.push_back({element, {}});
  }
  const auto finer = output::refine_state<2>(*parts.comm, parts.sliced(true), descents);
  parts.expect_shared(output::share_state<2>(*parts.comm, finer, parts.mesh), true);
}

TEST(StateTransfer, ABondOfNoElementIsRefusedOnAllRanks) {
  const Parts parts;
  auto state = state_of(parts.owned);
  if (parts.comm->getRank() == 0) state.broken = {{n_elements * elements::max_points, 0, 1}};
  const auto sliced = output::slice_state(*parts.comm, state, parts.owned);
  EXPECT_THROW(output::share_state<2>(*parts.comm, sliced, parts.mesh), base::Bug);
}

TEST(StateTransfer, DataSetsHaveTheirOrder) {
  const Parts parts;
  const auto sliced = parts.sliced();
  const auto all = [&](const auto& rows) { return base::gather_on_all(*parts.comm, rows.values); };
  const auto broken = all(sliced.integer_rows.at("broken_bonds"));
  ASSERT_EQ(broken.size(), 3u * 2 * n_elements);
  for (const GlobalId element : counted(n_elements - 1)) {
    const auto row = broken.begin() + 6 * element;
    EXPECT_THAT(std::vector<GlobalId>(row, row + 3),
                ElementsAre(point(element, 1), point(element + 1, 2), 200 + element));
  }
  EXPECT_EQ(all(sliced.integer_rows.at("softened_bonds")).size(), 2u * n_elements);
  EXPECT_EQ(all(sliced.number_rows.at("largest_stretches")).size(), 2u * n_elements);
  EXPECT_EQ(all(sliced.integer_rows.at("slips")).size(), 2u * n_elements);
  EXPECT_EQ(all(sliced.number_rows.at("slips_and_friction")).size(), 4u * n_elements);
  const auto displacement = all(sliced.number_rows.at("displacement"));
  ASSERT_EQ(displacement.size(), 32u * SavedState<2>::values_per_element);
  EXPECT_EQ(displacement[5 * SavedState<2>::values_per_element + 3], value(5, 3));
  if (parts.comm->getRank() != 0) return;
  EXPECT_THAT(sliced.numbers.at("body"), ElementsAre(1.5, 0.75, 2.5, 3.5, 4.5, 5.5));
  EXPECT_THAT(sliced.integers.at("body_counts"), ElementsAre(11, 12, 13, 14, 15, 16, 17, 18, 19));
  EXPECT_THAT(sliced.integers.at("flagged_elements"), ElementsAre(21, 1, 22, 2));
  EXPECT_THAT(sliced.numbers.at("flag_points"), ElementsAre(0.25, 0.5, 0.75, 1.));
}

}  // namespace
}  // namespace perimorph::tests
