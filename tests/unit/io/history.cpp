#include "perimorph/io/history.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
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

TEST(History, GoesOnWhereItWasAndCutsOffWhatFollowed) {
  const tests::TemporaryDirectory directory;
  const std::string file = directory.file("history.csv");
  io::FileExtent then;
  {
    History history(file, {"increment", "x"});
    history.write({1, 5});
    history.write({2, 7});
    then = history.extent();
    history.write({3, 9});
  }
  std::ofstream(file, std::ios::app) << "4";  // cut off by a kill
  auto history = History::resume(file, {"increment", "x"}, then);
  history.write({3, 10});
  history.check();
  EXPECT_EQ(text_of(file), "increment,x\n1,5\n2,7\n3,10\n");
  EXPECT_EQ(io::trouble_with(directory.file(""), history.extent()), "");
}

TEST(History, WhatIsNotAsItWasLeftIsTold) {
  const tests::TemporaryDirectory directory;
  const std::string file = directory.file("history.csv"), folder = directory.file("");
  io::FileExtent then;
  {
    History history(file, {"increment", "x"});
    history.write({1, 5});
    then = history.extent();
  }
  EXPECT_EQ(io::trouble_with(folder, then), "");
  std::ofstream(file, std::ios::app) << "2,6\n";
  EXPECT_EQ(io::trouble_with(folder, then), "");  // what follows does not count
  std::ofstream(file) << "increment,x\n1,6\n";
  EXPECT_EQ(io::trouble_with(folder, then), "is not what it was");
  std::ofstream(file) << std::string(static_cast<std::size_t>(then.size), '\0');
  EXPECT_EQ(io::trouble_with(folder, then), "is not what it was");
  std::ofstream(file) << "increment,x\n1,";
  EXPECT_EQ(io::trouble_with(folder, then), "is shorter than it was");
  std::filesystem::remove(file);
  EXPECT_EQ(io::trouble_with(folder, then), "is missing");
}

TEST(History, ATableThatIsRemovedOrChangedMeanwhileStopsTheComputation) {
  const tests::TemporaryDirectory directory;
  const std::string file = directory.file("history.csv");
  History history(file, {"increment"});
  history.write({1});
  std::ofstream(file, std::ios::app) << "somebody else's\n";
  EXPECT_THROW(history.check(), base::ComputationError);
  std::filesystem::remove(file);
  const std::string message = message_of<base::ComputationError>([&] { history.check(); });
  EXPECT_THAT(message, AllOf(StartsWith(file + ": it is missing"), HasSubstr("while the run was writing it")));
}

TEST(History, OneWithOtherColumnsIsNotContinued) {
  const tests::TemporaryDirectory directory;
  const std::string file = directory.file("history.csv");
  const auto extent = History(file, {"increment", "x"}).extent();
  const std::string message = message_of<base::UserError>([&] { History::resume(file, {"increment", "y"}, extent); });
  EXPECT_THAT(message, HasSubstr("history.csv: it cannot be continued: it is missing or has other columns"));
}

}  // namespace
}  // namespace perimorph
