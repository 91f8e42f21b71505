// The gmsh reader, and running gmsh.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gmsh_files.hpp"
#include "perimorph/mesh/orientation.hpp"
#include "unit/mesh/example_meshes.hpp"

namespace perimorph::mesh_files {
namespace {

using mesh::ElementType;
using mesh::Mesh;
using mesh::Side;
using testing::ElementsAre;

struct Flavour {
  const char* name;
  const char* options;
};
constexpr std::array<Flavour, 7> flavours = {{{"msh41", "-format msh41"},
                                              {"msh41_binary", "-format msh41 -bin"},
                                              {"msh40", "-format msh40"},
                                              {"msh3", "-format msh3"},
                                              {"msh3_binary", "-format msh3 -bin"},
                                              {"msh22", "-format msh22"},
                                              {"msh22_binary", "-format msh22 -bin"}}};

template <int dim>
void expect_same_in_all_flavours(const std::string& geo) {
  const Mesh<dim> expected = read_mesh<dim>(meshed(geo, dim, flavours[0].options, flavours[0].name));
  for (const Flavour& flavour : flavours) {
    SCOPED_TRACE(flavour.name);
    expect_same(read_mesh<dim>(meshed(geo, dim, flavour.options, flavour.name)), expected);
  }
}

TEST(Gmsh, StructuredPlateIsTheSameInAllFlavours) { expect_same_in_all_flavours<2>(structured_plate); }
TEST(Gmsh, UnstructuredPlateIsTheSameInAllFlavours) { expect_same_in_all_flavours<2>(unstructured_plate); }
TEST(Gmsh, ExtrudedBlockIsTheSameInAllFlavours) { expect_same_in_all_flavours<3>(extruded_block); }

/// The numbers that mesh_files gives elements, nodes and sides, whatever their order.
template <int dim>
std::vector<std::size_t> sizes(const Mesh<dim>& mesh) {
  std::vector<std::size_t> all = {mesh.types.size(), mesh.coordinates.size(), mesh.boundary.size()};
  for (const auto& [name, nodes] : mesh.node_sets) all.push_back(nodes.size());
  for (const auto& [name, sides] : mesh.side_sets) all.push_back(sides.size());
  return all;
}

TEST(Gmsh, APartitionedMeshIsTheWholeInAllFlavours) {
  const Mesh<2> whole = read_mesh<2>(meshed(unstructured_plate, 2, "-format msh41", "whole"));
  for (const Flavour& flavour : flavours) {
    if (std::string(flavour.name).rfind("msh3", 0) == 0) continue;  // there the lines between partitions are a group
    SCOPED_TRACE(flavour.name);
    const std::string options = std::string(flavour.options) + " -part 3";
    const Mesh<2> mesh = read_mesh<2>(meshed(unstructured_plate, 2, options, flavour.name));
    EXPECT_EQ(sizes(mesh), sizes(whole));
    EXPECT_EQ(mesh.block_names, whole.block_names);
  }
}

TEST(Gmsh, APartitionedBlockIsTheWholeInThreeDimensions) {
  const Mesh<3> whole = read_mesh<3>(meshed(extruded_block, 3, "-format msh41", "whole"));
  for (const char* options : {"-format msh41 -bin -part 2", "-format msh40 -part 4", "-format msh22 -part 2"}) {
    SCOPED_TRACE(options);
    EXPECT_EQ(sizes(read_mesh<3>(meshed(extruded_block, 3, options, "parts"))), sizes(whole));
  }
}

TEST(Gmsh, StructuredPlateHasItsCellsAndGroups) {
  const Mesh<2> mesh = read_mesh<2>(meshed(structured_plate, 2, "-format msh41", "plate"));

  EXPECT_EQ(mesh.n_elements(), 12);
  EXPECT_EQ(mesh.n_nodes(), 20);
  EXPECT_THAT(mesh.types, testing::Each(ElementType::quad4));
  EXPECT_THAT(mesh.block_names, ElementsAre("plate"));
  EXPECT_EQ(mesh.node_sets.at("left").size(), 4u);
  EXPECT_EQ(mesh.side_sets.at("left").size(), 3u);
  EXPECT_EQ(mesh.node_sets.at("corner").size(), 1u);
  EXPECT_EQ(mesh.side_sets.count("corner"), 0u);
  EXPECT_EQ(mesh.boundary.size(), 14u);
  for (const int node : mesh.node_sets.at("left")) EXPECT_EQ(mesh.coordinates[node][0], 0.);
}

TEST(Gmsh, UnstructuredPlateHasBothKindsInTheirBlocks) {
  const Mesh<2> mesh = read_mesh<2>(meshed(unstructured_plate, 2, "-format msh41 -bin", "plate"));

  EXPECT_THAT(mesh.block_names, ElementsAre("soft", "stiff"));
  for (int e = 0; e < mesh.n_elements(); ++e) {
    EXPECT_EQ(mesh.blocks[e], centroid(mesh, e)[0] < 1. ? 0 : 1);
    if (mesh.blocks[e] == 0) {
      EXPECT_EQ(mesh.types[e], ElementType::tri3);
    }
  }
  EXPECT_THAT(mesh.types, testing::Contains(ElementType::quad4));
  EXPECT_EQ(mesh.side_sets.count("curve_20"), 1u) << "the group without a name";
}

TEST(Gmsh, AnInnerSideOfASetBelongsToTheLowerOfItsElements) {
  const Mesh<2> mesh = read_mesh<2>(meshed(unstructured_plate, 2, "-format msh41", "plate"));

  ASSERT_FALSE(mesh.side_sets.at("interface").empty());
  for (const Side& side : mesh.side_sets.at("interface")) {
    EXPECT_EQ(mesh.blocks[side.element], 0);
    for (const auto& point : corner_points(mesh, side)) EXPECT_DOUBLE_EQ(point[0], 1.);
  }
}

TEST(Gmsh, ExtrudedBlockHasHexahedraAndAFaceSet) {
  const Mesh<3> mesh = read_mesh<3>(meshed(extruded_block, 3, "-format msh41 -bin", "block"));

  EXPECT_EQ(mesh.n_elements(), 3 * 2 * 2);
  EXPECT_EQ(mesh.n_nodes(), 4 * 3 * 3);
  EXPECT_THAT(mesh.types, testing::Each(ElementType::hex8));
  EXPECT_EQ(mesh.side_sets.at("bottom").size(), 6u);
  EXPECT_EQ(mesh.node_sets.at("edge").size(), 4u);
  EXPECT_EQ(mesh.side_sets.count("edge"), 0u);
  EXPECT_EQ(mesh.boundary.size(), 2u * (6u + 6u + 4u));
}

TEST(Gmsh, TetrahedraAreRead) {
  const std::string geo = "SetFactory(\"OpenCASCADE\"); Box(1) = {0, 0, 0, 1, 1, 1}; Mesh.MeshSizeMax = 0.5;";
  const Mesh<3> mesh = read_mesh<3>(meshed(geo, 3, "-format msh41 -bin", "box"));
  EXPECT_THAT(mesh.types, testing::Each(ElementType::tet4));
  EXPECT_GT(mesh.n_elements(), 20);
}

TEST(Gmsh, NodesAndElementsKeepTheFilesOrder) {
  for (const auto& text : {two_squares_2_2, two_squares_4_1}) {
    const Mesh<2> mesh = read_mesh<2>(written("squares.msh", text));

    EXPECT_THAT(mesh.corners, ElementsAre(0, 1, 4, 3, 1, 2, 5, 4));
    EXPECT_THAT(mesh.node_ids, ElementsAre(0, 1, 2, 3, 4, 5));
    EXPECT_THAT(mesh.element_ids, ElementsAre(0, 1));
    EXPECT_THAT(mesh.node_sets.at("left"), ElementsAre(0, 3));
    EXPECT_THAT(mesh.side_sets.at("left"), ElementsAre(Side{0, 3}));
  }
}

TEST(Gmsh, AWholeMeshBelongsToRankZero) {
  const Mesh<2> mesh = read_mesh<2>(written("squares.msh", two_squares_2_2));

  EXPECT_EQ(mesh.rank, 0);
  EXPECT_EQ(mesh.n_owned_nodes, 6);
  EXPECT_EQ(mesh.n_owned_elements, 2);
  EXPECT_EQ(mesh.n_global_nodes, 6);
  EXPECT_EQ(mesh.n_global_elements, 2);
  EXPECT_THAT(mesh.node_owners, ElementsAre(0, 0, 0, 0, 0, 0));
  EXPECT_THAT(mesh.element_owners, ElementsAre(0, 0));
}

TEST(Gmsh, WithoutAnyGroupAllIsOneBlockCalledBody) {
  const std::string geo =
      "Point(1) = {0, 0, 0, 1}; Point(2) = {1, 0, 0, 1}; Point(3) = {0, 1, 0, 1};"
      "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 1};"
      "Curve Loop(1) = {1, 2, 3}; Plane Surface(1) = {1};\n";
  for (const Flavour& flavour : flavours) {
    const Mesh<2> mesh = read_mesh<2>(meshed(geo, 2, flavour.options, flavour.name));
    EXPECT_THAT(mesh.block_names, ElementsAre("body")) << flavour.name;
    EXPECT_TRUE(mesh.node_sets.empty()) << flavour.name;
  }
}

TEST(Gmsh, AGroupWithoutANameIsCalledByItsDimensionAndNumber) {
  const std::string text = replaced(two_squares_2_2, "2\n1 7 \"left\"\n2 1 \"plate\"\n", "0\n");

  const Mesh<2> mesh = read_mesh<2>(written("squares.msh", text));

  EXPECT_THAT(mesh.block_names, ElementsAre("surface_1"));
  EXPECT_EQ(mesh.node_sets.count("curve_7"), 1u);
}

TEST(Gmsh, UnknownSectionsAndWindowsLineEndsDoNotMatter) {
  std::string text = two_squares_4_1 + "$NodeData\n1\n\"anything\"\n$EndNodeData\n";
  for (std::size_t i = text.find('\n'); i != std::string::npos; i = text.find('\n', i + 2)) text.insert(i, "\r");
  EXPECT_EQ(read_mesh<2>(written("squares.msh", text)).n_elements(), 2);
}

TEST(Gmsh, TheMeshMayLieInAnyPlaneOfConstantZ) {
  const std::string geo =
      replaced(structured_plate, "Point(1)", "dz = 5; Point(1)") + "Translate {0, 0, dz} { Surface{1}; }";
  EXPECT_EQ(read_mesh<2>(meshed(geo, 2, "-format msh41", "raised")).n_elements(), 12);
}

// ---- what gmsh reads, too ----

TEST(Gmsh, TextIsReadAsGmshReadsIt) {
  const Mesh<2> expected = read_mesh<2>(written("squares.msh", two_squares_2_2));
  const std::vector<std::pair<std::string, std::string>> changes = {
      {"2 1 0 0", "+2 +1.0 +0e+00 -0"},
      {"4 0 1 0", "\t4   1e-400   1 1e-310"},
      {"2.2 0 8", "2.2  0   8  "},
      {"2.2 0 8", "2.10\t0 4"},
      {"$MeshFormat\n", "$Comments\n$Nodes are below\n$EndComments\n$MeshFormat\n"},
      {"$MeshFormat\n", "made by a converter\n\n$MeshFormat\n"},
      {"$Nodes\n", "\n\n  $Nodes \n\n"},
      {"$Elements\n", "$Comments\nanything\n$EndComments\na remark\n$Elements\n"},
      {"11 1 2 7 1 4 1", "11 1 2 7 1\n4\n1"},
      {"12 3 2 1 3 1 2 5 4", "12 3 3 1 3 1 1 2 5 4"},
      {"\"left\"", "left"},
      {"\"left\"", "  left\t"},
      {"\"left\"", "\"left\" the wall"},
  };
  for (const auto& [from, to] : changes) {
    SCOPED_TRACE(to);
    const Mesh<2> mesh = read_mesh<2>(written("changed.msh", replaced(two_squares_2_2, from, to)));
    EXPECT_EQ(mesh.corners, expected.corners);
    EXPECT_EQ(mesh.block_names, expected.block_names);
    EXPECT_EQ(mesh.side_sets.at("left"), expected.side_sets.at("left"));
  }
}

TEST(Gmsh, NamesOfVersion20HaveNoDimension) {
  std::string text = replaced(two_squares_2_2, "2.2 0 8", "2 0 8");
  text = replaced(text, "1 7 \"left\"\n2 1 \"plate\"", "7 \"left\"\n1 \"plate\"");
  const Mesh<2> mesh = read_mesh<2>(written("squares.msh", text));
  EXPECT_THAT(mesh.block_names, ElementsAre("plate"));
  EXPECT_EQ(mesh.side_sets.at("left").size(), 1u);
}

/// One section, from its name to its end.
std::string section(const std::string& text, const std::string& name) {
  const std::string end = "$End" + name + "\n";
  const std::size_t begin = text.find("$" + name), stop = text.find(end) + end.size();
  return text.substr(begin, stop - begin);
}

TEST(Gmsh, SectionsMayComeInAnyOrder) {
  for (const std::string& text : {two_squares_2_2, two_squares_4_1}) {
    const Mesh<2> expected = read_mesh<2>(written("squares.msh", text));
    for (const char* name : {"PhysicalNames", "Nodes", "Entities"}) {
      if (text.find(std::string("$") + name) == std::string::npos) continue;
      const std::string moved = section(text, name);
      expect_same(read_mesh<2>(written("moved.msh", replaced(text, moved, "") + moved)), expected);
    }
  }
}

TEST(Gmsh, ElementsOfSecondOrderAreTakenByTheirCorners) {
  const Mesh<2> expected = read_mesh<2>(meshed(unstructured_plate, 2, "-format msh41", "first"));
  for (const Flavour& flavour : flavours) {
    for (const char* incomplete : {"0", "1"}) {
      SCOPED_TRACE(flavour.name);
      const std::string options =
          fmt::format("{} -order 2 -setnumber Mesh.SecondOrderIncomplete {}", flavour.options, incomplete);
      const std::string file = meshed(unstructured_plate, 2, options, "second");
      const Mesh<2> mesh = read_mesh<2>(file);
      EXPECT_EQ(sizes(mesh), sizes(expected));
      ASSERT_EQ(mesh.notes.size(), 1u);
      EXPECT_THAT(mesh.notes[0], testing::HasSubstr(fmt::format(
                                     "{0} of {0} elements are of second order: they are taken", mesh.n_elements())));
    }
  }
  const Mesh<3> block = read_mesh<3>(meshed(extruded_block, 3, "-format msh41 -bin -order 2", "block"));
  EXPECT_EQ(sizes(block), sizes(read_mesh<3>(meshed(extruded_block, 3, "-format msh41", "first"))));
  EXPECT_THAT(block.notes[0],
              testing::HasSubstr("and 139 nodes between the corners are dropped"));  // 7 * 5 * 5 - 4 * 3 * 3
}

// ---- what is mended, with a note ----

TEST(Gmsh, ReversedElementsAreTurned) {
  const std::string one = replaced(two_squares_2_2, "1 2 5 4", "4 5 2 1"), all = replaced(one, "2 3 6 5", "5 6 3 2");
  for (const auto& [text, note] : {std::pair<std::string, std::string>{one, "1 of 2"}, {all, "2 of 2"}}) {
    const std::string file = written("squares.msh", text);
    const Mesh<2> mesh = read_mesh<2>(file);
    for (int e = 0; e < 2; ++e) EXPECT_DOUBLE_EQ(smallest_corner_volume(mesh, e), 1.);
    EXPECT_EQ(mesh.boundary.size(), 6u);
    EXPECT_EQ(corner_points(mesh, mesh.side_sets.at("left")[0])[1][0], 0.);
    EXPECT_EQ(notes_of(mesh, file),
              note + " elements have their nodes in reversed order and are turned (the first is element 12)\n");
  }
}

/// All kinds of solids, each mirrored by exchanging the ends of a direction: x and z.
TEST(Gmsh, ReversedSolidsOfEveryKindAreTurned) {
  const std::vector<std::pair<std::string, std::string>> solids = {
      {"5 2 1 1 1 2 3 4 5 6 7 8", "5 2 1 1 5 6 7 8 1 2 3 4"},
      {"4 2 1 1 1 2 4 5", "4 2 1 1 2 1 4 5"},
      {"6 2 1 1 1 2 4 5 6 8", "6 2 1 1 5 6 8 1 2 4"},
      {"7 2 1 1 1 2 3 4 5", "7 2 1 1 4 3 2 1 5"}};
  for (const auto& [right, reversed] : solids) {
    SCOPED_TRACE(reversed);
    const auto text = [](const std::string& element) {
      return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n8\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n"
             "6 1 0 1\n7 1 1 1\n8 0 1 1\n$EndNodes\n$Elements\n1\n1 " +
             element + "\n$EndElements\n";
    };
    const Mesh<3> a = read_mesh<3>(written("right.msh", text(right)));
    const Mesh<3> b = read_mesh<3>(written("reversed.msh", text(reversed)));
    EXPECT_GT(smallest_corner_volume(b, 0), 0.1);
    EXPECT_GT(smallest_corner_volume(a, 0), 0.1);
    EXPECT_EQ(b.notes.size(), a.notes.size() + 1);
  }
}

TEST(Gmsh, AReversedSurfaceIsTurned) {
  const std::string reversed = replaced(structured_plate, "{1, 2, 3, 4}; Plane", "{-4, -3, -2, -1}; Plane");
  const Mesh<2> mesh = read_mesh<2>(meshed(reversed, 2, "-format msh41", "reversed"));
  EXPECT_EQ(mesh.n_elements(), 12);
  EXPECT_THAT(mesh.notes, ElementsAre(testing::HasSubstr(": 12 of 12 elements have their nodes in reversed order")));
}

TEST(Gmsh, NodesThatNoElementUsesAreDropped) {
  const std::string text =
      replaced(replaced(two_squares_2_2, "$Nodes\n6\n", "$Nodes\n8\n77 5 5 5\n"), "6 2 1 0\n", "6 2 1 0\n78 6 6 0\n");
  const std::string file = written("squares.msh", text);
  const Mesh<2> mesh = read_mesh<2>(file);
  EXPECT_THAT(mesh.corners, ElementsAre(0, 1, 4, 3, 1, 2, 5, 4));
  EXPECT_THAT(mesh.node_sets.at("left"), ElementsAre(0, 3));
  EXPECT_EQ(notes_of(mesh, file), "dropped: 2 nodes in no 2D element (77, 78)\n");
}

TEST(Gmsh, TheCentreOfACircleInAPhysicalGroupIsLeftOut) {
  const std::string geo = unstructured_plate + "Physical Point(\"centre\") = {7}; Mesh.SaveAll = 0;";
  const Mesh<2> mesh = read_mesh<2>(meshed(geo, 2, "-format msh41", "centre"));
  EXPECT_EQ(mesh.node_sets.count("centre"), 0u);
  EXPECT_THAT(mesh.notes,
              ElementsAre(testing::HasSubstr("dropped: 1 node in no 2D element"),
                          testing::HasSubstr("the group \"centre\" is left out: no 2D element has a node")));
}

TEST(Gmsh, ASetWhoseLinesAreNoSidesKeepsItsNodes) {
  const std::string file = written("squares.msh", replaced(two_squares_2_2, "11 1 2 7 1 4 1", "11 1 2 7 1 4 2"));
  const Mesh<2> mesh = read_mesh<2>(file);
  EXPECT_EQ(mesh.side_sets.count("left"), 0u);
  EXPECT_THAT(mesh.node_sets.at("left"), ElementsAre(1, 3));
  EXPECT_EQ(notes_of(mesh, file),
            "the group \"left\" has nodes but no sides: element 11 of it is no side of any 2D element\n");
}

}  // namespace
}  // namespace perimorph::mesh_files
