// Ranks agree on errors, and exchange and gather what they should.

#include "perimorph/base/parallel.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>

#include "perimorph/base/errors.hpp"

namespace perimorph::base {
namespace {

using testing::ElementsAre;

class Parallel : public testing::Test {
 protected:
  Teuchos::RCP<const Comm> comm = Tpetra::getDefaultComm();
  int rank = comm->getRank(), n_ranks = comm->getSize();
  int last = n_ranks - 1;

  /// What on_all_ranks throws here: its text, or "" for nothing.
  template <class Error, class Work>
  std::string error_of(Work&& work) const {
    try {
      on_all_ranks(*comm, work);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(Parallel, WorkWithoutErrorsThrowsNothing) {
  int done = 0;
  EXPECT_NO_THROW(on_all_ranks(*comm, [&] { ++done; }));
  EXPECT_EQ(done, 1);
}

TEST_F(Parallel, AnErrorOnOneRankIsThrownOnAll) {
  const auto fail_on_last = [&] {
    if (rank == last) throw UserError("wrong on rank " + std::to_string(rank));
  };
  EXPECT_EQ(error_of<UserError>(fail_on_last), "wrong on rank " + std::to_string(last));
}

TEST_F(Parallel, TheErrorOfTheLowestRankWins) {
  const auto fail_everywhere_but_first = [&] {
    if (rank > 0 || n_ranks == 1) throw UserError("wrong on rank " + std::to_string(rank));
  };
  EXPECT_EQ(error_of<UserError>(fail_everywhere_but_first), n_ranks == 1 ? "wrong on rank 0" : "wrong on rank 1");
}

TEST_F(Parallel, TheKindOfTheErrorIsKept) {
  const auto fail = [&](auto error) {
    return [this, error] {
      if (rank == last) throw error;
    };
  };
  EXPECT_EQ(error_of<UserError>(fail(UserError("a"))), "a");
  EXPECT_EQ(error_of<ComputationError>(fail(ComputationError("b"))), "b");
  EXPECT_EQ(error_of<Bug>(fail(Bug("c"))), "c");
  EXPECT_EQ(error_of<Bug>(fail(std::out_of_range("d"))), "d") << "any other exception is a bug";
}

TEST_F(Parallel, RanksCanGoOnTogetherAfterAnError) {
  EXPECT_EQ(error_of<UserError>([&] {
              if (rank == 0) throw UserError("first");
            }),
            "first");
  EXPECT_EQ(sum(*comm, GlobalId{1}), n_ranks);
}

TEST_F(Parallel, SumsAndMaximaAreOverAllRanks) {
  EXPECT_EQ(sum(*comm, 0.5 + rank), 0.5 * n_ranks + 0.5 * last * n_ranks);
  EXPECT_EQ(sum(*comm, (GlobalId{1} << 40) + rank), (GlobalId{1} << 40) * n_ranks + last * n_ranks / 2);
  EXPECT_EQ(max(*comm, -1. * rank), 0.);
  EXPECT_EQ(max(*comm, GlobalId{rank}), last);
  std::vector<double> values = {1., 1. * rank};
  sum(*comm, values);
  EXPECT_THAT(values, ElementsAre(n_ranks, 0.5 * last * n_ranks));
}

TEST_F(Parallel, EveryRankReceivesWhatWasSentToIt) {
  struct Item {
    int from, to;
    double value;
  };
  std::vector<std::vector<Item>> outgoing(n_ranks);
  for (int r = 0; r < n_ranks; ++r) {
    for (int k = 0; k < (rank + 2 * r) % 3; ++k) outgoing[r].push_back({rank, r, 0.25 * k});  // none to some
  }

  const auto incoming = base::exchange(*comm, outgoing);

  ASSERT_EQ(static_cast<int>(incoming.size()), n_ranks);
  for (int r = 0; r < n_ranks; ++r) {
    ASSERT_EQ(static_cast<int>(incoming[r].size()), (r + 2 * rank) % 3);
    for (std::size_t k = 0; k < incoming[r].size(); ++k) {
      EXPECT_EQ(incoming[r][k].from, r);
      EXPECT_EQ(incoming[r][k].to, rank);
      EXPECT_EQ(incoming[r][k].value, 0.25 * static_cast<double>(k));
    }
  }
}

TEST_F(Parallel, GatheringConcatenatesInTheOrderOfRanks) {
  const std::vector<int> own(rank, rank);  // none on rank 0
  std::vector<int> expected;
  for (int r = 0; r < n_ranks; ++r) expected.insert(expected.end(), r, r);

  EXPECT_EQ(gather_on_all(*comm, own), expected);
  EXPECT_EQ(gather_on_root(*comm, own), rank == 0 ? expected : std::vector<int>());
}

TEST_F(Parallel, TheTextOfRankZeroReachesAll) {
  EXPECT_EQ(broadcast(*comm, rank == 0 ? "Überall" : "x"), "Überall");
  EXPECT_EQ(broadcast(*comm, rank == 0 ? "" : "something"), "");
}

TEST_F(Parallel, AMessageToARankThatIsNotThereIsABug) {
  EXPECT_THROW(base::exchange(*comm, std::vector<std::vector<int>>(n_ranks + 1)), Bug);
}

#ifdef PERIMORPH_DEBUG_ASSERTIONS
TEST_F(Parallel, SumsOfDifferentLengthAreABug) {
  std::vector<double> values(rank == 0 ? 2 : 3);
  if (n_ranks > 1) {
    EXPECT_THROW(sum(*comm, values), Bug);
  }
}
#endif

}  // namespace
}  // namespace perimorph::base
