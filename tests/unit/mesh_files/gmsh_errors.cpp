// What the gmsh reader says to files it cannot use, and that no damaged file makes it crash.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <random>

#include "gmsh_files.hpp"

namespace perimorph::mesh_files {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// The error of reading a text, without the file's name at its beginning.
template <int dim = 2>
std::string error_of(const std::string& text) {
  const std::string file = written("mesh.msh", text), message = error_of_reading<dim>(file);
  EXPECT_THAT(message, StartsWith(file + ":"));
  return message.substr(std::min(message.size(), file.size()));
}

// ---- the file ----

TEST(GmshErrors, MissingFile) {
  EXPECT_EQ(error_of_reading<2>("nowhere/mesh.msh"), "nowhere/mesh.msh: cannot be read: No such file or directory");
}

TEST(GmshErrors, Folder) {
  const std::string folder = test_file("folder.msh");
  std::filesystem::create_directories(folder);
  EXPECT_EQ(error_of_reading<2>(folder), folder + ": is a folder, not a gmsh mesh");
}

TEST(GmshErrors, PipeForAFileDoesNotWait) {
  const std::string pipe = test_file("pipe.msh");
  std::filesystem::remove(pipe);
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(error_of_reading<2>(pipe), pipe + ": is not a regular file, as a gmsh mesh must be");
}

TEST(GmshErrors, EmptyFile) {
  EXPECT_EQ(error_of(""), ": the file is empty; a gmsh mesh is needed");
  EXPECT_EQ(error_of(" \n\n"), ": the file is empty; a gmsh mesh is needed");
}

TEST(GmshErrors, NoGmshFile) {
  EXPECT_EQ(error_of("# a comment\n"),
            ":1: not a gmsh mesh: its first section must be $MeshFormat, found \"# a comment\"");
  EXPECT_THAT(error_of(std::string("\x7f"
                                   "ELF\x02\x01\0\0\0",
                                   9)),
              HasSubstr("not a gmsh mesh: its first section must be $MeshFormat, found \"?ELF?????\""));
}

TEST(GmshErrors, UnknownVersion) {
  for (const auto& [version, found] : {std::pair{"1.0", "1"}, {"3.5", "3.5"}, {"4.2", "4.2"}, {"41", "41"}}) {
    EXPECT_EQ(error_of(replaced(two_squares_2_2, "2.2 0 8", fmt::format("{} 0 8", version))),
              fmt::format(":2: MSH version {}; allowed are 2.0 to 4.1 (convert it: gmsh -save -format msh41 -o new.msh "
                          "old.msh)",
                          found));
  }
}

TEST(GmshErrors, UnknownFileType) {
  EXPECT_EQ(error_of(replaced(two_squares_2_2, "2.2 0 8", "2.2 2 8")),
            ":2: after the version \"0 8\" (ASCII) or \"1 8\" (binary) expected, found \"2 8\"");
}

TEST(GmshErrors, OtherByteOrder) {
  EXPECT_THAT(error_of(std::string("$MeshFormat\n4.1 1 8\n") + std::string("\0\0\0\1", 4) + "\n$EndMeshFormat\n"),
              HasSubstr("other byte order (endianness)"));
}

TEST(GmshErrors, MissingSections) {
  EXPECT_THAT(error_of("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"), HasSubstr("the file ends without $Nodes"));
  EXPECT_THAT(error_of(two_squares_2_2.substr(0, two_squares_2_2.find("$Elements"))),
              HasSubstr("the file ends without $Elements"));
}

TEST(GmshErrors, TextBetweenSections) {
  EXPECT_THAT(error_of(replaced(two_squares_2_2, "$Nodes\n", "Nodes\n")),
              StartsWith(":17: a section such as $Nodes expected, found \"$EndNodes\""));
}

TEST(GmshErrors, NoNumberWhereOneMustBe) {
  EXPECT_EQ(error_of(replaced(two_squares_2_2, "3 2 0 0", "3 x 0 0")), ":13: a number expected, found \"x\"");
  EXPECT_EQ(error_of(replaced(two_squares_2_2, "3 2 0 0", "3.5 2 0 0")), ":13: a whole number expected, found \"3.5\"");
  EXPECT_EQ(error_of(replaced(two_squares_2_2, "3 2 0 0", "3 nan 0 0")), ":13: a coordinate is nan");
  EXPECT_EQ(error_of(replaced(two_squares_2_2, "3 2 0 0", "99999999999 2 0 0")),
            ":13: the number 99999999999 is too large");
}

TEST(GmshErrors, CountsThatTheFileCannotHold) {
  EXPECT_THAT(error_of(replaced(two_squares_2_2, "$Nodes\n6", "$Nodes\n6000000000")),
              HasSubstr("a count of 6000000000, but the rest of the file holds at most "));
  EXPECT_THAT(error_of(replaced(two_squares_2_2, "$Elements\n3", "$Elements\n-3")), HasSubstr("a count of -3"));
  EXPECT_THAT(error_of(replaced(two_squares_4_1, "2 3 0 6", "2 3 0 666666")), HasSubstr("a count of 666666"));
}

TEST(GmshErrors, AQuoteThatDoesNotEnd) {
  EXPECT_THAT(error_of(replaced(two_squares_2_2, "\"left\"", "\"left")),
              HasSubstr("the name of physical group 7 has one quote only, found \"\"left\""));
}

TEST(GmshErrors, OnePartitionOfSeveral) {
  meshed(structured_plate, 2, "-format msh41 -part 2 -part_split", "plate");
  EXPECT_THAT(error_of_reading<2>(test_file("plate_1.msh")),
              HasSubstr("the file holds partition 1 of 2 only: save the mesh as one file (without -part_split)"));
}

TEST(GmshErrors, CountsThatDoNotAddUp) {
  EXPECT_THAT(error_of(replaced(two_squares_4_1, "1 6 1 6", "1 7 1 6")), HasSubstr("7 nodes announced, 6 found"));
  EXPECT_THAT(error_of(replaced(two_squares_4_1, "2 3 11 13", "2 4 11 13")),
              HasSubstr("4 elements announced, 3 found"));
  EXPECT_THAT(error_of(replaced(two_squares_2_2, "$Elements\n3", "$Elements\n2")),
              HasSubstr(":22: $EndElements expected, found \"13\""));
}

// ---- elements ----

TEST(GmshErrors, ElementsOfAnotherKind) {
  EXPECT_THAT(error_of(replaced(two_squares_2_2, "12 3 2", "12 92 2")),
              HasSubstr("element 12 is of gmsh's kind 92; allowed are triangles and quadrangles in 2D, tetrahedra, "
                        "pyramids, prisms and hexahedra in 3D, of first or second order (Mesh.ElementOrder)"));
}

TEST(GmshErrors, DegenerateElement) {
  EXPECT_THAT(error_of(replaced(two_squares_2_2, "4 0 1 0", "4 0.5 0.5 0")), HasSubstr("element 12 is degenerate"))
      << "a corner of 180 degrees";
}

TEST(GmshErrors, ConcaveElement) {
  EXPECT_THAT(error_of(replaced(two_squares_2_2, "4 0 1 0", "4 0.9 0.1 0")), HasSubstr("element 12 is "));
}

TEST(GmshErrors, ElementsOnTopOfEachOther) {
  EXPECT_EQ(error_of(replaced(two_squares_2_2, "2 3 6 5", "1 2 5 4")), ": elements 12 and 13 have the same nodes");
  const std::string text =
      replaced(replaced(two_squares_2_2, "$Elements\n3", "$Elements\n4"), "2 3 6 5\n", "2 3 6 5\n14 3 2 1 3 2 3 6 5\n");
  EXPECT_EQ(error_of(text), ": elements 13 and 14 have the same nodes");
}

TEST(GmshErrors, AReversedElementThatIsFoldedOverItsNeighbour) {
  EXPECT_EQ(error_of(replaced(two_squares_2_2, "3 2 0 0\n4 0 1 0\n5 1 1 0\n6 2 1 0",
                              "3 0.1 0 0\n4 0 1 0\n5 1 1 0\n6 0.1 1 0")),
            ": elements 12 and 13 lie on the same side of the side they share: they overlap");
}

TEST(GmshErrors, ThreeElementsOnOneSide) {
  const std::string text =
      replaced(replaced(two_squares_2_2, "$Elements\n3", "$Elements\n4"), "2 3 6 5\n", "2 3 6 5\n14 2 2 1 3 2 6 5\n");
  EXPECT_EQ(error_of(text), ": elements 12, 13 and 14 share one side: they overlap");
}

TEST(GmshErrors, UnknownNode) {
  EXPECT_EQ(error_of(replaced(two_squares_2_2, "2 3 6 5", "2 3 66 5")),
            ": element 13 has node 66, which the file does not list");
}

TEST(GmshErrors, NodeTwice) {
  EXPECT_EQ(error_of(replaced(two_squares_2_2, "6 2 1 0", "5 2 1 0")), ": two nodes have the number 5");
}

TEST(GmshErrors, MeshOfAnotherDimension) {
  EXPECT_THAT(error_of<3>(two_squares_2_2),
              HasSubstr("the mesh has no elements of dimension 3, its highest is 2: mesh it with gmsh -2 (or -3)"));
  EXPECT_THAT(error_of_reading<2>(meshed(extruded_block, 3, "-format msh41", "block")),
              HasSubstr("is of dimension 3, but the case has dimension 2"));
}

TEST(GmshErrors, NoElements) {
  const std::string text =
      replaced(two_squares_2_2, "3\n11 1 2 7 1 4 1\n12 3 2 1 3 1 2 5 4\n13 3 2 1 3 2 3 6 5\n", "0\n");
  EXPECT_EQ(error_of(text), ": the mesh has no elements");
}

TEST(GmshErrors, NodesOutOfThePlane) {
  EXPECT_EQ(error_of(replaced(two_squares_2_2, "3 2 0 0", "3 2 0 0.5")),
            ": a 2D mesh must lie in the plane z = constant, but its nodes have z from 0 to 0.5");
}

// ---- groups ----

TEST(GmshErrors, ElementInNoGroupWhileOthersAre) {
  EXPECT_EQ(error_of(replaced(two_squares_2_2, "13 3 2 1 3", "13 3 2 0 3")),
            ": element 13 is in no group, but others are (blocks \"plate\"): each element must be in exactly "
            "one, or all in none");
}

TEST(GmshErrors, ElementInTwoGroups) {
  const std::string geo = structured_plate + "Physical Surface(\"again\", 9) = {1};";
  for (const char* options : {"-format msh41", "-format msh41 -bin", "-format msh22", "-format msh22 -bin"}) {
    const std::string message = error_of_reading<2>(meshed(geo, 2, options, "twice"));
    EXPECT_THAT(message, HasSubstr("is in two groups, \"plate\" and \"again\"")) << options;
    EXPECT_THAT(message, HasSubstr("each element must be in exactly one")) << options;
  }
}

TEST(GmshErrors, TwoBlocksOfOneName) {
  const std::string names =
      replaced(replaced(two_squares_2_2, "Names\n2", "Names\n3"), "2 1 \"plate\"", "2 1 \"plate\"\n2 4 \"plate\"");
  EXPECT_THAT(error_of(replaced(names, "13 3 2 1 3", "13 3 2 4 3")),
              HasSubstr("two groups are named \"plate\": surface 1 and surface 4; give each its own name"));
}

// ---- damage ----

/// Four flavours of a mesh of two elements.
std::vector<std::string> four_flavours() {
  const std::string two_cells = replaced(replaced(structured_plate, "= 5", "= 3"), "= 4; T", "= 2; T");
  std::vector<std::string> texts;
  for (const char* options : {"-format msh41", "-format msh41 -bin", "-format msh22", "-format msh22 -bin"}) {
    texts.push_back(contents(meshed(two_cells, 2, options, "whole")));
  }
  return texts;
}

TEST(GmshDamage, AFileTruncatedAnywhereIsAnError) {
  for (const std::string& text : four_flavours()) {
    const std::size_t end = text.rfind("$EndElements") + std::string("$EndElements").size();
    for (std::size_t size = 0; size < end; size += 3) {
      EXPECT_THAT(error_of(text.substr(0, size)), Not(testing::IsEmpty()))
          << "after " << size << " of " << end << " bytes";
    }
  }
}

TEST(GmshDamage, AFileTruncatedWithinItsNodesSaysSo) {
  for (const std::string& text : four_flavours()) {
    const std::string message = error_of(text.substr(0, text.find("$EndNodes") - 10));
    EXPECT_THAT(message, HasSubstr("truncated"));
  }
}

TEST(GmshDamage, ChangedBytesNeverCrashTheReader) {
  std::mt19937 random(1);
  for (const std::string& text : four_flavours()) {
    for (int trial = 0; trial < 200; ++trial) {
      std::string damaged = text;
      for (int i = 0; i < 3; ++i) damaged[random() % damaged.size()] = static_cast<char>(random() % 256);
      const std::string file = written("damaged.msh", damaged);
      EXPECT_NO_FATAL_FAILURE(error_of_reading<2>(file));
    }
  }
}

}  // namespace
}  // namespace perimorph::mesh_files
