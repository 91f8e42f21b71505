#include "perimorph/io/checkpoint.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "limited_file_size.hpp"
#include "perimorph/base/errors.hpp"
#include "support/temporary_directory.hpp"

namespace perimorph {
namespace {

using io::Checkpoint;
using io::CheckpointFolder;
using io::CheckpointId;
using ::testing::ElementsAre;

Checkpoint example() {
  Checkpoint checkpoint;
  checkpoint.numbers["displacement"] = {0.1, -1. / 3., 1e-310, std::numeric_limits<double>::infinity()};
  checkpoint.numbers["nothing"] = {};
  checkpoint.numbers["many"] = std::vector<double>(200000, 0.7);
  checkpoint.integers["bonds"] = {std::numeric_limits<base::GlobalId>::max(), -1, 0};
  checkpoint.texts["case"] = "/Title = Größe\nline 2\n";
  checkpoint.texts["empty"] = "";
  return checkpoint;
}

TEST(CheckpointFolder, WhatWasWrittenReadsBackToTheLastBit) {
  const tests::TemporaryDirectory directory;
  const CheckpointFolder folder(directory.file(""));
  folder.write({12}, example());
  const Checkpoint read = folder.read({12});
  EXPECT_EQ(read.numbers, example().numbers);
  EXPECT_EQ(read.integers, example().integers);
  EXPECT_EQ(read.texts, example().texts);
}

TEST(CheckpointFolder, TheLastTwoAreKeptAndNothingElse) {
  const tests::TemporaryDirectory directory;
  const CheckpointFolder folder(directory.file(""));
  for (const int increment : {1, 5, 999999, 1000000}) folder.write({increment}, example());
  EXPECT_THAT(folder.list(), ElementsAre(CheckpointId{999999}, CheckpointId{1000000}));
  folder.remove_after({999999});
  EXPECT_THAT(folder.list(), ElementsAre(CheckpointId{999999}));
  EXPECT_TRUE(std::filesystem::exists(directory.file("checkpoint-999999.h5")));
  EXPECT_FALSE(std::filesystem::exists(directory.file("checkpoint-1000000.h5.part")));
}

TEST(CheckpointFolder, WithinAnIncrementTheyComeAfterItsBeginning) {
  const tests::TemporaryDirectory directory;
  const CheckpointFolder folder(directory.file(""));
  for (const CheckpointId id : {CheckpointId{12, 40}, CheckpointId{12}, CheckpointId{13}, CheckpointId{12, 1000000}}) {
    EXPECT_EQ(std::filesystem::path(folder.file(id)).extension(), ".h5");
    std::ofstream(folder.file(id)) << "x";
  }
  std::ofstream(directory.file("checkpoint-000014.h5.part")) << "x";
  std::ofstream(directory.file("checkpoint-14.h5")) << "x";  // somebody else's
  EXPECT_THAT(folder.list(),
              ElementsAre(CheckpointId{12}, CheckpointId{12, 40}, CheckpointId{12, 1000000}, CheckpointId{13}));
  EXPECT_LT(folder.file({12}), folder.file({12, 40}));  // also for who sorts names
  EXPECT_LT(folder.file({12, 40}), folder.file({13}));

  folder.remove_after({12, 40});
  EXPECT_THAT(folder.list(), ElementsAre(CheckpointId{12}, CheckpointId{12, 40}));
  EXPECT_FALSE(std::filesystem::exists(directory.file("checkpoint-000014.h5.part")));
  EXPECT_TRUE(std::filesystem::exists(directory.file("checkpoint-14.h5")));
}

TEST(CheckpointFolder, ADamagedFileIsToldFromASoundOne) {
  const tests::TemporaryDirectory directory;
  const CheckpointFolder folder(directory.file(""));
  folder.write({1}, example());
  const auto size = std::filesystem::file_size(folder.file({1}));
  for (const double share : {0., 0.01, 0.5, 0.9999}) {
    folder.write({1}, example());
    std::filesystem::resize_file(folder.file({1}), static_cast<std::uintmax_t>(share * static_cast<double>(size)));
    EXPECT_THROW(folder.read({1}), base::UserError) << share;
  }
  folder.write({1}, example());
  {
    std::fstream file(folder.file({1}), std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(static_cast<long>(size / 2));
    file.put('x');
  }
  EXPECT_THROW(folder.read({1}), base::UserError);
  EXPECT_THROW(folder.read({2}), base::UserError);
}

TEST(CheckpointFolder, AFlippedBitIsSeenWhereverItIs) {
  const tests::TemporaryDirectory directory;
  const CheckpointFolder folder(directory.file(""));
  Checkpoint small = example();
  small.numbers.erase("many");
  folder.write({1}, small);
  std::ifstream stream(folder.file({1}), std::ios::binary);
  const std::string sound{std::istreambuf_iterator<char>(stream), {}};
  constexpr std::size_t stride = 7;  // prime to 8: all bits have their turn
  std::size_t n_flips = 0;
  for (std::size_t bit = 0; bit < 8 * sound.size(); bit += stride, ++n_flips) {
    std::string spoilt = sound;
    spoilt[bit / 8] = static_cast<char>(spoilt[bit / 8] ^ (1 << bit % 8));
    std::ofstream(folder.file({1}), std::ios::binary) << spoilt;
    ASSERT_THROW(folder.read({1}), base::UserError) << "bit " << bit;
  }
  EXPECT_GT(n_flips, 1000u);
  std::ofstream(folder.file({1}), std::ios::binary) << sound;
  EXPECT_EQ(folder.read({1}).texts, small.texts);
}

TEST(CheckpointFolder, AFullDiskStopsTheComputationAndSparesTheOlderOne) {
  const tests::TemporaryDirectory directory;
  const CheckpointFolder folder(directory.file(""));
  folder.write({1}, example());
  {
    const tests::LimitedFileSize limit(10000);
    EXPECT_THROW(folder.write({2}, example()), base::ComputationError);
  }
  EXPECT_THAT(folder.list(), ElementsAre(CheckpointId{1}));
  EXPECT_EQ(folder.read({1}).numbers, example().numbers);
  EXPECT_FALSE(std::filesystem::exists(folder.file({2}) + ".part"));
}

}  // namespace
}  // namespace perimorph
