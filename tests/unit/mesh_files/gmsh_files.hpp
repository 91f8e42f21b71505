#pragma once

// Files for the tests of the gmsh reader.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "perimorph/base/errors.hpp"
#include "perimorph/mesh_files/gmsh.hpp"
#include "perimorph/mesh_files/read_mesh.hpp"

namespace perimorph::mesh_files {

/// A file in a folder of its own for each test.
inline std::string test_file(const std::string& name) {
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  const auto folder =
      std::filesystem::path(testing::TempDir()) / fmt::format("perimorph_{}.{}", test->test_suite_name(), test->name());
  std::filesystem::create_directories(folder);
  return (folder / name).string();
}

inline std::string written(const std::string& name, const std::string& text) {
  const std::string file = test_file(name);
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

inline std::string contents(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// Two unit squares beside each other: surface 3 "plate" in group 1, its left edge in group 7.
inline const std::string two_squares_2_2 = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
1 7 "left"
2 1 "plate"
$EndPhysicalNames
$Nodes
6
1 0 0 0
2 1 0 0
3 2 0 0
4 0 1 0
5 1 1 0
6 2 1 0
$EndNodes
$Elements
3
11 1 2 7 1 4 1
12 3 2 1 3 1 2 5 4
13 3 2 1 3 2 3 6 5
$EndElements
)";

inline const std::string two_squares_4_1 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
2
1 7 "left"
2 1 "plate"
$EndPhysicalNames
$Entities
0 1 1 0
1 0 0 0 0 1 0 1 7 0
3 0 0 0 2 1 0 1 1 1 1
$EndEntities
$Nodes
1 6 1 6
2 3 0 6
1
2
3
4
5
6
0 0 0
1 0 0
2 0 0
0 1 0
1 1 0
2 1 0
$EndNodes
$Elements
2 3 11 13
1 1 1 1
11 4 1
2 3 3 2
12 1 2 5 4
13 2 3 6 5
$EndElements
)";

/// The text with one part exchanged, which must be there.
inline std::string replaced(std::string text, const std::string& old_part, const std::string& new_part) {
  const std::size_t found = text.find(old_part);
  if (found == std::string::npos) throw base::Bug("the test's text has no " + old_part);
  return text.replace(found, old_part.size(), new_part);
}

/// The message of the error that reading the file ends with.
template <int dim>
std::string error_of_reading(const std::string& file) {
  try {
    read_mesh<dim>(file);
  } catch (const base::UserError& error) {
    return error.what();
  }
  return "(no error)";
}

/// The mesh's notes without the file's name before each, a line each.
template <int dim>
std::string notes_of(const mesh::Mesh<dim>& mesh, const std::string& file) {
  std::string notes;
  for (const std::string& note : mesh.notes) {
    EXPECT_EQ(note.rfind(file + ": ", 0), 0u) << note;
    notes += note.substr(std::min(note.size(), file.size() + 2)) + "\n";
  }
  return notes;
}

/// Meshes a .geo text with gmsh's own options, such as "-format msh22 -bin".
inline std::string meshed(const std::string& geo, int dimension, const std::string& options, const std::string& name) {
  const std::string geo_file = written(name + ".geo", geo), msh_file = test_file(name + ".msh");
  const std::string command =
      fmt::format("gmsh -{} -v 1 {} {} -o {} < /dev/null", dimension, options, geo_file, msh_file);
  if (std::system(command.c_str()) != 0) throw base::Bug("failed: " + command);
  return msh_file;
}

inline const std::string structured_plate = R"(
Point(1) = {0, 0, 0}; Point(2) = {4, 0, 0}; Point(3) = {4, 3, 0}; Point(4) = {0, 3, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Curve{1, 3} = 5; Transfinite Curve{2, 4} = 4; Transfinite Surface{1}; Recombine Surface{1};
Physical Surface("plate", 1) = {1}; Physical Curve("left", 2) = {4}; Physical Point("corner", 3) = {1};
)";

/// Triangles and, beyond an inner line, quadrangles; a group without a name; a circular hole.
inline const std::string unstructured_plate = R"(
Point(1) = {0, 0, 0, 0.3}; Point(2) = {2, 0, 0, 0.3}; Point(3) = {2, 1, 0, 0.3}; Point(4) = {0, 1, 0, 0.3};
Point(5) = {1, 0, 0, 0.3}; Point(6) = {1, 1, 0, 0.3};
Point(7) = {0.5, 0.5, 0}; Point(8) = {0.3, 0.5, 0, 0.2}; Point(9) = {0.7, 0.5, 0, 0.2};
Line(1) = {1, 5}; Line(2) = {5, 2}; Line(3) = {2, 3}; Line(4) = {3, 6}; Line(5) = {6, 4}; Line(6) = {4, 1}; Line(7) = {5, 6};
Circle(8) = {8, 7, 9}; Circle(9) = {9, 7, 8};
Curve Loop(1) = {1, 7, 5, 6}; Curve Loop(2) = {8, 9}; Plane Surface(1) = {1, 2};
Curve Loop(3) = {2, 3, 4, -7}; Plane Surface(2) = {3}; Recombine Surface{2};
Mesh.RecombinationAlgorithm = 2;
Physical Surface("soft") = {1}; Physical Surface("stiff") = {2};
Physical Curve("hole") = {8, 9}; Physical Curve("interface") = {7}; Physical Curve(20) = {3};
)";

inline const std::string extruded_block = R"(
Point(1) = {0, 0, 0}; Point(2) = {2, 0, 0}; Point(3) = {2, 1, 0}; Point(4) = {0, 1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Curve{1, 3} = 4; Transfinite Curve{2, 4} = 3; Transfinite Surface{1}; Recombine Surface{1};
out[] = Extrude {0, 0, 1} { Surface{1}; Layers{2}; Recombine; };
Physical Volume("block") = {out[1]}; Physical Surface("bottom") = {1}; Physical Curve("edge") = {1};
)";

}  // namespace perimorph::mesh_files
