#include "perimorph/io/history.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "limited_file_size.hpp"
#include "perimorph/base/errors.hpp"
#include "support/temporary_directory.hpp"

namespace perimorph {
namespace {

using io::History;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string text_of(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

template <class Error, class Work>
std::string message_of(Work work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing of this kind was thrown";
}

TEST(History, WritesAHeaderAndOneRowPerIncrement) {
  const tests::TemporaryDirectory directory;
  const std::string file = directory.file("history.csv");

  History history(file, {"increment", "load_factor", "reaction_top_y"});
  history.write({1, 0.05, -1234.5678901234});
  history.write({2, 1. / 3., 1e-17});

  EXPECT_EQ(text_of(file),
            "increment,load_factor,reaction_top_y\n"
            "1,0.05,-1234.56789\n"
            "2,0.3333333333,1e-17\n");
}

TEST(History, WritesIntegralValuesWithoutExponentAndWithoutASignOfZero) {
  const tests::TemporaryDirectory directory;
  const std::string file = directory.file("history.csv");

  History history(file, {"a", "b", "c", "d"});
  history.write({12345678901234., -0., -3., 1e20});

  EXPECT_EQ(text_of(file), "a,b,c,d\n12345678901234,0,-3,1e+20\n");
}

TEST(History, EveryRowIsOnDiskAtOnce) {
  const tests::TemporaryDirectory directory;
  const std::string file = directory.file("history.csv");
  History history(file, {"increment"});
  EXPECT_EQ(text_of(file), "increment\n");
  history.write({1});
  EXPECT_EQ(text_of(file), "increment\n1\n");
}

TEST(History, ANameWithACommaStaysOneColumn) {
  const tests::TemporaryDirectory directory;
  const std::string file = directory.file("history.csv");
  const History history(file, {"increment", "reaction_top, \"left\"_y"});
  EXPECT_EQ(text_of(file), "increment,\"reaction_top, \"\"left\"\"_y\"\n");
}

TEST(History, AnUnwritablePathIsTheUsersMistakeAndNamesTheFile) {
  const tests::TemporaryDirectory directory;
  const std::string file = directory.file("absent/history.csv");
  const std::string message = message_of<base::UserError>([&] { History(file, {"increment"}); });
  EXPECT_EQ(message, file +
                         ": the history cannot be written: No such file or directory; "
                         "name another directory with --output");
}

TEST(History, AFullDiskAtTheStartIsTheUsersMistake) {
  const tests::TemporaryDirectory directory;
  const std::string file = directory.file("history.csv");
  const tests::LimitedFileSize limit(4);
  const std::string message = message_of<base::UserError>([&] { History(file, {"increment"}); });
  EXPECT_THAT(message, AllOf(StartsWith(file + ": "), HasSubstr("File too large")));
}

TEST(History, ADiskThatFillsUpLaterStopsTheComputation) {
  const tests::TemporaryDirectory directory;
  const std::string file = directory.file("history.csv");
  History history(file, {"increment"});
  const tests::LimitedFileSize limit(10);
  const std::string message = message_of<base::ComputationError>([&] { history.write({1}), history.write({2}); });
  EXPECT_EQ(message, file + ": the history cannot be written: File too large");
}

TEST(History, ARowOfTheWrongLengthIsABug) {
  const tests::TemporaryDirectory directory;
  History history(directory.file("history.csv"), {"increment", "load_factor"});
  EXPECT_THROW(history.write({1}), base::Bug);
}

TEST(History, TextsStandAmongNumbers) {
  const tests::TemporaryDirectory directory;
  const std::string file = directory.file("probes.csv");
  History history(file, {"increment", "probe"});
  history.write_texts({"1", "tip, left"});
  EXPECT_EQ(text_of(file), "increment,probe\n1,\"tip, left\"\n");
}

/// A file that an earlier run has left, and what is left of it when a run goes on after an increment.
std::string resumed(const std::string& rows, int increment, History::Rows kind = History::Rows::in_each_increment) {
  const tests::TemporaryDirectory directory;
  const std::string file = directory.file("history.csv");
  std::ofstream(file) << "increment,x\n" << rows;
  History::resume(file, {"increment", "x"}, increment, kind).write({99, 1});
  return text_of(file);
}

TEST(History, GoesOnAfterAllRowsOfAnIncrement) {
  EXPECT_EQ(resumed("1,5\n1,6\n2,7\n2,8\n3,9\n", 2), "increment,x\n1,5\n1,6\n2,7\n2,8\n99,1\n");
}

TEST(History, ALineThatWasCutOffIsNoRow) {
  EXPECT_EQ(resumed("1,5\n11,6\n12,7\n1", 12), "increment,x\n1,5\n11,6\n12,7\n99,1\n");  // of 13
}

TEST(History, OnlyATableWithRowsInEachIncrementMustReachTheIncrement) {
  const std::string message = message_of<base::UserError>([] { resumed("1,5\n", 2); });
  EXPECT_THAT(message, HasSubstr("history.csv: it cannot be continued: increment 2 is missing"));
  EXPECT_EQ(resumed("1,5\n", 2, History::Rows::in_some), "increment,x\n1,5\n99,1\n");
}

}  // namespace
}  // namespace perimorph
