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

TEST(Directory, AnItemsHolderIsTheRankInWhoseSliceItIs) {
  const auto comm = Tpetra::getDefaultComm();
  for (const GlobalId n : {1, 2, 3, 7, 100}) {
    const Directory directory(*comm, n, {});
    EXPECT_EQ(directory.begin(0), 0);
    EXPECT_EQ(directory.begin(comm->getSize()), n);
    for (GlobalId item = 0; item < n; ++item) {
      const int holder = directory.holder(item);
      EXPECT_LE(directory.begin(holder), item);
      EXPECT_LT(item, directory.begin(holder + 1));
    }
    EXPECT_EQ(sum(*comm, static_cast<GlobalId>(directory.n_here())), n);
  }
}

TEST(Directory, WhatAllRanksSayOfAnItemComesTogetherAndTheAnswerGoesToEachOfThem) {
  const auto comm = Tpetra::getDefaultComm();
  constexpr GlobalId n = 23;
  const auto items = some_items(*comm, n);
  const Directory directory(*comm, n, items);

  std::vector<int> how_many(directory.n_here(), 0);
  const auto told = directory.tell(std::vector<GlobalId>(items));
  for (std::size_t rank = 0; rank < told.size(); ++rank) {
    ASSERT_EQ(told[rank].size(), directory.known()[rank].size());
    for (std::size_t i = 0; i < told[rank].size(); ++i) {
      EXPECT_EQ(told[rank][i], directory.begin(comm->getRank()) + directory.known()[rank][i]);
      ++how_many[directory.known()[rank][i]];
    }
  }
  const auto counts = directory.answer_all(how_many);

  ASSERT_EQ(counts.size(), items.size());
  for (std::size_t i = 0; i < items.size(); ++i) {
    int expected = 0;
    for (int rank = 0; rank < std::max(1, comm->getSize() - 1); ++rank) expected += items[i] % (rank + 2) == 0;
    EXPECT_EQ(counts[i], expected) << items[i];
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
  EXPECT_TRUE(directory.answer_all(std::vector<int>()).empty());
}

}  // namespace
}  // namespace perimorph::base
