// Input files of Abaqus.

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
using testing::HasSubstr;

/// Two unit squares beside each other, without parts.
const std::string two_squares = R"(*Heading
 two squares, ** this is a title
**
*NODE, NSET=all
 1, 0., 0.
 2, 1.
 3, 2., 0., 0.
14, 0., 1.
15, 1.0D0, +1.
16, 2., 1.,
*Element, type=CPS4R, elset=left
101, 1, 2, 15, 14
*ELEMENT, TYPE = cps4, ELSET = "right one"
102, 2, 3,
 16, 15
*NSET, NSET=TOP
14, 15,
16
*Nset, nset=BOTTOM, generate
1, 3, 1
*SURFACE, TYPE=ELEMENT, NAME=wall
left, S4
*Surface, name=outline
left
102,
*MATERIAL, NAME=steel
*ELASTIC
210000., 0.3
*STEP
*NSET, NSET=later
1
*END STEP
)";

TEST(Abaqus, NodesElementsSetsAndSurfacesAreRead) {
  const Mesh<2> mesh = read_mesh<2>(written("squares.inp", two_squares));

  EXPECT_THAT(mesh.corners, ElementsAre(0, 1, 4, 3, 1, 2, 5, 4));
  EXPECT_EQ(mesh.coordinates[4], base::Point<2>(1., 1.));
  EXPECT_THAT(mesh.block_names, ElementsAre("left", "right one"));
  EXPECT_THAT(mesh.node_sets.at("TOP"), ElementsAre(3, 4, 5));
  EXPECT_THAT(mesh.side_sets.at("TOP"), ElementsAre(Side{0, 2}, Side{1, 2}));
  EXPECT_THAT(mesh.side_sets.at("BOTTOM"), ElementsAre(Side{0, 0}, Side{1, 0}));
  EXPECT_THAT(mesh.side_sets.at("wall"), ElementsAre(Side{0, 3}));
  EXPECT_EQ(mesh.side_sets.at("outline").size(), 6u);
  EXPECT_EQ(mesh.node_sets.at("all").size(), 6u);
  EXPECT_EQ(mesh.node_sets.count("later"), 0u);
  EXPECT_THAT(mesh.notes, testing::IsEmpty());
}

TEST(Abaqus, WaysOfWritingOneThingAreReadAlike) {
  const Mesh<2> expected = read_mesh<2>(written("squares.inp", two_squares));
  const std::vector<std::pair<std::string, std::string>> changes = {
      {"*Element, type=CPS4R, elset=left", "*Element, type=CPS4R,\n elset=left"},
      {"*Element, type=CPS4R, elset=left", "** a comment\n* ELEMENT,TYPE=CPE4H,ELSET=left"},
      {"101, 1, 2, 15, 14", "  +101 ,1,  2,15\t,14,\n\n"},
      {"*Nset, nset=BOTTOM, generate\n1, 3, 1",
       "*NSET, GENERATE, NSET=bottom_left\n1, 2\n*NSET, NSET=BOTTOM\nBottom_Left, 3"},
      {"*NSET, NSET=TOP\n14, 15,\n16", "*NSET, NSET=TOP, UNSORTED\n16, 14\n*NSET, NSET=top\n15"},
      {"left, S4", "101, s4"},
      {"*STEP",
       "*SOLID SECTION, ELSET=left, MATERIAL=steel\n1.,\n*Solid Section, elset=\"RIGHT ONE\", material=steel\n*STEP"},
      {"*MATERIAL", "*ELEMENT, TYPE=MASS, ELSET=m\n900, 1\n*MATERIAL"}};
  for (const auto& [from, to] : changes) {
    SCOPED_TRACE(to);
    const Mesh<2> mesh = read_mesh<2>(written("changed.inp", replaced(two_squares, from, to)));
    EXPECT_EQ(mesh.corners, expected.corners);
    EXPECT_EQ(mesh.coordinates, expected.coordinates);
    EXPECT_EQ(mesh.block_names, expected.block_names);
    for (const auto& [name, sides] : expected.side_sets) EXPECT_EQ(mesh.side_sets.at(name), sides) << name;
  }
}

TEST(Abaqus, WindowsLineEndsDoNotMatter) {
  std::string text = two_squares;
  for (std::size_t i = text.find('\n'); i != std::string::npos; i = text.find('\n', i + 2)) text.insert(i, "\r");
  expect_same(read_mesh<2>(written("windows.inp", text)), read_mesh<2>(written("squares.inp", two_squares)));
}

/// A part, placed twice by the assembly: as it is, and beside it, turned by 90 degrees about the z axis.
const std::string two_instances = R"(*Heading
*Part, name=Tile
*Node
      1,           0.,           0.
      2,           1.,           0.
      3,           1.,           1.
      4,           0.,           1.
*Element, type=CPE3
1, 1, 2, 3
2, 1, 3, 4
*Elset, elset=Body, generate
 1,  2,  1
*Nset, nset=Base
 1, 2
*Solid Section, elset=Body, material=Glass
,
*End Part
*Assembly, name=Assembly
*Instance, name=Tile-1, part=Tile
*End Instance
*Instance, name=Tile-2, part=TILE
          2.,           0.,           0.
          2.,           0.,           0.,           2.,           0.,           1.,          90.
*End Instance
*Node
      1,           9.,           9.,           0.
*Nset, nset=Point
 1,
*Nset, nset=Both, instance=Tile-1
 1, 2
*Nset, nset=Both, instance=Tile-2
 4
*Elset, elset=_Wall_S2, internal, instance=Tile-1
 1,
*Surface, type=ELEMENT, name=Wall
_Wall_S2, S2
*Surface, type=NODE, name=Nodes
Tile-2.Base, 1.
*End Assembly
)";

TEST(Abaqus, InstancesAreMovedAndTurned) {
  const std::string file = written("tiles.inp", two_instances);
  const Mesh<2> mesh = read_mesh<2>(file);

  EXPECT_EQ(mesh.n_elements(), 4);
  EXPECT_EQ(mesh.n_nodes(), 8);
  const std::vector<base::Point<2>> expected = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0}, {2, 1}, {1, 1}, {1, 0}};
  for (std::size_t n = 0; n < expected.size(); ++n) EXPECT_LT((mesh.coordinates[n] - expected[n]).norm(), 1e-14) << n;
  EXPECT_THAT(mesh.block_names, ElementsAre("Tile-1.Body", "Tile-2.Body"));
  EXPECT_THAT(mesh.node_sets.at("Tile-1.Base"), ElementsAre(0, 1));
  EXPECT_THAT(mesh.node_sets.at("Tile-2.Base"), ElementsAre(4, 5));
  EXPECT_THAT(mesh.node_sets.at("Both"), ElementsAre(0, 1, 7));
  EXPECT_THAT(mesh.node_sets.at("Nodes"), ElementsAre(4, 5));
  EXPECT_THAT(mesh.side_sets.at("Wall"), ElementsAre(Side{0, 1}));
  EXPECT_THAT(notes_of(mesh, file), HasSubstr("dropped: 1 node in no 2D element"));
}

TEST(Abaqus, SetsOfTheOnlyInstanceKeepTheirNames) {
  const std::size_t begin = two_instances.find("*Instance, name=Tile-2"), end = two_instances.find("*Node\n", begin);
  std::string text = two_instances.substr(0, begin) + two_instances.substr(end);
  text = replaced(text, "*Nset, nset=Both, instance=Tile-2\n 4\n", "");
  const Mesh<2> mesh = read_mesh<2>(written("tile.inp", replaced(text, "Tile-2.Base", "Tile-1.BASE")));
  EXPECT_THAT(mesh.block_names, ElementsAre("Body"));
  EXPECT_THAT(mesh.node_sets.at("Base"), ElementsAre(0, 1));
  EXPECT_THAT(mesh.node_sets.at("Nodes"), ElementsAre(0, 1));
}

/// Abaqus/CAE writes the mesh of an independent instance into the instance.
TEST(Abaqus, AMeshMayStandInTheInstance) {
  const std::size_t begin = two_instances.find("*Node"), end = two_instances.find("*End Part");
  const std::string mesh_of_part = two_instances.substr(begin, end - begin);
  std::string text = replaced(two_instances, mesh_of_part, "");
  text = replaced(text, "part=Tile\n", "part=Tile\n0., 0., 0.\n" + mesh_of_part);
  text = replaced(text, "90.\n", "90.\n" + mesh_of_part);
  expect_same(read_mesh<2>(written("in_instance.inp", text)), read_mesh<2>(written("tiles.inp", two_instances)));
}

/// Every shape in three dimensions with each of its sides in a surface of its own.
TEST(Abaqus, SidesOfSolidsAreThoseThatTheManualNumbers) {
  const std::string nodes =
      "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, 0, 0, 1\n6, 1, 0, 1\n7, 1, 1, 1\n8, 0, 1, 1\n";
  struct Solid {
    const char* type;
    const char* element;
    std::vector<std::set<int>> sides;  // numbers of nodes
  };
  const std::vector<Solid> solids = {
      {"C3D8",
       "1, 2, 3, 4, 5, 6, 7, 8",
       {{1, 2, 3, 4}, {5, 6, 7, 8}, {1, 2, 5, 6}, {2, 3, 6, 7}, {3, 4, 7, 8}, {4, 1, 8, 5}}},
      {"C3D4", "1, 2, 4, 5", {{1, 2, 4}, {1, 5, 2}, {2, 5, 4}, {4, 5, 1}}},
      {"C3D6", "1, 2, 4, 5, 6, 8", {{1, 2, 4}, {5, 8, 6}, {1, 5, 6, 2}, {2, 6, 8, 4}, {4, 8, 5, 1}}},
      {"C3D5", "1, 2, 3, 4, 5", {{1, 2, 3, 4}, {1, 2, 5}, {2, 3, 5}, {3, 4, 5}, {4, 1, 5}}}};
  for (const Solid& solid : solids) {
    std::string text = nodes + "*ELEMENT, TYPE=" + solid.type + ", ELSET=e\n1, " + solid.element + "\n";
    for (std::size_t s = 1; s <= solid.sides.size(); ++s) text += fmt::format("*SURFACE, NAME=S{}\ne, S{}\n", s, s);
    const Mesh<3> mesh = read_mesh<3>(written("solid.inp", text));
    EXPECT_GT(smallest_corner_volume(mesh, 0), 0.1);
    std::vector<int> number = {1, 2, 3, 4, 5, 6, 7, 8};
    if (std::string(solid.type) != "C3D8") {
      number.clear();
      for (const auto& x : mesh.coordinates) {
        number.push_back(x[2] == 0. ? (x[1] == 0. ? 1 + static_cast<int>(x[0]) : 4 - static_cast<int>(x[0]))
                                    : (x[1] == 0. ? 5 + static_cast<int>(x[0]) : 8 - static_cast<int>(x[0])));
      }
    }
    for (std::size_t s = 0; s < solid.sides.size(); ++s) {
      std::set<int> found;
      for (const int node : mesh.node_sets.at(fmt::format("S{}", s + 1))) found.insert(number[node]);
      EXPECT_EQ(found, solid.sides[s]) << solid.type << " S" << s + 1;
      EXPECT_EQ(mesh.side_sets.at(fmt::format("S{}", s + 1)).size(), 1u);
    }
  }
}

TEST(Abaqus, ElementsOfSecondOrderAreTakenByTheirCorners) {
  const std::string text =
      "*NODE\n1,0,0\n2,1,0\n3,1,1\n4,0,1\n5,.5,0\n6,1,.5\n7,.5,1\n8,0,.5\n*NSET,NSET=bottom\n1,5,2\n"
      "*ELEMENT,TYPE=CPS8R,ELSET=plate\n1,1,2,3,4,\n5,6,7,8\n*SURFACE,NAME=right\n plate,S2\n"
      "*NSET,NSET=right\n2,3,6\n";
  const std::string file = written("second.inp", text);
  const Mesh<2> mesh = read_mesh<2>(file);
  EXPECT_THAT(mesh.corners, ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(mesh.side_sets.at("bottom"), ElementsAre(Side{0, 0}));
  EXPECT_THAT(mesh.side_sets.at("right"), ElementsAre(Side{0, 1}));
  EXPECT_EQ(notes_of(mesh, file),
            "1 of 1 elements are of second order: they are taken by their corners, with straight edges, and 4 nodes "
            "between the corners are dropped\n");
}

TEST(Abaqus, ElementsForOtherFieldsHaveTheSameShapes) {
  const Mesh<2> expected = read_mesh<2>(written("squares.inp", two_squares));
  for (const char* type : {"DC2D4", "S4R", "CPS4T", "CPE4H", "M3D4"}) {
    const std::string text = replaced(replaced(two_squares, "CPS4R", type), "cps4", type);
    expect_same(read_mesh<2>(written("others.inp", text)), expected);
  }
  const std::string cube =
      "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n*ELEMENT,TYPE=C3D8,ELSET=e\n"
      "1,1,2,3,4,5,6,7,8\n";
  for (const char* type : {"DC3D8", "C3D8RT", "SC8R"}) {
    expect_same(read_mesh<3>(written("others.inp", replaced(cube, "C3D8", type))),
                read_mesh<3>(written("cube.inp", cube)));
  }
}

/// As gmsh writes them: its lower elements with sets, and everything else.
TEST(Abaqus, WhatGmshWritesIsRead) {
  const std::string geo = replaced(structured_plate, "Physical", "Mesh.SaveGroupsOfNodes = 1; Physical");
  const Mesh<2> expected = read_mesh<2>(meshed(geo, 2, "-format msh41", "plate"));
  const std::string msh = meshed(geo, 2, "-format inp", "plate"), file = written("plate.inp", contents(msh));
  const Mesh<2> mesh = read_mesh<2>(file);
  EXPECT_EQ(mesh.corners, expected.corners);
  EXPECT_EQ(mesh.node_sets.at("left"), expected.node_sets.at("left"));
  EXPECT_EQ(mesh.side_sets.at("left"), expected.side_sets.at("left"));
}

TEST(Abaqus, ElementsWithoutABodyArePassedOver) {
  const std::string text = replaced(two_squares, "*NSET, NSET=TOP",
                                    "*ELEMENT, TYPE=SPRINGA\n201, 1, 2\n202, 1, 3\n*ELEMENT, TYPE=B21, "
                                    "ELSET=beam\n203, 1, 2\n*ELEMENT,TYPE=D\n204,1,2,3\n"
                                    "*NSET, NSET=TOP");
  const std::string file = written("springs.inp", text);
  EXPECT_EQ(notes_of(read_mesh<2>(file), file),
            "1 elements of type B21, which have no body, are passed over\n"
            "1 elements of type D, which have no body, are passed over\n"
            "2 elements of type SPRINGA, which have no body, are passed over\n");
}

TEST(Abaqus, OtherFilesAreIncluded) {
  const Mesh<2> expected = read_mesh<2>(written("squares.inp", two_squares));
  const std::size_t begin = two_squares.find(" 1, 0."), end = two_squares.find("*Element");
  written("nodes.txt", two_squares.substr(begin, end - begin));
  const std::string nodes = two_squares.substr(begin, end - begin);
  expect_same(read_mesh<2>(written("a.inp", replaced(two_squares, nodes, "*INCLUDE, INPUT=nodes.txt\n"))), expected);
  const std::string both = "*NODE, NSET=all\n" + nodes;
  expect_same(read_mesh<2>(written("b.inp", replaced(two_squares, both, "*NODE, NSET=all, INPUT=\"nodes.txt\"\n"))),
              expected);
  written("c.txt", two_squares);
  expect_same(read_mesh<2>(written("c.inp", "*include, input=c.txt\n")), expected);
}

// ---- errors ----

std::string error_of(const std::string& text) {
  const std::string file = written("mesh.inp", text), message = error_of_reading<2>(file);
  EXPECT_THAT(message, testing::StartsWith(file + ":"));
  return message.substr(std::min(message.size(), file.size()));
}

TEST(AbaqusErrors, TheFile) {
  EXPECT_EQ(error_of(""), ": the file is empty; an input file of Abaqus is needed");
  EXPECT_EQ(error_of("*HEADING\n"), ": the mesh has no elements");
  EXPECT_THAT(error_of(replaced(two_squares, "14, 15,\n16", "14, 15.5")),
              HasSubstr("the set \"15.5\" is not defined before it is used"));
  EXPECT_THAT(error_of(replaced(two_squares, " 2, 1.", " 2, 1,x")), HasSubstr(":6: a number expected, found \"x\""));
  EXPECT_THAT(error_of(replaced(two_squares, " 2, 1.", " -2, 1.")),
              HasSubstr(":6: a whole number from 1 to 999999999 expected, found \"-2\""));
  EXPECT_THAT(error_of(replaced(two_squares, "2, 15, 14", "2, 99, 14")),
              HasSubstr("element 101 has node 99, which the file does not list"));
  EXPECT_THAT(error_of(replaced(two_squares, "102, 2, 3", "101, 2, 3")), HasSubstr("two elements have the number 101"));
}

TEST(AbaqusErrors, Elements) {
  EXPECT_THAT(
      error_of(replaced(two_squares, "CPS4R", "CAX4")),
      HasSubstr("elements of type \"CAX4\"; allowed are C3D4, C3D5, C3D6, C3D8, CPS3, CPS4, CPE3, CPE4, shells"));
  EXPECT_THAT(error_of(replaced(two_squares, "CPS4R", "C3D27")), HasSubstr("elements of type \"C3D27\""));
  EXPECT_THAT(error_of(replaced(two_squares, "101, 1, 2, 15, 14", "101, 1, 2, 15")),
              HasSubstr("an element with 3 nodes; its type has 4"));
}

TEST(AbaqusErrors, SolidsWithoutAGroupInAPlaneCase) {
  EXPECT_THAT(error_of_reading<2>(written(
                  "tetrahedron.inp", "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*ELEMENT,TYPE=C3D4\n1,1,2,3,4\n")),
              HasSubstr("the mesh has no elements of dimension 2, its highest is 3"));
}

TEST(AbaqusErrors, AShellOverElements) {
  const std::string text =
      "*NODE\n1,0,0\n2,1,0\n3,1,1\n4,0,1\n*ELEMENT,TYPE=CPE3\n1,1,2,3\n2,1,3,4\n*ELEMENT,TYPE=S4\n3,1,2,3,4\n";
  EXPECT_THAT(error_of_reading<2>(written("skin.inp", text)),
              HasSubstr("elements 1 and 3 lie on the same side of the side they share: they overlap"));
}

TEST(AbaqusErrors, WhatAbaqusItselfWouldMake) {
  for (const char* keyword : {"NGEN", "NFILL", "ELGEN", "NCOPY", "SYSTEM"}) {
    EXPECT_THAT(error_of(replaced(two_squares, "*MATERIAL", std::string("*") + keyword + "\n1, 2\n*MATERIAL")),
                HasSubstr("leaves making or moving nodes to Abaqus; allowed is a file in which they are written out"));
  }
  EXPECT_THAT(error_of(replaced(two_squares, "NSET=all", "SYSTEM=C")),
              HasSubstr("cylindrical or spherical coordinates"));
}

TEST(AbaqusErrors, PartsAndInstances) {
  EXPECT_THAT(error_of(replaced(two_instances, "part=TILE", "part=Other")),
              HasSubstr("*INSTANCE of the part \"Other\", which is not defined"));
  EXPECT_THAT(error_of(replaced(two_instances, "name=Tile-2", "name=TILE-1")), HasSubstr("two instances are called"));
  EXPECT_THAT(error_of(replaced(two_instances, "instance=Tile-2", "instance=Tile-3")),
              HasSubstr("INSTANCE=\"Tile-3\" is not defined"));
  EXPECT_THAT(error_of(two_instances.substr(0, two_instances.find("*Assembly"))),
              HasSubstr("there are parts, but no *INSTANCE places one"));
  EXPECT_THAT(error_of(two_instances.substr(0, two_instances.find("*End Part"))), HasSubstr("it is truncated"));
}

TEST(AbaqusErrors, FilesThatCannotBeIncluded) {
  EXPECT_THAT(error_of("*INCLUDE, INPUT=nowhere.txt\n"), HasSubstr("what is to be included cannot be read"));
  EXPECT_THAT(error_of("*INCLUDE\n"), HasSubstr("without a readable name of a file"));
  EXPECT_THAT(error_of("*INCLUDE, INPUT=mesh.inp\n"), HasSubstr("the file \"mesh.inp\" includes itself"));
}

TEST(AbaqusErrors, ARunThatIsMuchLongerThanTheMeshTakesNoMemory) {
  const std::string text = replaced(two_squares, "1, 3, 1", "1, 999999999, 1");
  EXPECT_EQ(read_mesh<2>(written("squares.inp", text)).node_sets.at("BOTTOM").size(), 6u);
}

}  // namespace
}  // namespace perimorph::mesh_files
