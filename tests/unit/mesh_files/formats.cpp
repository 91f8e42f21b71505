// Exodus files and ANSYS archives: the same mesh as from gmsh, and what these formats have of their own.

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
using testing::HasSubstr;

/// Quadrangles in one block, triangles in the other; groups of a point, of curves and of two curves.
const std::string two_blocks = R"(
Point(1) = {0, 0, 0}; Point(2) = {2, 0, 0}; Point(3) = {4, 0, 0};
Point(4) = {0, 1.5, 0}; Point(5) = {2, 1.5, 0}; Point(6) = {4, 1.5, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 6}; Line(4) = {6, 5}; Line(5) = {5, 4}; Line(6) = {4, 1};
Line(7) = {2, 5};
Curve Loop(1) = {1, 7, 5, 6}; Plane Surface(1) = {1}; Curve Loop(2) = {2, 3, 4, -7}; Plane Surface(2) = {2};
Transfinite Curve{:} = 4; Transfinite Surface{:}; Recombine Surface{1};
Physical Surface("WEST", 1) = {1}; Physical Surface("EAST", 2) = {2};
Physical Curve("LEFT", 3) = {6}; Physical Curve("BOTTOM", 4) = {1, 2}; Physical Point("CORNER", 5) = {6};
)";

const std::string box = R"(
SetFactory("OpenCASCADE"); Box(1) = {0, 0, 0, 1, 1, 1}; Mesh.MeshSizeMax = 0.5;
Physical Volume("BOX", 1) = {1}; Physical Surface("FACE", 2) = {1}; Physical Curve("EDGE", 3) = {1};
)";

/// A hexahedron, a pyramid on its top, a wedge beside it, and a tetrahedron beside the pyramid: each in its block.
const std::string all_solids = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
5
2 5 "BASE"
3 1 "HEXAHEDRON"
3 2 "PYRAMID"
3 3 "WEDGE"
3 4 "TETRAHEDRON"
$EndPhysicalNames
$Nodes
12
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
5 0 0 1
6 1 0 1
7 1 1 1
8 0 1 1
9 0.5 0.5 2
10 2 0 0
11 2 1 0
12 2 0.5 1.5
$EndNodes
$Elements
6
1 5 2 1 1 1 2 3 4 5 6 7 8
2 7 2 2 2 5 6 7 8 9
3 6 2 3 3 2 6 10 3 7 11
4 4 2 4 4 6 7 9 12
5 3 2 5 5 1 2 3 4
6 2 2 5 6 2 6 10
$EndElements
)";

template <int dim>
Mesh<dim> from_gmsh(const std::string& geo) {
  return read_mesh<dim>(meshed(geo, dim, "-format msh41", "mesh"));
}

template <int dim>
void expect_same_from_all_formats(const Mesh<dim>& expected) {
  for (const int mode : {EX_CLOBBER | EX_LARGE_MODEL, EX_CLOBBER | EX_NETCDF4 | EX_NOCLASSIC}) {
    for (const char* ending : {".e", ".exo"}) {
      SCOPED_TRACE(fmt::format("{} {}", ending, mode));
      const std::string file = test_file(std::string("mesh") + ending);
      write_exodus(expected, file, {mode});
      expect_same(read_mesh<dim>(file), expected);
    }
  }
  SCOPED_TRACE(".cdb");
  expect_same(read_mesh<dim>(written("mesh.cdb", ansys_archive(expected))), expected, 1e-12);  // 14 digits
}

TEST(Formats, QuadranglesAndTrianglesAreTheSameFromAllFormats) {
  expect_same_from_all_formats(from_gmsh<2>(two_blocks));
}
TEST(Formats, HexahedraAreTheSameFromAllFormats) { expect_same_from_all_formats(from_gmsh<3>(extruded_block)); }
TEST(Formats, TetrahedraAreTheSameFromAllFormats) { expect_same_from_all_formats(from_gmsh<3>(box)); }

TEST(Formats, PyramidsAndWedgesAreTheSameFromAllFormats) {
  const Mesh<3> solids = read_mesh<3>(written("solids.msh", all_solids));
  EXPECT_THAT(solids.types,
              ElementsAre(ElementType::hex8, ElementType::pyramid5, ElementType::wedge6, ElementType::tet4));
  EXPECT_EQ(solids.side_sets.at("BASE").size(), 2u);  // a face of the hexahedron, one of the wedge
  EXPECT_EQ(solids.boundary.size(), 4u + 3u + 4u + 3u);
  expect_same_from_all_formats(solids);
}

TEST(Formats, TheWholeMeshBelongsToRankZeroWithItsBoundary) {
  const Mesh<2> mesh = read_mesh<2>(written("mesh.cdb", ansys_archive(from_gmsh<2>(two_blocks))));

  EXPECT_EQ(mesh.n_global_elements, 9 + 18);
  EXPECT_EQ(mesh.n_owned_elements, 9 + 18);
  EXPECT_THAT(mesh.node_owners, testing::Each(0));
  EXPECT_EQ(mesh.boundary.size(), 6u * 3u);
}

TEST(Formats, CoordinatesAreScaled) {
  const Mesh<2> expected = from_gmsh<2>(two_blocks);
  const std::string msh = test_file("mesh.msh"), exodus = test_file("mesh.e");
  write_exodus(expected, exodus);

  for (const std::string& file : {msh, exodus, written("mesh.cdb", ansys_archive(expected))}) {
    const Mesh<2> scaled = read_mesh<2>(file, 1000.);
    for (int n = 0; n < expected.n_nodes(); ++n) {
      EXPECT_LT((scaled.coordinates[n] - 1000. * expected.coordinates[n]).norm(), 1e-9) << file;
    }
  }
}

TEST(Formats, AScaleThatLeavesNoNumbersIsAnError) {
  const std::string file = written("squares.msh", two_squares_2_2);
  EXPECT_THROW(read_mesh<2>(file, 1e300), base::UserError);
}

TEST(Formats, TheContentDecidesWhateverTheEnding) {
  const Mesh<2> expected = from_gmsh<2>(two_blocks);
  const std::string exodus = test_file("mesh.e"), msh = contents(test_file("mesh.msh")), cdb = ansys_archive(expected);
  write_exodus(expected, exodus);
  for (const char* name : {"a.g", "a.gen", "a.ex2", "a.EXO", "a.exoII", "a.E", "a.ncdf", "a.msh", "a"}) {
    expect_same(read_mesh<2>(written(name, contents(exodus))), expected);
  }
  for (const char* name : {"a.MSH", "a.txt", "a.e", "a.mesh"}) expect_same(read_mesh<2>(written(name, msh)), expected);
  for (const char* name : {"a.CDB", "ds.dat", "a.inp", "a.msh"}) {
    expect_same(read_mesh<2>(written(name, cdb)), expected, 1e-12);
  }
}

/// Which of them a case means would be a guess; perhaps it means neither.
TEST(Formats, GroupsOfOneNameAndOtherNodesAreLeftOut) {
  Mesh<2> squares = mesh::grid<2>({2, 1});
  squares.node_sets["left"] = {0, 1};
  const std::string exodus = test_file("squares.e");
  write_exodus(squares, exodus);
  const std::string gmsh = written(
      "plate.msh", contents(meshed(structured_plate + "Physical Point(\"left\", 9) = {3};", 2, "-format msh41", "p")));
  for (const std::string& file : {exodus, gmsh}) {
    const Mesh<2> mesh = read_mesh<2>(file);
    EXPECT_EQ(mesh.node_sets.count("left") + mesh.side_sets.count("left"), 0u);
    EXPECT_EQ(notes_of(mesh, file),
              "the groups called \"left\" are left out, since their nodes differ: give each its own name\n");
  }
}

TEST(Formats, AFileThatIsNoMeshIsAnErrorThatListsWhatIs) {
  EXPECT_EQ(error_of_reading<2>("mesh.stl"), "mesh.stl: cannot be read: No such file or directory");
  const std::string file = written("mesh.stl", "solid ascii\n");
  EXPECT_EQ(error_of_reading<2>(file),
            file +
                ": neither its content nor its ending is that of a mesh; allowed are geometries of gmsh (.geo) and "
                "meshes of gmsh (.msh), Exodus (.e, .exo, .g), ANSYS (.cdb) and Abaqus (.inp)");
}

// ---- Exodus ----

TEST(ExodusMesh, OtherSpellingsOfTheTypesAreKnown) {
  const Mesh<2> expected = from_gmsh<2>(two_blocks);
  const std::string file = test_file("mesh.e");
  for (const auto& types : {std::vector<std::string>{"QUAD", "TRI"}, {"quad4", "tri3"}, {"Quad", "TRIANGLE"}}) {
    write_exodus(expected, file, {EX_CLOBBER, 0, types});
    expect_same(read_mesh<2>(file), expected);
  }
}

TEST(ExodusMesh, ShellsInThePlaneAreA2DMeshWhoseSidesComeAfterTheirFaces) {
  const Mesh<2> expected = from_gmsh<2>(two_blocks);
  const std::string file = test_file("mesh.e");
  write_exodus(expected, file, {EX_CLOBBER, 3, {"SHELL4", "TRI3"}, 3});
  expect_same(read_mesh<2>(file), expected);
}

TEST(ExodusMesh, ASideSetIsANodeSetToo) {
  const Mesh<2> expected = from_gmsh<2>(two_blocks);
  const std::string file = test_file("mesh.e");
  write_exodus(expected, file, {EX_CLOBBER, 0, {}, 1, true, false});
  expect_same(read_mesh<2>(file), expected);
}

TEST(ExodusMesh, GroupsWithoutNamesAreCalledByTheirNumbers) {
  const std::string file = test_file("mesh.e");
  write_exodus(from_gmsh<2>(two_blocks), file, {EX_CLOBBER, 0, {}, 1, false, false});

  const Mesh<2> mesh = read_mesh<2>(file);

  EXPECT_THAT(mesh.block_names, ElementsAre("block_10", "block_20"));
  EXPECT_EQ(mesh.node_sets.count("nodes_1"), 1u);
  EXPECT_EQ(mesh.side_sets.at("sides_1").size(), 6u);
}

// ---- ANSYS ----

/// Two unit squares beside each other, as Mechanical writes them: short formats, lower case, no component of elements.
const std::string two_squares_cdb = R"(! written by hand
/prep7
et,5,PLANE42
nblock,3,,6
(1i9,3e21.9e3)
        1
        2     1.000000000E+000
        3     2.000000000E+000     0.000000000E+000     0.000000000E+000
       14     0.000000000E+000     1.000000000E+000
       15     1.000000000E+000     1.000000000E+000
       16     2.000000000E+000     1.000000000E+000
-1
eblock,19,solid,,2
(19i9)
        7        5        1        1        0        0        0        0        4        0      101        1        2       15       14
        8        5        1        1        0        0        0        0        4        0      102        2        3       16       15
-1
CMBLOCK,TOP     ,NODE,       2
(8i10)
        14       -16
CMBLOCK,SOME,ELEM,1
(8i10)
       101
)";

TEST(AnsysMesh, NodesElementsAndComponentsAreRead) {
  const Mesh<2> mesh = read_mesh<2>(written("squares.cdb", two_squares_cdb));

  EXPECT_THAT(mesh.corners, ElementsAre(0, 1, 4, 3, 1, 2, 5, 4));
  EXPECT_EQ(mesh.coordinates[5], base::Point<2>(2., 1.));
  EXPECT_THAT(mesh.node_sets.at("TOP"), ElementsAre(3, 4, 5));
  EXPECT_THAT(mesh.side_sets.at("TOP"), ElementsAre(Side{0, 2}, Side{1, 2}));
}

TEST(AnsysMesh, MaterialsAreBlocksWhereComponentsDoNotCoverTheElements) {
  EXPECT_THAT(read_mesh<2>(written("squares.cdb", two_squares_cdb)).block_names,
              ElementsAre("material_7", "material_8"));
  const std::string covered =
      replaced(two_squares_cdb, "ELEM,1\n(8i10)\n       101", "ELEM,2\n(8i10)\n       101      -102");
  EXPECT_THAT(read_mesh<2>(written("covered.cdb", covered)).block_names, ElementsAre("SOME"));
}

TEST(AnsysMesh, AQuadrangleWithARepeatedNodeIsATriangle) {
  for (const char* nodes : {"        2        3       15       15", "        2        2        3       15"}) {
    std::string text = replaced(two_squares_cdb, "        2        3       16       15", nodes);
    text = replaced(text, "       16     2.000000000E+000     1.000000000E+000\n", "");
    const Mesh<2> mesh = read_mesh<2>(written("squares.cdb", replaced(text, "nblock,3,,6", "nblock,3,,5")));
    EXPECT_THAT(mesh.types, ElementsAre(ElementType::quad4, ElementType::tri3));
    EXPECT_THAT(mesh.corners, ElementsAre(0, 1, 4, 3, 1, 2, 4));
  }
}

/// A kind of element by its number or its name, as CDWRITE writes one or the other.
template <int dim>
void expect_same_as_kind(const std::string& geo, const std::string& usual, const std::vector<std::string>& kinds) {
  const Mesh<dim> expected = from_gmsh<dim>(geo);
  for (const std::string& kind : kinds) {
    SCOPED_TRACE(kind);
    const std::string text = replaced(ansys_archive(expected), "ET,        1," + usual, "ET,        1," + kind);
    expect_same(read_mesh<dim>(written("mesh.cdb", text)), expected, 1e-12);
  }
}

TEST(AnsysMesh, OldAndNewKindsHaveTheSameShapesTheCollapsedOnesToo) {
  expect_same_as_kind<2>(two_blocks, "182", {"PLANE182", "42", "PLANE42"});
  expect_same_as_kind<3>(extruded_block, "185", {"SOLID185", "45", "SOLID45"});
  expect_same_as_kind<3>(box, "185", {"SOLID185", "45", "SOLID45"});  // tetrahedra
}

/// The archive of two squares by its several ways to write one thing.
TEST(AnsysMesh, WaysOfWritingOneThingAreReadAlike) {
  const Mesh<2> expected = read_mesh<2>(written("squares.cdb", two_squares_cdb));
  const std::size_t begin = two_squares_cdb.find("(1i9,3e21.9e3)"), end = two_squares_cdb.find("-1\neblock");
  const std::string nodes = two_squares_cdb.substr(begin, end - begin);
  const std::vector<std::pair<std::string, std::string>> changes = {
      {"et,5,PLANE42", "ETBLOCK,        1,        1\n(2i9,19a9)\n        5      182        0        0\n       -1"},
      {"et,5,PLANE42", "etblock,2,2\n(2i9,19a9)\n        5       42        0\n        6      154\n       -1"},
      {"et,5,PLANE42",
       "ETBLOCK,        2,        2\n(2i10,5a9)\n         5       182        0        0\n         7       184\n  -1"},
      {"et,5,PLANE42", "*set,mine,5\net,mine,182"},
      {"nblock,3,,6", "nblock,3,,140"},
      {"nblock,3,,6", "nblock,3,,2"},
      {"nblock,3,,6", "nblock,3"},
      {"nblock,3,,6", "NBLOCK,3,      ,       6,       3"},
      {nodes,
       "(1i7,2i9,6e21.13)\n      1        0        0\n      2        0        0 1.0000000000000E+000\n"
       "      3        0        0 2.0000000000000D+000 0.0000000000000D+000\n"
       "     14        0        0 0.0000000000000E+000 1.0000000000000E+000\n"
       "     15        0        0 1.0000000000000d+000+1.0000000000000E+000\n"
       "     16        0        0 2.0000000000000E+000  1.0000000000000+000\n"},
      {nodes,
       "(3i8,6e16.9)\n       1       0       0\n       2       0       0 1.000000000E+00\n"
       "       3       0       0 2.000000000E+00\n      14       0       0 0.000000000E+00 1.000000000E+00\n"
       "      15       0       0 1.000000000E+00 1.000000000E+00\n"
       "      16       0       0 2.000000000E+00 1.000000000E+00\n"},
      {nodes,
       "(1i10,1i5,1i12,3e25.16)\n         1    0           0\n         2    0           0   1.0000000000000000E+00\n"
       "         3    0           0   2.0000000000000000E+00\n"
       "        14    0           0   0.0000000000000000E+00   1.0000000000000000E+00\n"
       "        15    0           0   1.0000000000000000E+00   1.0000000000000000E+00\n"
       "        16    0           0   2.0000000000000000E+00   1.0000000000000000E+00\n"},
      {"eblock,19,solid,,2\n(19i9)", "EBLOCK,19,SOLID,102,2\n(19i9)"},
  };
  for (const auto& [from, to] : changes) {
    SCOPED_TRACE(to);
    expect_same(read_mesh<2>(written("changed.cdb", replaced(two_squares_cdb, from, to))), expected);
  }
}

/// Kinds for heat and fields, and those of meshes alone, whose first key option says what they are.
TEST(AnsysMesh, KindsForOtherFieldsHaveTheSameShapes) {
  expect_same_as_kind<2>(two_blocks, "182",
                         {"55", "PLANE13", "SHELL181", "63", "MESH200,6", "200\nKEYOP, 1, 1, 6",
                          "182\nETBLOCK,1,1\n(2i9,19a9)\n        1      200        6\n       -1"});
  expect_same_as_kind<3>(extruded_block, "185", {"70", "SOLID5", "SOLSH190", "MESH200,10", "200\nkeyopt,1,1,10"});
}

/// A line of EBLOCK: material 7, a type, a number, nodes.
std::string ansys_line(int type, int number, const std::vector<int>& nodes) {
  std::string text;
  const auto add = [&](int value) { text += fmt::format("{:9}", value); };
  for (const int field : {7, type, 1, 1, 0, 0, 0, 0, static_cast<int>(nodes.size()), 0, number}) add(field);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (i == 8) text += "\n";
    add(nodes[i]);
  }
  return text + "\n";
}

TEST(AnsysMesh, ElementsOfSecondOrderAreTakenByTheirCorners) {
  const Mesh<3> cube = mesh::grid<3>({1, 1, 1});
  std::string text = ansys_archive(cube);
  const std::size_t begin = text.find("EBLOCK"), end = text.find("       -1\n", begin);
  std::string nodes;
  for (int n = 9; n < 30; ++n) {
    nodes += fmt::format("{:9}{:9}{:9}{:21.13E}{:21.13E}{:21.13E}\n", n, 0, 0, .5, .5, .01 * n);
  }
  std::vector<int> twenty = {1, 2, 4, 3, 5, 6, 8, 7};
  for (int n = 9; n < 21; ++n) twenty.push_back(n == 12 ? 0 : n);  // ANSYS allows to leave one out
  text = text.substr(0, begin) + "EBLOCK,19,SOLID,1,1\n(19i9)\n" + ansys_line(1, 1, twenty) + text.substr(end);
  text = replaced(replaced(text, "N,R5.3", nodes + "N,R5.3"), "1,185", "1,186");
  const std::string file = written("cube.cdb", text);

  const Mesh<3> mesh = read_mesh<3>(file);

  EXPECT_EQ(mesh.corners, cube.corners);
  EXPECT_EQ(notes_of(mesh, file),
            "1 of 1 elements are of second order: they are taken by their corners, with straight edges, and 11 nodes "
            "between the corners are dropped\n"
            "dropped: 10 nodes in no 3D element (12, 21, 22, 23, 24, ...)\n");
}

TEST(AnsysMesh, TheLastNodesBetweenTheCornersMayBeMissing) {
  std::string text = replaced(two_squares_cdb, "PLANE42", "PLANE183");
  text = replaced(text, "        4        0      102", "        6        0      102");
  text = replaced(text, "       16       15\n", "       16       15       20        0\n");
  EXPECT_EQ(read_mesh<2>(written("five.cdb", text)).corners,
            read_mesh<2>(written("four.cdb", two_squares_cdb)).corners);
}

TEST(AnsysMesh, AComponentReplacesAnEarlierOneOfItsName) {
  const Mesh<2> mesh =
      read_mesh<2>(written("squares.cdb", two_squares_cdb + "CMBLOCK,TOP,NODE,1\n(8i10)\n        15\n"));
  EXPECT_THAT(mesh.node_sets.at("TOP"), ElementsAre(4));
}

TEST(AnsysMesh, ElementsWithoutABodyArePassedOver) {
  const Mesh<2> expected = read_mesh<2>(written("squares.cdb", two_squares_cdb));
  std::string text = replaced(two_squares_cdb, "et,5,PLANE42", "et,5,PLANE42\net,6,MASS21\n*set,cid,8\net,cid,171");
  text = replaced(text, "solid,,2\n(19i9)\n", "solid,,3\n(19i9)\n" + ansys_line(6, 90, {14}));
  text +=
      "type,cid\nreal,cid\neblock,10,,,2\n(15i9)\n      201        8        8        8        0       14       15\n"
      "      202        8        8        8        0       15       16\n-1\n";
  const std::string file = written("contact.cdb", text);
  const Mesh<2> mesh = read_mesh<2>(file);
  expect_same(mesh, expected);
  EXPECT_EQ(notes_of(mesh, file),
            "1 elements of ANSYS' type 21, which have no body, are passed over\n"
            "2 elements of ANSYS' type 171, which have no body, are passed over\n");
  expect_same(read_mesh<2>(written("untyped.cdb", replaced(text, "type,cid\n", ""))), expected);
}

TEST(AnsysMesh, WindowsLineEndsDoNotMatter) {
  std::string text = two_squares_cdb;
  for (std::size_t i = text.find('\n'); i != std::string::npos; i = text.find('\n', i + 2)) text.insert(i, "\r");
  EXPECT_EQ(read_mesh<2>(written("squares.cdb", text)).n_elements(), 2);
}

/// The error of reading a text, without the file's name at its beginning.
template <int dim = 2>
std::string error_of(const std::string& text) {
  const std::string file = written("mesh.cdb", text), message = error_of_reading<dim>(file);
  EXPECT_THAT(message, testing::StartsWith(file + ":"));
  return message.substr(std::min(message.size(), file.size()));
}

TEST(AnsysErrors, OtherElements) {
  EXPECT_EQ(error_of(replaced(two_squares_cdb, "PLANE42", "FLUID29")),
            ":15: element 101 is of ANSYS' type 29; allowed are plane elements, solids and shells such as PLANE182, "
            "SOLID185, "
            "SOLID187 and SHELL181 (unselect others before CDWRITE)");
  EXPECT_EQ(error_of(replaced(two_squares_cdb, "et,5", "et,6")),
            ":15: element 101 has type 5, which no ET command defines before it");
  EXPECT_THAT(error_of(replaced(two_squares_cdb, ",19,solid,", ",10,,")), HasSubstr(":15: EBLOCK without SOLID"));
}

/// By each way to set a key option; the others are plane stress and plane strain.
TEST(AnsysErrors, AxisymmetricElements) {
  for (const char* type : {"et,5,PLANE42,,,1", "et,5,182\nkeyopt,5,3,1", "et,5,PLANE183\nKEYOP,5,3,6",
                           "ETBLOCK,1,1\n(2i9,19a9)\n        5       55        0        0        1\n       -1"}) {
    EXPECT_THAT(error_of(replaced(two_squares_cdb, "et,5,PLANE42", type)),
                HasSubstr("an axisymmetric one; allowed are plane elements of plane stress or plane strain"));
  }
  for (const char* type : {"et,5,182\nkeyopt,5,3,2", "et,5,182\nkeyopt,5,3,3", "et,5,181\nkeyopt,5,3,1"}) {
    EXPECT_EQ(read_mesh<2>(written("plane.cdb", replaced(two_squares_cdb, "et,5,PLANE42", type))).n_elements(), 2);
  }
}

TEST(AnsysErrors, CollapsedShapesThatAreNoElements) {
  EXPECT_THAT(error_of(replaced(two_squares_cdb, "        2        3       16       15",
                                "        2        2       15       15")),
              HasSubstr("element 102 has nodes 2, 2, 15, 15, which are the corners of no triangle or quadrangle"));
  const std::string hexahedron = ansys_archive(mesh::grid<3>({1, 1, 1}));
  const std::string nodes = "        1        2        4        3        5        6        8        7\n";
  EXPECT_THAT(error_of<3>(replaced(hexahedron, nodes,
                                   "        1        2        4        3        1        6        8        7\n")),
              HasSubstr("element 1 has nodes 1, 2, 4, 3, 1, 6, 8, 7, which are the corners of no hexahedron, wedge, "
                        "pyramid or tetrahedron"));
}

TEST(AnsysErrors, TheFile) {
  EXPECT_EQ(error_of(""), ": the file is empty; an ANSYS archive is needed");
  EXPECT_THAT(error_of("solid ascii\n"),
              HasSubstr("the file ends without NBLOCK: it is truncated, or no archive that"));
  EXPECT_THAT(error_of(two_squares_cdb.substr(0, two_squares_cdb.find("eblock"))),
              HasSubstr("the file ends without EBLOCK"));
  EXPECT_THAT(error_of(two_squares_cdb.substr(0, two_squares_cdb.find("       15     1"))),
              HasSubstr("it is truncated"));
  EXPECT_THAT(error_of(replaced(two_squares_cdb, "solid,,2", "solid,,3")), HasSubstr("3 elements announced, 2 found"));
  EXPECT_THAT(error_of(replaced(two_squares_cdb, "(19i9)", "(19a9)")),
              HasSubstr(":14: a format such as (3i9,6e21.13e3) expected, found \"(19a9)\""));
  EXPECT_THAT(error_of(replaced(two_squares_cdb, "        2     1.0", "        2     1,0")),
              HasSubstr(":7: a number expected, found \"1,000000000E+000\""));
  EXPECT_THAT(error_of(replaced(two_squares_cdb, "      101        1", "      101       99")),
              HasSubstr("element 101 has node 99, which the file does not list"));
}

TEST(AnsysErrors, Components) {
  EXPECT_THAT(error_of(replaced(two_squares_cdb, "NODE,       2", "NODE,  2000000000")),
              HasSubstr("a count of 2000000000, but the rest of the file holds at most"));
  EXPECT_THAT(error_of(replaced(two_squares_cdb, "        14       -16", "        14       -13")),
              HasSubstr("component \"TOP\" has -13 after 14; allowed are ascending numbers"));
}

TEST(AnsysErrors, ARunThatIsMuchLongerThanTheMeshTakesNoMemory) {
  const std::string text = replaced(two_squares_cdb, "        14       -16", "         1-999999999");
  EXPECT_EQ(read_mesh<2>(written("squares.cdb", text)).node_sets.at("TOP").size(), 6u);
}

}  // namespace
}  // namespace perimorph::mesh_files
