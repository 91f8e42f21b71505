// The gmsh reader, and running gmsh.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gmsh_files.hpp"
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
constexpr std::array<Flavour, 4> flavours = {{{"msh41", "-format msh41"},
                                              {"msh41_binary", "-format msh41 -bin"},
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

// ---- running gmsh ----

TEST(MeshGeometry, RunsGmshAndKeepsABinaryFile) {
  const std::string geo = written("plate.geo", structured_plate), msh = test_file("plate.msh");

  mesh_geometry(geo, msh, 2);

  EXPECT_EQ(contents(msh).substr(0, 20), "$MeshFormat\n4.1 1 8\n");
  EXPECT_EQ(read_mesh<2>(msh).n_elements(), 12);
}

std::string error_of_meshing(const std::string& geo, const std::string& msh) {
  try {
    mesh_geometry(geo, msh, 2);
  } catch (const base::UserError& error) {
    return error.what();
  }
  return "(no error)";
}

TEST(MeshGeometry, AFaultyGeometryIsReportedInGmshsOwnWords) {
  const std::string geo = written("faulty.geo", "Point(1) = {0, 0, 0};\nLine(1) = {1, unknown};\n");

  const std::string message = error_of_meshing(geo, test_file("faulty.msh"));

  EXPECT_THAT(message, testing::StartsWith(geo + ": gmsh "));
  EXPECT_THAT(message, testing::HasSubstr("Its messages:\n"));
  EXPECT_THAT(message, testing::HasSubstr("Unknown variable 'unknown'"));
}

TEST(MeshGeometry, ALeftOverMeshIsNotTakenForTheNewOne) {
  const std::string geo = written("faulty.geo", "Line(1) = {1, 2};\n"), msh = written("faulty.msh", two_squares_4_1);
  EXPECT_NE(error_of_meshing(geo, msh), "(no error)");
  EXPECT_FALSE(std::filesystem::exists(msh));
}

TEST(MeshGeometry, AMissingFileIsReported) {
  EXPECT_EQ(error_of_meshing("nowhere/plate.geo", "plate.msh"),
            "nowhere/plate.geo: cannot be read: No such file or directory");
}

TEST(MeshGeometry, AMissingGmshIsReportedWithItsPackage) {
  const std::string geo = written("plate.geo", structured_plate), path = std::getenv("PATH");
  setenv("PATH", "/nowhere", 1);

  const std::string message = error_of_meshing(geo, test_file("plate.msh"));

  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(message, geo + ": gmsh is needed to mesh it, but is not installed (apt-get install gmsh)");
}

/// A stand-in for gmsh that kills itself, as gmsh 4.8 does with Mesh.Algorithm = 8.
TEST(MeshGeometry, ACrashOfGmshIsReportedWithItsUsualCause) {
  const std::string geo = written("plate.geo", structured_plate), path = std::getenv("PATH");
  const std::string gmsh = written("gmsh", "#!/bin/sh\necho meshing\nkill -SEGV $$\n");
  std::filesystem::permissions(gmsh, std::filesystem::perms::owner_all);
  setenv("PATH", (std::filesystem::path(gmsh).parent_path().string() + ":" + path).c_str(), 1);

  const std::string message = error_of_meshing(geo, test_file("plate.msh"));

  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(message, geo +
                         ": gmsh crashed (Segmentation fault). Mesh.Algorithm = 8 crashes in gmsh 4.8: choose another, "
                         "such as 6. Its messages:\nmeshing");
}

TEST(MeshGeometry, GmshDoesNotTakeItselfForARank) {
  const std::string geo = written("plate.geo", structured_plate), path = std::getenv("PATH");
  const std::string gmsh = written("gmsh", "#!/bin/sh\nenv\nexit 3\n");
  std::filesystem::permissions(gmsh, std::filesystem::perms::owner_all);
  setenv("PATH", (std::filesystem::path(gmsh).parent_path().string() + ":" + path).c_str(), 1);
  setenv("OMPI_COMM_WORLD_RANK", "0", 1);

  const std::string message = error_of_meshing(geo, test_file("plate.msh"));

  setenv("PATH", path.c_str(), 1);
  EXPECT_THAT(message, testing::HasSubstr("gmsh failed (status 3)"));
  EXPECT_THAT(message, testing::Not(testing::HasSubstr("OMPI_")));
}

}  // namespace
}  // namespace perimorph::mesh_files
