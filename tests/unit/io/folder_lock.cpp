#include "perimorph/io/folder_lock.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <optional>

#include "perimorph/base/errors.hpp"
#include "support/temporary_directory.hpp"

namespace perimorph {
namespace {

using io::FolderLock;
using Rank = io::FolderLock::Rank;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string refusal(const std::string& folder) {
  try {
    const FolderLock second(folder, Rank::first);
  } catch (const base::UserError& error) {
    return error.what();
  }
  return "";
}

/// A process that holds a lock until it is killed.
class Holder {
 public:
  explicit Holder(const std::string& folder, Rank rank = Rank::first) {
    int ready[2];
    EXPECT_EQ(pipe(ready), 0);
    process_ = fork();
    if (process_ == 0) {
      const FolderLock lock(folder, rank);
      if (write(ready[1], "x", 1) == 1) pause();
    }
    char byte = 0;
    EXPECT_EQ(read(ready[0], &byte, 1), 1);
    close(ready[0]);
    close(ready[1]);
  }
  ~Holder() { end(); }
  Holder(const Holder&) = delete;
  Holder& operator=(const Holder&) = delete;

  void end() {
    if (process_ > 0) {
      kill(process_, SIGKILL);
      waitpid(process_, nullptr, 0);
    }
    process_ = 0;
  }
  int process() const { return process_; }

 private:
  int process_ = 0;
};

TEST(FolderLock, KeepsASecondRunOutAndNamesTheFirst) {
  const tests::TemporaryDirectory directory;
  const Holder first(directory.file(""));
  EXPECT_THAT(refusal(directory.file("")),
              AllOf(StartsWith(directory.file("") + ": another run is writing there: process "),
                    HasSubstr(std::to_string(first.process()) + " on "), HasSubstr("--output")));
}

TEST(FolderLock, EndsWithTheRunAndLeavesNoFile) {
  const tests::TemporaryDirectory directory;
  for (int run = 0; run < 3; ++run) {
    const FolderLock lock(directory.file(""), Rank::first);
    EXPECT_TRUE(std::filesystem::exists(directory.file("run.lock")));
  }
  EXPECT_FALSE(std::filesystem::exists(directory.file("run.lock")));
}

TEST(FolderLock, OfARunThatWasKilledHindersNobody) {
  const tests::TemporaryDirectory directory;
  Holder first(directory.file(""));
  first.end();
  EXPECT_TRUE(std::filesystem::exists(directory.file("run.lock")));
  EXPECT_EQ(refusal(directory.file("")), "");
}

TEST(FolderLock, LastsAsLongAsAnyRankLives) {
  const tests::TemporaryDirectory directory;
  Holder first(directory.file("")), second(directory.file(""), Rank::other);
  first.end();
  EXPECT_NE(refusal(directory.file("")), "");
  second.end();
  EXPECT_EQ(refusal(directory.file("")), "");
}

TEST(FolderLock, TellsThatTheFolderWasEmptied) {
  const tests::TemporaryDirectory directory;
  const FolderLock lock(directory.file(""), Rank::first);
  EXPECT_NO_THROW(lock.check());
  std::filesystem::remove(directory.file("run.lock"));
  EXPECT_THROW(lock.check(), base::ComputationError);
  std::ofstream(directory.file("run.lock")) << "another run's";
  EXPECT_THROW(lock.check(), base::ComputationError);
}

TEST(FolderLock, AFolderThatCannotBeWrittenToIsTheUsersMistake) {
  const tests::TemporaryDirectory directory;
  EXPECT_THAT(refusal(directory.file("absent")),
              HasSubstr("run.lock: it cannot be written: No such file or directory"));
}

}  // namespace
}  // namespace perimorph
