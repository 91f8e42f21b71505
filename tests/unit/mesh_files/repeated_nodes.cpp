// Elements in which nodes stand several times: what is left of them, from every format.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "gmsh_files.hpp"
#include "mesh_writers.hpp"
#include "perimorph/mesh/orientation.hpp"

namespace perimorph::mesh_files {
namespace {

using mesh::ElementType;
using mesh::Mesh;
using mesh::Side;
using testing::ElementsAre;
using testing::HasSubstr;

/// The corners of a cube, numbered as those of a hexahedron.
const std::vector<std::array<int, 3>> cube = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                              {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};

/// One element of one of gmsh's kinds, with some of the cube's corners.
std::string one_element(int kind, const std::vector<int>& nodes) {
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n8\n";
  for (std::size_t n = 0; n < cube.size(); ++n) text += fmt::format("{} {}\n", n + 1, fmt::join(cube[n], " "));
  return text + fmt::format("$EndNodes\n$Elements\n1\n7 {} 2 0 1 {}\n$EndElements\n", kind, fmt::join(nodes, " "));
}

constexpr int tetrahedron = 4, hexahedron = 5, prism = 6, pyramid = 7;  // gmsh's kinds

struct Collapsed {
  int kind;
  std::vector<int> nodes;
  ElementType left;
  double volume;
};

/// Of a convex element, by its faces and a place within it.
double volume_of(const Mesh<3>& mesh) {
  base::Point<3> middle = base::Point<3>::Zero();
  for (int c = 0; c < mesh.n_corners(0); ++c) middle += mesh.coordinates[mesh.corners_of(0)[c]] / mesh.n_corners(0);
  double volume = 0.;
  for (const auto& side : mesh::sides(mesh.types[0])) {
    const auto from_middle = [&](std::size_t c) -> base::Point<3> {
      return mesh.coordinates[mesh.corners_of(0)[side[c]]] - middle;
    };
    for (std::size_t c = 1; c + 1 < side.size(); ++c) {
      volume += from_middle(0).dot(from_middle(c).cross(from_middle(c + 1))) / 6.;
    }
  }
  return volume;
}

TEST(RepeatedNodes, ASolidIsWhatIsLeftOfIt) {
  const std::vector<Collapsed> all = {
      {hexahedron, {1, 2, 3, 3, 5, 6, 7, 7}, ElementType::wedge6, 1. / 2},  // an edge of bottom and top
      {hexahedron, {1, 1, 3, 4, 5, 5, 7, 8}, ElementType::wedge6, 1. / 2},
      {hexahedron, {1, 2, 3, 4, 1, 2, 7, 8}, ElementType::wedge6, 1. / 2},  // two upright edges
      {hexahedron, {1, 2, 3, 4, 5, 6, 6, 5}, ElementType::wedge6, 1. / 2},  // the top is a line
      {hexahedron, {1, 2, 3, 4, 5, 5, 5, 5}, ElementType::pyramid5, 1. / 3},
      {hexahedron, {1, 2, 3, 3, 5, 6, 3, 3}, ElementType::pyramid5, 1. / 3},
      {hexahedron, {1, 2, 4, 4, 5, 5, 5, 5}, ElementType::tet4, 1. / 6},
      {hexahedron, {1, 2, 4, 4, 5, 5, 4, 4}, ElementType::tet4, 1. / 6},
      {prism, {1, 2, 4, 5, 6, 4}, ElementType::pyramid5, 1. / 3},
      {prism, {1, 2, 4, 5, 5, 5}, ElementType::tet4, 1. / 6},
      {prism, {1, 2, 4, 5, 2, 4}, ElementType::tet4, 1. / 6},
      {pyramid, {1, 2, 4, 4, 5}, ElementType::tet4, 1. / 6},
  };
  for (const auto& [kind, nodes, left, volume] : all) {
    SCOPED_TRACE(fmt::format("{}: {}", kind, fmt::join(nodes, ", ")));
    const std::string file = written("mesh.msh", one_element(kind, nodes));
    const Mesh<3> mesh = read_mesh<3>(file);
    EXPECT_THAT(mesh.types, ElementsAre(left));
    EXPECT_GT(smallest_corner_volume(mesh, 0), 0.1);
    EXPECT_NEAR(volume_of(mesh), volume, 1e-12);
    EXPECT_THAT(notes_of(mesh, file), testing::StartsWith("1 of 1 elements have repeated nodes: each is taken as the "
                                                          "wedge, pyramid or tetrahedron that is left of it\n"));
    EXPECT_THAT(notes_of(mesh, file), testing::Not(HasSubstr("reversed")));
  }
}

TEST(RepeatedNodes, ASolidOfWhichNoneIsLeftIsAnError) {
  const std::vector<std::pair<int, std::vector<int>>> all = {{hexahedron, {1, 2, 3, 4, 1, 6, 7, 8}},
                                                             {hexahedron, {1, 1, 3, 4, 5, 6, 6, 8}},  // twisted
                                                             {hexahedron, {1, 2, 3, 4, 1, 2, 3, 4}},
                                                             {hexahedron, {1, 2, 1, 4, 5, 6, 7, 8}},
                                                             {prism, {1, 1, 3, 5, 6, 7}},
                                                             {pyramid, {1, 2, 3, 4, 4}},
                                                             {tetrahedron, {1, 2, 2, 5}}};
  for (const auto& [kind, nodes] : all) {
    EXPECT_THAT(error_of_reading<3>(written("mesh.msh", one_element(kind, nodes))),
                HasSubstr(fmt::format("element 7 has nodes {}, which are the corners of no hexahedron, wedge, pyramid "
                                      "or tetrahedron",
                                      fmt::join(nodes, ", "))));
  }
}

TEST(RepeatedNodes, AQuadrangleIsATriangle) {
  for (const char* nodes : {"2 3 6 6", "2 2 3 6", "6 2 3 3", "6 2 3 6"}) {
    const std::string file = written("squares.msh", replaced(two_squares_2_2, "2 3 6 5", nodes));
    const Mesh<2> mesh = read_mesh<2>(file);
    EXPECT_THAT(mesh.types, ElementsAre(ElementType::quad4, ElementType::tri3));
    EXPECT_EQ(notes_of(mesh, file),
              "1 of 2 elements have repeated nodes: each is taken as the triangle that is left of it\n");
  }
  for (const char* nodes : {"2 3 2 6", "2 3 3 2", "2 2 2 6"}) {
    EXPECT_THAT(error_of_reading<2>(written("squares.msh", replaced(two_squares_2_2, "2 3 6 5", nodes))),
                HasSubstr("which are the corners of no triangle or quadrangle"));
  }
}

/// A wedge written as a hexahedron beside a hexahedron: sides keep their numbers, those without an area are passed
/// over.
TEST(RepeatedNodes, SidesOfAbaqusAreThoseThatAreLeft) {
  const std::string file =
      written("wedge.inp",
              "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n9,2,0,0\n10,2,0,1\n"
              "*ELEMENT,TYPE=C3D8R,ELSET=all\n1,1,2,3,4,5,6,7,8\n2,2,9,3,3,6,10,7,7\n"
              "*ELSET,ELSET=wedge\n2\n*SURFACE,NAME=top\nall,S2\n*SURFACE,NAME=slant\nwedge,S4\n"
              "*SURFACE,NAME=nothing\nwedge,S5\n*SURFACE,NAME=outside\nall,\n");
  const Mesh<3> mesh = read_mesh<3>(file);
  EXPECT_THAT(mesh.types, ElementsAre(ElementType::hex8, ElementType::wedge6));
  EXPECT_EQ(mesh.side_sets.at("top").size(), 2u);
  EXPECT_EQ(mesh.side_sets.at("slant").size(), 1u);
  EXPECT_EQ(mesh.node_sets.at("slant").size(), 4u);
  EXPECT_EQ(mesh.side_sets.count("nothing"), 0u);
  EXPECT_EQ(mesh.side_sets.at("outside").size(), mesh.boundary.size());
  EXPECT_EQ(mesh.boundary.size(), 5u + 4u);
}

TEST(RepeatedNodes, SidesOfExodusAreThoseThatAreLeft) {
  Mesh<3> whole = read_mesh<3>(written("cube.msh", one_element(hexahedron, {1, 2, 3, 4, 5, 6, 7, 8})));
  whole.corners = {0, 1, 2, 2, 4, 5, 6, 6};
  whole.side_sets = {{"quadrangle", {{0, 0}}}, {"triangles", {{0, 4}, {0, 5}}}, {"with a line", {{0, 1}, {0, 2}}}};
  const std::string file = test_file("wedge.e");
  write_exodus(whole, file, {EX_CLOBBER | EX_LARGE_MODEL, 0, {}, 1, true, false});

  const Mesh<3> mesh = read_mesh<3>(file);

  EXPECT_THAT(mesh.types, ElementsAre(ElementType::wedge6));
  EXPECT_EQ(mesh.side_sets.at("quadrangle").size(), 1u);
  EXPECT_EQ(mesh.side_sets.at("triangles").size(), 2u);
  EXPECT_EQ(mesh.side_sets.at("with a line").size(), 1u);
  EXPECT_EQ(
      notes_of(mesh, file),
      "1 of 1 elements have repeated nodes: each is taken as the wedge, pyramid or tetrahedron that is left of it\n"
      "dropped: 2 nodes in no 3D element (4, 8)\n");
}

}  // namespace
}  // namespace perimorph::mesh_files
