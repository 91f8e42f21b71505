// Ranks agree on how work ended that communicates. That a rank which fails alone ends the job:
// tests/parallel/no_memory.py.

#include "perimorph/base/consensus.hpp"

#include <gtest/gtest.h>

#include <Kokkos_Core.hpp>
#include <Tpetra_Core.hpp>
#include <new>

#include "perimorph/base/errors.hpp"

namespace perimorph::base {
namespace {

class Consensus : public testing::Test {
 protected:
  Teuchos::RCP<const Comm> comm = Tpetra::getDefaultComm();
  int rank = comm->getRank(), n_ranks = comm->getSize();
  base::Consensus consensus{*comm};

  /// What the work is agreed to have thrown: its text, or "" for nothing.
  template <class Error, class Work>
  std::string error_of(Work&& work) const {
    try {
      consensus.run(work);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(Consensus, LetsWorkCommunicate) {
  double total = 0.;
  consensus.run([&] { total = sum(*comm, 1.); });
  EXPECT_EQ(total, n_ranks);
}

TEST_F(Consensus, GivesTheErrorOfOneRankToAll) {
  for (int failing = 0; failing < n_ranks; ++failing) {
    const auto fail = [&] {
      sum(*comm, 1.);
      if (rank == failing) throw ComputationError(fmt::format("rank {} failed", rank));
    };
    EXPECT_EQ(error_of<ComputationError>(fail), fmt::format("rank {} failed", failing));
  }
}

TEST_F(Consensus, GivesTheErrorOfTheLowestRankThatFailed) {
  const auto fail = [&] {
    if (rank == n_ranks - 1) throw UserError(fmt::format("rank {} failed", rank));
    throw Bug(fmt::format("rank {} failed", rank));
  };
  const auto text = n_ranks == 1 ? error_of<UserError>(fail) : error_of<Bug>(fail);
  EXPECT_EQ(text, "rank 0 failed");
}

TEST_F(Consensus, TellsThatThereIsNoMemory) {
  const auto fail = [&] {
    if (rank == n_ranks - 1) throw std::bad_alloc();
  };
  EXPECT_EQ(error_of<MemoryError>(fail), "there is no memory left");
}

TEST_F(Consensus, TellsThatThereIsNoMemoryForAnArrayOfKokkos) {
  const auto allocate = [&] {
    if (rank == n_ranks - 1) Kokkos::View<double*> too_large("too large", std::size_t{1} << 50);
  };
  EXPECT_EQ(error_of<MemoryError>(allocate), "there is no memory left");
}

TEST_F(Consensus, SpeaksOnAChannelOfItsOwn) {
  // A rank that has failed sends nothing that the others, still at work, could take for theirs.
  const auto fail = [&] {
    if (rank == 0) throw ComputationError("rank 0 failed");
    if (n_ranks > 2) {
      const int other = rank == n_ranks - 1 ? 1 : rank + 1;
      const int one = rank;
      int received = 0;
      MPI_Sendrecv(&one, 1, MPI_INT, other, 0, &received, 1, MPI_INT, MPI_ANY_SOURCE, 0, mpi_communicator(*comm),
                   MPI_STATUS_IGNORE);
      EXPECT_GT(received, 0);
    }
  };
  EXPECT_EQ(error_of<ComputationError>(fail), "rank 0 failed");
}

}  // namespace
}  // namespace perimorph::base
