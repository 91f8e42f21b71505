#include "perimorph/base/signals.hpp"

#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>
#include <csignal>

namespace perimorph::base {
namespace {

class Signals : public testing::Test {
 protected:
  Teuchos::RCP<const Comm> comm = Tpetra::getDefaultComm();
  int last_rank = comm->getSize() - 1;

  void raise_on_the_last_rank(int signal) const {
    if (comm->getRank() != last_rank) return;
    ASSERT_EQ(std::raise(signal), 0);
  }
};

TEST_F(Signals, OfOneRankAreKnownToAll) {
  base::Signals signals;
  EXPECT_EQ(signals.look(*comm).stop, "");
  raise_on_the_last_rank(SIGINT);
  EXPECT_EQ(signals.look(*comm).stop, "SIGINT");
  EXPECT_EQ(base::Signals::is_stop_asked(), comm->getRank() == last_rank);
}

TEST_F(Signals, AskForOneCheckpoint) {
  base::Signals signals;
  raise_on_the_last_rank(SIGUSR1);
  EXPECT_TRUE(signals.look(*comm).checkpoint);
  EXPECT_FALSE(signals.look(*comm).checkpoint);
}

// Whoever signals one rank after another reaches the last ones when the first have had the run stopped already.
TEST_F(Signals, ThatComeAfterTheRanksAgreedToStopEndNoRank) {
  {
    base::Signals signals;
    raise_on_the_last_rank(SIGTERM);
    EXPECT_EQ(signals.look(*comm).stop, "SIGTERM");
  }
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) EXPECT_EQ(std::raise(signal), 0);
}

TEST_F(Signals, MeanAfterwardsWhatTheyDidBeforeWhenNoStopWasAskedFor) {
  std::signal(SIGTERM, SIG_DFL);
  { base::Signals signals; }
  EXPECT_EQ(std::signal(SIGTERM, SIG_DFL), SIG_DFL);
}

}  // namespace
}  // namespace perimorph::base
