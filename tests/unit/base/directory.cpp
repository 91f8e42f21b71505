#include "perimorph/base/directory.hpp"

#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>

namespace perimorph::base {
namespace {

/// Every rank has copies of some of the items, in an order of its own, and of none if it is the last of several.
std::vector<GlobalId> some_items(const Comm& comm, GlobalId n) {
  const int rank = comm.getRank();
  if (rank > 0 && rank == comm.getSize() - 1) return {};
  std::vector<GlobalId> items;
  for (GlobalId i = n - 1; i >= 0; --i) {
    if (i % (rank + 2) == 0) items.push_back(i);
  }
  return items;
}

void expect_holders(const Comm& comm, const Slices& slices) {
  EXPECT_EQ(slices.begin(0), 0);
  EXPECT_EQ(slices.begin(comm.getSize()), slices.n());
  for (GlobalId item = 0; item < slices.n(); ++item) {
    const int holder = slices.holder(item);
    EXPECT_LE(slices.begin(holder), item);
    EXPECT_LT(item, slices.begin(holder + 1));
  }
  EXPECT_THROW(slices.holder(-1), Bug);
  EXPECT_THROW(slices.holder(slices.n()), Bug);
}

TEST(Slices, AnItemsHolderIsTheRankInWhoseSliceItIs) {
  const auto comm = Tpetra::getDefaultComm();
  const int rank = comm->getRank(), n_ranks = comm->getSize();
  for (const GlobalId n : {1, 2, 3, 7, 100, 1000}) {
    const auto even = Slices::even(*comm, n);
    EXPECT_EQ(even.n(), n);
    expect_holders(*comm, even);
    EXPECT_EQ(sum(*comm, static_cast<GlobalId>(even.size(rank))), n);
    EXPECT_NEAR(static_cast<double>(even.size(rank)), static_cast<double>(n) / n_ranks, 1.);
  }
  const auto uneven = Slices::of(*comm, rank % 2 == 0 ? 3 * rank : 0);  // the first has nothing
  expect_holders(*comm, uneven);
  EXPECT_EQ(uneven.size(rank), rank % 2 == 0 ? 3U * rank : 0U);
}

TEST(Directory, WhatAllRanksSayOfAnItemComesTogetherAndTheAnswerGoesToEachOfThem) {
  const auto comm = Tpetra::getDefaultComm();
  constexpr GlobalId n = 23;
  const auto items = some_items(*comm, n);
  const Directory directory(*comm, n, items);
  const GlobalId first = directory.slices().begin(comm->getRank());

  const auto added = directory.collect(items, GlobalId{0}, [](GlobalId& sum, GlobalId item) { sum += item + 1; });
  const auto counts = directory.answers(added);
  const auto themselves = directory.collect(items);

  ASSERT_EQ(counts.size(), items.size());
  for (std::size_t i = 0; i < items.size(); ++i) {
    GlobalId n_copies = 0;
    for (int rank = 0; rank < std::max(1, comm->getSize() - 1); ++rank) n_copies += items[i] % (rank + 2) == 0 ? 1 : 0;
    EXPECT_EQ(counts[i], n_copies * (items[i] + 1)) << items[i];
  }
  ASSERT_EQ(themselves.size(), directory.n_here());
  for (std::size_t i = 0; i < themselves.size(); ++i) {
    const GlobalId item = first + static_cast<GlobalId>(i);
    EXPECT_EQ(themselves[i], added[i] > 0 ? item : 0);
  }
}

TEST(Directory, AnUnknownItemIsAnErrorOnAllRanks) {
  const auto comm = Tpetra::getDefaultComm();
  const std::vector<GlobalId> items = comm->getRank() == 0 ? std::vector<GlobalId>{5} : std::vector<GlobalId>{};
  EXPECT_THROW(Directory(*comm, 5, items), Bug);
  EXPECT_THROW(Directory(*comm, 0, items), Bug);
}

TEST(Directory, ThereMayBeNothing) {
  const auto comm = Tpetra::getDefaultComm();
  const Directory directory(*comm, 0, {});
  EXPECT_EQ(directory.n_here(), 0U);
  EXPECT_TRUE(directory.answers(std::vector<int>()).empty());
}

}  // namespace
}  // namespace perimorph::base
