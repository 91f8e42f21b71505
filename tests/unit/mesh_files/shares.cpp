// Shares of MSH files of every version: together they are the whole file.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "file_contents.hpp"
#include "gmsh_file.hpp"
#include "gmsh_files.hpp"
#include "share.hpp"
#include "sliced_file.hpp"

namespace perimorph::mesh_files {
namespace {

void expect_shares_to_be_the_whole(const std::string& file) {
  const MeshFile whole = read_gmsh_file(file);
  Contents expected;
  expected.add(whole);
  for (const int n_ranks : {2, 4, 7, 100}) {
    SCOPED_TRACE(fmt::format("{}, {} shares", file, n_ranks));
    Contents together;
    for (int rank = 0; rank < n_ranks; ++rank) {
      const MeshFile part = read_gmsh_file(file, {rank, n_ranks});
      expect_same_description(part, whole);
      expect_a_fair_share(part.node_tags.size(), whole.node_tags.size(), n_ranks);
      for (int d = 0; d < 4; ++d) {
        expect_a_fair_share(elements_of(part, d).size(), expected.elements[static_cast<std::size_t>(d)].size(),
                            n_ranks);
      }
      together.add(part);
    }
    expect_alike(together, expected, {0, 1, 2, 3});
  }
}

TEST(Shares, OfMshFilesOfAnyVersionAreTheWhole) {
  for (const std::string format : {"msh22", "msh3", "msh40", "msh41"}) {
    for (const std::string binary : {"", "-bin"}) {
      if (format == "msh40" && binary == "-bin") continue;  // gmsh does not write it
      const std::string options = fmt::format("-format {} {} ", format, binary),
                        name = fmt::format("{}{}", format, binary);
      expect_shares_to_be_the_whole(meshed(unstructured_plate, 2, options, "plate" + name));
      expect_shares_to_be_the_whole(meshed(unstructured_plate, 2, options + "-order 2 -part 3", "plate2" + name));
      expect_shares_to_be_the_whole(meshed(extruded_block, 3, options + "-order 2", "block" + name));
      expect_shares_to_be_the_whole(meshed(extruded_block, 3, options + "-save_all", "all" + name));
      if (format[3] != '4') continue;
      expect_shares_to_be_the_whole(meshed(extruded_block, 3, options + "-save_parametric", "parametric" + name));
    }
  }
}

/// Also one with partitions, whose entities have groups in another way.
TEST(Shares, OfTheFilesOfTheCorpusAreTheWhole) {
  int n_read = 0;
  for (const auto& entry : std::filesystem::directory_iterator(PERIMORPH_SOURCE_DIR "/tests/fuzz/corpus/msh")) {
    try {
      read_gmsh_file(entry.path());
    } catch (const base::UserError&) {
      continue;
    }
    expect_shares_to_be_the_whole(entry.path());
    ++n_read;
  }
  EXPECT_GE(n_read, 10);
}

TEST(Shares, TheFirstRanksOfManyHaveNothingOfASmallFile) {
  const std::string file = written("mesh.msh", two_squares_4_1);
  EXPECT_EQ(read_gmsh_file(file, {0, 100}).node_tags.size() + read_gmsh_file(file, {0, 100}).n_elements(), 0u);
  EXPECT_EQ(read_gmsh_file(file, {99, 100}).node_tags.size(), 1u);
}

TEST(Shares, WhichFilesCanBeSliced) {
  EXPECT_TRUE(can_be_sliced(written("mesh.msh", two_squares_4_1)));
  EXPECT_TRUE(can_be_sliced(written("mesh.msh", two_squares_2_2)));
  EXPECT_FALSE(can_be_sliced(written("mesh.inp", "*NODE\n")));
  EXPECT_FALSE(can_be_sliced(written("mesh.cdb", "/PREP7\n")));
  EXPECT_FALSE(can_be_sliced("nowhere"));
}

}  // namespace
}  // namespace perimorph::mesh_files
