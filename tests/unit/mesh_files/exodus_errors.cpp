// What the Exodus reader says to files it cannot use.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gmsh_files.hpp"
#include "mesh_writers.hpp"
#include "unit/mesh/example_meshes.hpp"

namespace perimorph::mesh_files {
namespace {

using mesh::Mesh;
using testing::HasSubstr;
using testing::StartsWith;

constexpr std::array<int, 2> modes = {EX_CLOBBER | EX_LARGE_MODEL, EX_CLOBBER | EX_NETCDF4 | EX_NOCLASSIC};

std::string error_of(const std::string& text) {
  const std::string file = written("broken.e", text), message = error_of_reading<2>(file);
  EXPECT_THAT(message, StartsWith(file + ":"));
  return message.substr(std::min(message.size(), file.size()));
}

std::string exodus_text(const Mesh<2>& mesh, const ExodusOptions& options = {}) {
  const std::string file = test_file("whole.e");
  write_exodus(mesh, file, options);
  return contents(file);
}

/// Where a netCDF file's header says how large a dimension is: after its name, padded to four bytes, as four bytes.
std::string with_dimension(std::string text, const std::string& name, const std::string& four_bytes) {
  const std::size_t found = text.find(name);
  if (found == std::string::npos) throw base::Bug("the file has no " + name);
  return text.replace(found + (name.size() + 3) / 4 * 4, 4, four_bytes);
}

TEST(ExodusErrors, TheFile) {
  EXPECT_EQ(error_of_reading<2>("nowhere/mesh.e"), "nowhere/mesh.e: cannot be read: No such file or directory");
  EXPECT_EQ(error_of(""), ": the file is empty; an Exodus file is needed");
  EXPECT_EQ(error_of("# a comment\n"),
            ": not an Exodus file: it must begin as a netCDF or HDF5 file does, found \"# a comm\"");
  EXPECT_THAT(error_of(std::string("CDF\x02 and then garbage", 21)), HasSubstr("announces more than the file holds"));
  EXPECT_THAT(error_of("\x89HDF\r\n\x1a\n and then garbage"), HasSubstr("the file cannot be opened"));
}

TEST(ExodusErrors, AFileTruncatedAnywhereIsAnError) {
  for (const int mode : modes) {
    const std::string text = exodus_text(mesh::grid<2>({2, 1}), {mode});
    // Only the last bytes of the last variable may be missing: netCDF pads them.
    for (std::size_t size = 0; size + 8 < text.size(); size += 1 + text.size() / 100) {
      EXPECT_NE(error_of(text.substr(0, size)), "") << size << " of " << text.size() << " bytes, mode " << mode;
    }
  }
}

/// HDF5's library crashes on some of these.
TEST(ExodusErrors, AnHdf5FileDamagedAnywhereIsReadOrRefused) {
  const std::string text = exodus_text(mesh::grid<2>({2, 1}), {modes[1]});
  int n_refused = 0;
  for (std::size_t place = 8; place < text.size(); place += 1 + text.size() / 40) {
    std::string damaged = text;
    damaged.replace(place, 4, "\x7f\xff\xff\xff");
    const std::string file = written("damaged.e", damaged);
    try {
      EXPECT_GT(read_mesh<2>(file).n_elements(), 0);
    } catch (const base::UserError& error) {
      EXPECT_THAT(error.what(), StartsWith(file + ":"));
      ++n_refused;
    }
  }
  EXPECT_GT(n_refused, 10);
}

TEST(ExodusErrors, CountsThatTheFileCannotHold) {
  const std::string text = exodus_text(mesh::grid<2>({2, 1}));
  for (const char* name : {"num_nodes", "num_elem", "num_el_blk", "num_node_sets", "num_side_sets", "num_el_in_blk1",
                           "num_nod_ns1", "num_side_ss1"}) {
    for (const std::string& count : {std::string("\x7f\xff\xff\xfe"), std::string("\0\x0f\xff\xff", 4)}) {
      EXPECT_NE(error_of(with_dimension(text, name, count)), "") << name;
    }
  }
}

/// The library would allocate what the name's length says.
TEST(ExodusErrors, ALengthInTheHeaderThatTheFileCannotHold) {
  std::string text = exodus_text(mesh::grid<2>({2, 1}));
  text.replace(16, 4, "\x7f\xff\xff\xf0");  // after magic, records, tag and count: the first dimension's name
  EXPECT_THAT(error_of(text), HasSubstr("announces more than the file holds: it is truncated or damaged"));
}

TEST(ExodusErrors, OtherElements) {
  EXPECT_THAT(error_of(exodus_text(mesh::grid<2>({2, 1}), {EX_CLOBBER, 0, {"WEDGE", "WEDGE"}})),
              HasSubstr("block \"west\" has elements of type \"WEDGE\" with 4 nodes; allowed are triangles (TRI), "
                        "quadrangles (QUAD, SHELL), TETRA, PYRAMID, WEDGE and HEX, of first or second order"));
  EXPECT_THAT(error_of(exodus_text(mesh::grid<2>({2, 1}), {EX_CLOBBER, 0, {"QUADX", "QUADX"}})),
              HasSubstr("\"QUADX\""));
}

TEST(ExodusErrors, AMeshOfAnotherDimension) {
  const std::string file = test_file("cube.e");
  write_exodus(mesh::grid<3>({1, 1, 1}), file);
  EXPECT_THAT(error_of_reading<2>(file), HasSubstr("is of dimension 3, but the case has dimension 2"));
}

TEST(ExodusErrors, NumbersOutOfRange) {
  Mesh<2> mesh = mesh::grid<2>({2, 1});
  mesh.corners[3] = 77;
  EXPECT_THAT(error_of(exodus_text(mesh)), HasSubstr("element 1 has node 78; allowed are 1 to 6"));
  mesh = mesh::grid<2>({2, 1});
  mesh.side_sets["left"][0].element = 5;
  EXPECT_THAT(error_of(exodus_text(mesh)), HasSubstr("side set \"left\" has element 6; allowed are 1 to 2"));
  mesh = mesh::grid<2>({2, 1});
  mesh.node_sets["corner"] = {-1};
  EXPECT_THAT(error_of(exodus_text(mesh)), HasSubstr("node set \"corner\" has node 0; allowed are 1 to 6"));
}

TEST(ExodusErrors, ACoordinateThatIsNoNumber) {
  Mesh<2> mesh = mesh::grid<2>({2, 1});
  mesh.coordinates[2][1] = std::nan("");
  EXPECT_THAT(error_of(exodus_text(mesh)), HasSubstr("a coordinate of node 3 is nan"));
}

}  // namespace
}  // namespace perimorph::mesh_files
