// What Exodus files have of their own: ids, shells, bars, the numbering of sides.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gmsh_files.hpp"
#include "mesh_writers.hpp"
#include "unit/mesh/example_meshes.hpp"

namespace perimorph::mesh_files {
namespace {

using mesh::ElementType;
using mesh::Mesh;
using mesh::Side;
using testing::ElementsAre;

/// An Exodus file with numbers of 64 bits and no names. Returns its name.
std::string exodus_file(const Points& points, const std::vector<Block>& blocks, const std::vector<Sides>& sets,
                        const std::vector<std::int64_t>& node_set = {}) {
  std::string name = test_file("mesh.e");
  write_exodus_parts(name, points, blocks, sets, node_set);
  return name;
}

const Points two_cubes = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0},
                          {0, 0, 1}, {1, 0, 1}, {2, 0, 1}, {0, 1, 1}, {1, 1, 1}, {2, 1, 1}};
const Block hexahedra = {1, "HEX8", 8, {1, 2, 5, 4, 7, 8, 11, 10, 2, 3, 6, 5, 8, 9, 12, 11}};

TEST(Exodus, BlocksAndSetsHaveIdsOfTheirOwnOf64Bits) {
  const std::int64_t large = 6000000000;
  const Mesh<3> mesh =
      read_mesh<3>(exodus_file(two_cubes,
                               {{1, "HEX8", 8, {1, 2, 5, 4, 7, 8, 11, 10}},
                                {large, "HEX8", 8, {2, 3, 6, 5, 8, 9, 12, 11}},
                                {2, "SHELL4", 4, {7, 8, 11, 10}}},
                               {{1, {1}, {4}}, {2, {2}, {2}}, {large, {1, 2}, {5, 5}}, {large + 1, {2}, {6}}}));
  EXPECT_THAT(mesh.block_names, ElementsAre("block_1", "block_6000000000"));
  EXPECT_THAT(mesh.side_sets.at("sides_1"), ElementsAre(Side{0, 3}));
  EXPECT_THAT(mesh.side_sets.at("sides_2"), ElementsAre(Side{1, 1}));
  EXPECT_EQ(mesh.side_sets.at("sides_6000000000").size(), 2u);
  EXPECT_THAT(mesh.side_sets.at("sides_6000000001"), ElementsAre(Side{1, 5}));
  EXPECT_THAT(mesh.side_sets.at("block_2"), ElementsAre(Side{0, 5})) << "the shell";
}

TEST(Exodus, AFaceOfAShellBesideSolidsIsASide) {
  for (const std::int64_t face : {1, 2}) {
    const Mesh<3> mesh = read_mesh<3>(
        exodus_file(two_cubes, {hexahedra, {2, "SHELL4", 4, {7, 8, 11, 10}}}, {{10, {1}, {4}}, {20, {3}, {face}}}));
    EXPECT_THAT(mesh.side_sets.at("sides_20"), ElementsAre(Side{0, 5}));
    EXPECT_THAT(mesh.notes,
                ElementsAre(testing::HasSubstr("1 plane elements (shells) have no body in three dimensions")));
  }
}

TEST(Exodus, ASetThatDoesNotFitIsLeftOutWithItsReason) {
  const std::string file = exodus_file(two_cubes, {hexahedra}, {{1, {1}, {7}}, {2, {2}, {2}}});
  const Mesh<3> mesh = read_mesh<3>(file);
  EXPECT_EQ(mesh.side_sets.count("sides_1"), 0u);
  EXPECT_EQ(mesh.side_sets.count("sides_2"), 1u);
  EXPECT_EQ(notes_of(mesh, file),
            "the side set \"sides_1\" is left out: it has side 7 of element 1, which is none of its edges or faces\n");
}

TEST(Exodus, BlocksWithoutABodyArePassedOver) {
  Points points = two_cubes;
  points.push_back({5, 5, 5});
  const std::string file = exodus_file(points,
                                       {{7, "SPHERE", 1, {13}},
                                        hexahedra,
                                        {8, "BAR2", 2, {1, 2, 2, 3}},
                                        {9, "beam", 2, {1, 4}},
                                        {10, "TRUSS", 2, {1, 5}}},
                                       {{1, {2}, {4}}, {2, {4}, {1}}});  // numbers count all elements
  const Mesh<3> mesh = read_mesh<3>(file);
  EXPECT_EQ(mesh.n_elements(), 2);
  EXPECT_THAT(mesh.block_names, ElementsAre("block_1"));
  EXPECT_THAT(mesh.side_sets.at("sides_1"), ElementsAre(Side{0, 3}));
  EXPECT_EQ(notes_of(mesh, file),
            "the block \"block_7\" is passed over: its 1 elements of type \"SPHERE\" have no body\n"
            "the block \"block_8\" is passed over: its 2 elements of type \"BAR2\" have no body\n"
            "the block \"block_9\" is passed over: its 1 elements of type \"beam\" have no body\n"
            "the block \"block_10\" is passed over: its 1 elements of type \"TRUSS\" have no body\n"
            "the side set \"sides_2\" is left out: it has side 1 of element 4, which is none of its edges or faces\n"
            "dropped: 1 node in no 3D element (13)\n");
}

/// A type of plane elements, and which of their sides is the first edge.
struct Numbering {
  const char* type;
  std::int64_t first_edge;
};
const Points square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

TEST(Exodus, SidesOfTrianglesInThreeDimensionsAreEdgesByWhicheverNumbering) {
  for (const auto& [type, e] : {Numbering{"TRI3", 1}, {"TRI3", 3}, {"TRISHELL3", 1}, {"tri", 3}}) {
    SCOPED_TRACE(fmt::format("{} {}", type, e));
    const Mesh<2> mesh =
        read_mesh<2>(exodus_file(square, {{1, type, 3, {1, 2, 3, 1, 3, 4}}},
                                 {{1, {1}, {e}}, {2, {1}, {e + 1}}, {3, {2}, {e + 1}}, {4, {2}, {e + 2}}}));
    EXPECT_THAT(mesh.side_sets.at("sides_1"), ElementsAre(Side{0, 0}));
    EXPECT_THAT(mesh.side_sets.at("sides_3"), ElementsAre(Side{1, 1}));
    EXPECT_THAT(mesh.side_sets.at("sides_4"), ElementsAre(Side{1, 2}));
    EXPECT_EQ(mesh.notes.size(), e == 1 ? 1u : 0u);
  }
}

TEST(Exodus, SidesOfQuadranglesInThreeDimensionsAreEdgesByWhicheverNumbering) {
  for (const auto& [type, e] : {Numbering{"QUAD4", 1}, {"QUAD4", 3}, {"SHELL4", 1}, {"SHELL", 3}}) {
    SCOPED_TRACE(fmt::format("{} {}", type, e));
    const Mesh<2> mesh =
        read_mesh<2>(exodus_file(square, {{1, type, 4, {1, 2, 3, 4}}},
                                 {{1, {1}, {e}}, {2, {1}, {e + 1}}, {3, {1}, {e + 2}}, {4, {1}, {e + 3}}}));
    for (int side = 0; side < 4; ++side) {
      EXPECT_THAT(mesh.side_sets.at(fmt::format("sides_{}", side + 1)), ElementsAre(Side{0, side}));
    }
  }
}

TEST(Exodus, ElementsOfSecondOrderAreTakenByTheirCorners) {
  Points points = two_cubes;
  for (int i = 0; i < 12; ++i) points.push_back({0.5, 0.5, 0.1 * i});
  const std::string file = exodus_file(
      points, {{1, "HEX20", 20, {1, 2, 5, 4, 7, 8, 11, 10, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24}}},
      {{1, {1}, {4}}});
  const Mesh<3> mesh = read_mesh<3>(file);
  EXPECT_THAT(mesh.types, ElementsAre(ElementType::hex8));
  EXPECT_EQ(mesh.n_nodes(), 8);
  EXPECT_THAT(mesh.side_sets.at("sides_1"), ElementsAre(Side{0, 3}));
  EXPECT_EQ(notes_of(mesh, file),
            "1 of 1 elements are of second order: they are taken by their corners, with straight edges, and 12 nodes "
            "between the corners are dropped\n"
            "dropped: 4 nodes in no 3D element (3, 6, 9, 12)\n");
}

/// As libMesh writes them: the node set also has the nodes between the corners.
TEST(Exodus, ANodeSetOfSecondOrderIsTheSideSetOfItsName) {
  const Points points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {.5, 0, 0}, {1, .5, 0}, {.5, 1, 0}, {0, .5, 0}};
  const std::string file = exodus_file(points, {{1, "QUAD8", 8, {1, 2, 3, 4, 5, 6, 7, 8}}}, {{1, {1}, {1}}}, {1, 2, 5});
  {
    const ExodusWriter writer(file);
    writer.check(ex_put_name(writer.id(), EX_SIDE_SET, 1, "bottom"));
    writer.check(ex_put_name(writer.id(), EX_NODE_SET, 1, "bottom"));
  }
  const Mesh<2> mesh = read_mesh<2>(file);
  EXPECT_THAT(mesh.node_sets.at("bottom"), ElementsAre(0, 1));
  EXPECT_THAT(mesh.side_sets.at("bottom"), ElementsAre(Side{0, 0}));
}

TEST(Exodus, NumbersOfNodesThatOccurTwiceDoNotMatter) {
  const std::string name = exodus_file(two_cubes, {hexahedra}, {{1, {1}, {4}}});
  {
    const ExodusWriter file(name);
    const std::vector<std::int64_t> zeros(12, 0);
    file.check(ex_put_id_map(file.id(), EX_NODE_MAP, zeros.data()));
  }
  EXPECT_EQ(read_mesh<3>(name).n_nodes(), 12);
}

}  // namespace
}  // namespace perimorph::mesh_files
