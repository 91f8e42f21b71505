#include "perimorph/io/checkpoint.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Teuchos_DefaultSerialComm.hpp>
#include <Tpetra_Core.hpp>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>

#include "limited_file_size.hpp"
#include "perimorph/base/errors.hpp"
#include "perimorph/base/profile.hpp"
#include "support/temporary_directory.hpp"

namespace perimorph {
namespace {

using io::Checkpoint;
using io::CheckpointFolder;
using io::CheckpointId;
using io::Rows;
using ::testing::ElementsAre;

constexpr std::size_t n_rows = 41, width = 3;

double number(std::size_t row, std::size_t column) {
  return 0.1 * static_cast<double>(row) - static_cast<double>(column);
}

/// These rows, of all that there are.
template <class Value>
Rows<Value> rows(std::size_t from, std::size_t to) {
  Rows<Value> rows{width, {}};
  for (std::size_t row = from; row < to; ++row) {
    for (std::size_t column = 0; column < width; ++column) {
      rows.values.push_back(static_cast<Value>(10. * number(row, column)));
    }
  }
  return rows;
}

Checkpoint small_example() {
  Checkpoint checkpoint;
  checkpoint.numbers["displacement"] = {0.1, -1. / 3., 1e-310, std::numeric_limits<double>::infinity()};
  checkpoint.numbers["nothing"] = {};
  checkpoint.integers["bonds"] = {std::numeric_limits<base::GlobalId>::max(), -1, 0};
  checkpoint.texts["case"] = "/Title = Größe\nline 2\n";
  checkpoint.texts["empty"] = "";
  return checkpoint;
}

/// What each rank has: higher ranks have more rows.
Checkpoint example(const base::Comm& comm) {
  auto checkpoint = comm.getRank() == 0 ? small_example() : Checkpoint();
  const std::size_t n = comm.getSize(), rank = comm.getRank();
  const std::size_t from = n_rows * rank * rank / (n * n), to = n_rows * (rank + 1) * (rank + 1) / (n * n);
  checkpoint.number_rows["of numbers"] = rows<double>(from, to);
  checkpoint.number_rows["none"] = {5, {}};
  checkpoint.integer_rows["of integers"] = rows<base::GlobalId>(from, to);
  return checkpoint;
}

/// With many numbers, on all ranks.
Checkpoint large_example(const base::Comm& comm) {
  auto checkpoint = example(comm);
  checkpoint.number_rows["many"] = {8, std::vector<double>(80000, 0.7)};
  return checkpoint;
}

/// One folder for all ranks.
struct CheckpointFolderTest : testing::Test {
  Teuchos::RCP<const base::Comm> comm = Tpetra::getDefaultComm();
  const tests::TemporaryDirectory directory;
  const CheckpointFolder folder{base::broadcast(*comm, directory.file(""))};
  const bool is_root = comm->getRank() == 0;

  /// On all ranks.
  std::string bytes_of(CheckpointId id) const {
    std::ifstream stream(folder.file(id), std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    comm->barrier();  // nobody changes them before all have them
    return bytes;
  }

  /// On rank 0; the others wait.
  void replace(CheckpointId id, const std::string& bytes) const {
    if (is_root) std::ofstream(folder.file(id), std::ios::binary) << bytes;
    comm->barrier();
  }

  void expect_example(const Checkpoint& read) const {
    const auto expected = is_root ? small_example() : Checkpoint();
    EXPECT_EQ(read.numbers, expected.numbers);
    EXPECT_EQ(read.integers, expected.integers);
    EXPECT_EQ(read.texts, expected.texts);
    const std::size_t n_ranks = comm->getSize(), rank = comm->getRank();
    const std::size_t from = n_rows * rank / n_ranks, to = n_rows * (rank + 1) / n_ranks;
    EXPECT_EQ(read.number_rows.at("of numbers").values, rows<double>(from, to).values);
    EXPECT_EQ(read.number_rows.at("none").width, 5u);
    EXPECT_EQ(read.number_rows.at("none").n_rows(), 0u);
    EXPECT_EQ(read.integer_rows.at("of integers").values, rows<base::GlobalId>(from, to).values);
    EXPECT_EQ(read.integer_rows.at("of integers").width, width);
  }
};

TEST_F(CheckpointFolderTest, WhatWasWrittenReadsBackToTheLastBit) {
  folder.write(*comm, {12}, example(*comm));
  expect_example(folder.read(*comm, {12}));
}

TEST_F(CheckpointFolderTest, RanksLeaveNoTraceInTheBytes) {
  folder.write(*comm, {1}, example(*comm));
  if (is_root) {
    const Teuchos::SerialComm<int> alone;
    folder.write(alone, {2}, example(alone));
  }
  comm->barrier();
  EXPECT_EQ(bytes_of({1}), bytes_of({2}));
  expect_example(folder.read(*comm, {2}));
}

TEST_F(CheckpointFolderTest, WritingTakesNoMemoryForWhatIsThere) {
  constexpr double bytes = 32e6;  // of this rank
  auto checkpoint = example(*comm);
  checkpoint.number_rows["many"] = {8, std::vector<double>(static_cast<std::size_t>(bytes / 8.), 0.7)};
  folder.write(*comm, {1}, example(*comm));
  const double before = base::peak_memory();
  folder.write(*comm, {2}, checkpoint);
  EXPECT_LT(base::peak_memory() - before, 0.25 * bytes);
  checkpoint = {};
  checkpoint = folder.read(*comm, {2});
  EXPECT_EQ(checkpoint.number_rows.at("many").values.size(), static_cast<std::size_t>(bytes / 8.));
  EXPECT_LT(base::peak_memory() - before, 0.25 * bytes);
}

TEST_F(CheckpointFolderTest, TheLastTwoAreKeptAndNothingElse) {
  for (const int increment : {1, 5, 999999, 1000000}) folder.write(*comm, {increment}, example(*comm));
  EXPECT_THAT(folder.list(), ElementsAre(CheckpointId{999999}, CheckpointId{1000000}));
  comm->barrier();
  if (!is_root) return;
  folder.remove_after({999999});
  EXPECT_THAT(folder.list(), ElementsAre(CheckpointId{999999}));
  EXPECT_TRUE(std::filesystem::exists(directory.file("checkpoint-999999.h5")));
  EXPECT_FALSE(std::filesystem::exists(directory.file("checkpoint-1000000.h5.part")));
}

TEST_F(CheckpointFolderTest, WithinAnIncrementTheyComeAfterItsBeginning) {
  if (!is_root) return;
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

TEST_F(CheckpointFolderTest, ADamagedFileIsToldFromASoundOne) {
  folder.write(*comm, {1}, large_example(*comm));
  const std::string sound = bytes_of({1});
  for (const double share : {0., 0.01, 0.5, 0.9999}) {
    replace({1}, sound.substr(0, static_cast<std::size_t>(share * static_cast<double>(sound.size()))));
    EXPECT_THROW(folder.read(*comm, {1}), base::UserError) << share;
  }
  std::string spoilt = sound;
  spoilt[sound.size() / 2] = 'x';
  replace({1}, spoilt);
  EXPECT_THROW(folder.read(*comm, {1}), base::UserError);
  EXPECT_THROW(folder.read(*comm, {2}), base::UserError);
}

TEST_F(CheckpointFolderTest, AFlippedBitIsSeenWhereverItIs) {
  folder.write(*comm, {1}, example(*comm));
  const std::string sound = bytes_of({1});
  const std::size_t stride = comm->getSize() == 1 ? 29 : 1009;  // prime to 8: all bits have their turn
  std::size_t n_flips = 0;
  for (std::size_t bit = 0; bit < 8 * sound.size(); bit += stride, ++n_flips) {
    std::string spoilt = sound;
    spoilt[bit / 8] = static_cast<char>(spoilt[bit / 8] ^ (1 << bit % 8));
    replace({1}, spoilt);
    ASSERT_THROW(folder.read(*comm, {1}), base::UserError) << "bit " << bit;
  }
  EXPECT_GT(n_flips, comm->getSize() == 1 ? 1000u : 50u);
  replace({1}, sound);
  expect_example(folder.read(*comm, {1}));
}

TEST_F(CheckpointFolderTest, AFullDiskStopsTheComputationAndSparesTheOlderOne) {
  folder.write(*comm, {1}, example(*comm));
  for (const int full : {0, comm->getSize() - 1}) {  // there or on the last rank only
    std::optional<tests::LimitedFileSize> limit;
    if (comm->getRank() == full) limit.emplace(20000);
    try {
      folder.write(*comm, {2}, large_example(*comm));
      FAIL() << "written";
    } catch (const base::ComputationError& error) {
      EXPECT_EQ(error.what(), folder.file({2}) + ": the checkpoint cannot be written: File too large");
    }
    limit.reset();
    comm->barrier();
    EXPECT_THAT(folder.list(), ElementsAre(CheckpointId{1}));
    EXPECT_FALSE(std::filesystem::exists(folder.file({2}) + ".part"));
    expect_example(folder.read(*comm, {1}));
  }
}

}  // namespace
}  // namespace perimorph
