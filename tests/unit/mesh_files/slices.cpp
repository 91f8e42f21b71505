// What the ranks read of a file, each its slice: together it is the whole file, and mistakes are found as in that.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>

#include "exodus_file.hpp"
#include "file_contents.hpp"
#include "gmsh_file.hpp"
#include "gmsh_files.hpp"
#include "mesh_writers.hpp"
#include "sliced_file.hpp"
#include "unit/mesh/example_meshes.hpp"

namespace perimorph::mesh_files {
namespace {

using testing::HasSubstr;

const base::Comm& ranks() {
  static const auto comm = Tpetra::getDefaultComm();
  return *comm;
}

/// A file's name, the same on all ranks.
std::string shared_file(const std::string& name) { return test_file(fmt::format("on_{}_{}", ranks().getSize(), name)); }

template <class Write>
void write_on_rank_0(Write write) {
  base::on_all_ranks(ranks(), [&] {
    if (ranks().getRank() == 0) write();
  });
}

/// The lists of all ranks, one after the other.
template <class T>
std::vector<std::vector<T>> gathered(const std::vector<std::vector<T>>& lists) {
  std::vector<T> items;
  std::vector<std::size_t> sizes;
  for (const auto& list : lists) {
    sizes.push_back(list.size());
    append(items, list);
  }
  items = base::gather_on_all(ranks(), items);
  std::vector<std::vector<T>> all;
  auto begin = items.begin();
  for (const std::size_t size : base::gather_on_all(ranks(), sizes)) {
    const auto end = begin + static_cast<std::ptrdiff_t>(size);
    all.emplace_back(begin, end);
    begin = end;
  }
  return all;
}

/// What all ranks have together. Its notes are this rank's: there may be none but on rank 0.
Contents gathered(const MeshFile& slice) {
  Contents own, all;
  own.add(slice);
  all.node_tags = base::gather_on_all(ranks(), own.node_tags);
  all.coordinates = base::gather_on_all(ranks(), own.coordinates);
  for (std::size_t d = 0; d < 4; ++d) {
    all.elements[d] = gathered(own.elements[d]);
    all.n_second_order[d] = static_cast<std::size_t>(base::sum(ranks(), base::GlobalId(own.n_second_order[d])));
  }
  all.mid_nodes = base::gather_on_all(ranks(), own.mid_nodes);
  all.n_plane_bodies = static_cast<std::size_t>(base::sum(ranks(), base::GlobalId(own.n_plane_bodies)));
  all.notes = own.notes;
  return all;
}

MeshFile read_whole(const std::string& file) {
  return contents(file).substr(0, 1) == "$" ? read_gmsh_file(file) : read_exodus_file(file);
}

/// @returns the whole
MeshFile expect_slices_to_be_the_whole(const std::string& file, const std::set<int>& dimensions_in_order) {
  SCOPED_TRACE(file);
  EXPECT_TRUE(can_be_sliced(file));
  MeshFile whole = read_whole(file);
  const MeshFile slice = read_slice(ranks(), file);
  Contents expected;
  expected.add(whole);
  if (ranks().getRank() > 0) expected.notes.clear();
  expect_same_description(slice, whole);
  expect_a_fair_share(slice.node_tags.size(), whole.node_tags.size(), ranks().getSize());
  for (const int d : dimensions_in_order) {
    expect_a_fair_share(elements_of(slice, d).size(), elements_of(whole, d).size(), ranks().getSize());
  }
  expect_alike(gathered(slice), expected, dimensions_in_order);
  return whole;
}

// ---- gmsh ----

std::string meshed_on_rank_0(const std::string& geo, int dimension, const std::string& name) {
  std::string file = shared_file(name + ".msh");
  write_on_rank_0([&] {
    const std::string geometry = written(fmt::format("{}_{}.geo", name, ranks().getSize()), geo);
    mesh_geometry(geometry, file, dimension);
  });
  return file;
}

TEST(Slices, OfBinaryMshFilesAreTheWhole) {
  const std::string second_order = "Mesh.ElementOrder = 2;\n";
  for (const std::string& order : {std::string(), second_order}) {
    const std::string name = order.empty() ? "first" : "second";
    expect_slices_to_be_the_whole(meshed_on_rank_0(unstructured_plate + order, 2, "plate_" + name), {0, 1, 2});
    expect_slices_to_be_the_whole(meshed_on_rank_0(extruded_block + order, 3, "block_" + name), {0, 1, 2, 3});
  }
}

TEST(Slices, OfMshTextsAreTheWhole) {
  for (const std::string& text : {two_squares_2_2, two_squares_4_1}) {
    const std::string file = shared_file("mesh.msh");
    write_on_rank_0([&] { written(std::filesystem::path(file).filename(), text); });
    expect_slices_to_be_the_whole(file, {1, 2});
  }
}

// ---- Exodus ----

constexpr std::array<int, 2> modes = {EX_CLOBBER | EX_LARGE_MODEL, EX_CLOBBER | EX_NETCDF4 | EX_NOCLASSIC};

template <int dim>
std::string exodus_on_rank_0(const mesh::Mesh<dim>& mesh, const ExodusOptions& options = {}) {
  std::string file = shared_file("mesh.e");
  write_on_rank_0([&] { write_exodus(mesh, file, options); });
  return file;
}

std::string parts_on_rank_0(const Points& points, const std::vector<Block>& blocks, const std::vector<Sides>& sets,
                            const std::vector<std::int64_t>& node_set = {}) {
  std::string file = shared_file("parts.e");
  write_on_rank_0([&] { write_exodus_parts(file, points, blocks, sets, node_set); });
  return file;
}

/// The grid's elements by block, as write_exodus() needs them.
template <int dim>
mesh::Mesh<dim> by_blocks(const mesh::Mesh<dim>& mesh) {
  mesh::Mesh<dim> result = mesh;
  const std::size_t n_corners = mesh.corners.size() / mesh.types.size();
  std::vector<int> order(mesh.types.size()), place(mesh.types.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return mesh.blocks[a] < mesh.blocks[b]; });
  for (std::size_t e = 0; e < order.size(); ++e) {
    place[order[e]] = static_cast<int>(e);
    result.blocks[e] = mesh.blocks[order[e]];
    std::copy_n(mesh.corners_of(order[e]), n_corners,
                result.corners.begin() + static_cast<std::ptrdiff_t>(e * n_corners));
  }
  for (auto& [name, sides] : result.side_sets) {
    for (mesh::Side& side : sides) side.element = place[side.element];
  }
  return result;
}

TEST(Slices, OfExodusFilesAreTheWhole) {
  for (const int mode : modes) {
    const MeshFile plane =
        expect_slices_to_be_the_whole(exodus_on_rank_0(by_blocks(mesh::grid<2>({9, 5})), {mode}), {2});
    EXPECT_EQ(plane.group_names.size(), 5u);  // two blocks, a side set, two node sets
    expect_slices_to_be_the_whole(exodus_on_rank_0(by_blocks(mesh::grid<3>({4, 3, 2})), {mode}), {3});
    expect_slices_to_be_the_whole(exodus_on_rank_0(mesh::grid<2>({2, 1}), {mode, 0, {}, 1, false}), {2});
  }
}

TEST(Slices, OfExodusFilesOfPlaneElementsInSpaceHaveTheSidesOfTheWhole) {
  for (const int first_side : {1, 3}) {
    for (const char* type : {"QUAD4", "SHELL4"}) {
      SCOPED_TRACE(fmt::format("{} {}", type, first_side));
      const MeshFile whole = expect_slices_to_be_the_whole(
          exodus_on_rank_0(by_blocks(mesh::grid<2>({7, 6})), {modes[0], 3, {type, type}, first_side}), {2});
      EXPECT_EQ(elements_of(whole, 1).size(), 6u);
      const bool is_usual = (type == std::string("SHELL4")) == (first_side == 3);
      EXPECT_EQ(whole.notes.size(), is_usual ? 0u : 1u);
    }
  }
}

const Points two_cubes = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0},
                          {0, 0, 1}, {1, 0, 1}, {2, 0, 1}, {0, 1, 1}, {1, 1, 1}, {2, 1, 1}};
const Block hexahedra = {1, "HEX8", 8, {1, 2, 5, 4, 7, 8, 11, 10, 2, 3, 6, 5, 8, 9, 12, 11}};

TEST(Slices, OfBlocksOfAllKindsAreTheWhole) {
  const std::vector<Block> blocks = {{7, "SPHERE", 1, {12}},
                                     {2, "SHELL4", 4, {7, 8, 11, 10, 8, 9, 12, 11}},
                                     hexahedra,
                                     {8, "BAR2", 2, {1, 2, 2, 3}},
                                     {9, "TRI3", 3, {1, 2, 5, 1, 5, 4}},
                                     {6000000000, "TETRA", 4, {1, 2, 5, 7}}};
  const std::vector<Sides> sets = {{1, {4, 5}, {4, 2}},        // faces of hexahedra
                                   {2, {2, 3, 3}, {1, 2, 4}},  // faces of shells, and an edge
                                   {3, {4, 1}, {4, 1}},        // of a sphere
                                   {4, {10, 5}, {4, 9}},       // none of its faces
                                   {5, {}, {}},
                                   {6, {10, 4}, {1, 6}}};  // triangle and quadrangle
  const MeshFile whole = expect_slices_to_be_the_whole(parts_on_rank_0(two_cubes, blocks, sets, {12, 1, 7, 7, 3}), {3});
  EXPECT_EQ(whole.notes.size(), 4u);
  EXPECT_EQ(elements_of(whole, 0).size(), 4u);
  EXPECT_EQ(elements_of(whole, 1).size(), 1u);
  EXPECT_EQ(elements_of(whole, 2).size(), 4u + 4u + 2u);
}

TEST(Slices, OfElementsOfSecondOrderAreTheWhole) {
  const Points points = {{0, 0, 0},  {1, 0, 0}, {1, 1, 0}, {0, 1, 0},   {.5, 0, 0}, {1, .5, 0}, {.5, 1, 0},
                         {0, .5, 0}, {2, 0, 0}, {2, 1, 0}, {1.5, 0, 0}, {2, .5, 0}, {1.5, 1, 0}};
  const MeshFile whole = expect_slices_to_be_the_whole(
      parts_on_rank_0(points, {{1, "QUAD8", 8, {1, 2, 3, 4, 5, 6, 7, 8, 2, 9, 10, 3, 11, 12, 13, 6}}},
                      {{1, {1, 2}, {4, 2}}}, {1, 4, 8}),
      {2});
  EXPECT_EQ(whole.n_second_order[2], 2u);
  EXPECT_EQ(whole.mid_nodes.size(), 8u);
}

/// Numbers of nodes and elements in descending order, or some twice: next to each other, or far apart.
TEST(Slices, HaveTheNumbersThatTheFileGives) {
  const mesh::Mesh<2> mesh = by_blocks(mesh::grid<2>({7, 5}));
  const std::array<std::function<std::int64_t(std::int64_t, std::int64_t)>, 3> numberings = {
      [](std::int64_t i, std::int64_t n) { return 1000 * (n - i); }, [](std::int64_t i, std::int64_t) { return i / 2; },
      [](std::int64_t i, std::int64_t n) { return i % (n - 1); }};
  for (const auto& numbering : numberings) {
    const std::string file = exodus_on_rank_0(mesh, {modes[1]});
    write_on_rank_0([&] {
      const ExodusWriter writer(file);
      for (const auto& [map, n] : {std::pair{EX_NODE_MAP, mesh.n_nodes()}, {EX_ELEM_MAP, mesh.n_elements()}}) {
        std::vector<std::int64_t> numbers;
        for (int i = 0; i < n; ++i) numbers.push_back(numbering(i, n));
        writer.check(ex_put_id_map(writer.id(), map, numbers.data()));
      }
    });
    const MeshFile whole = expect_slices_to_be_the_whole(file, {2});
    EXPECT_EQ(whole.node_tags[0], numbering(0, 2) == 0 ? 1 : 48000);
  }
}

// ---- files that cannot be used ----

template <class Read>
std::string error_of(Read read) {
  try {
    read();
  } catch (const base::UserError& error) {
    return error.what();
  }
  return "(no error)";
}

/// The message for the whole file, which all ranks have for their slices, too.
std::string expect_the_same_error(const std::string& file) {
  std::string whole = error_of([&] { read_whole(file); });
  const std::string slice = error_of([&] { read_slice(ranks(), file); });
  EXPECT_EQ(slice, whole);
  EXPECT_EQ(base::broadcast(ranks(), slice), slice);
  return whole;
}

std::string expect_the_same_error_of(const std::string& name, const std::string& text) {
  const std::string file = shared_file(name);
  write_on_rank_0([&] { written(std::filesystem::path(file).filename(), text); });
  return expect_the_same_error(file);
}

TEST(Slices, AMshFileTruncatedAnywhereIsTheSameError) {
  const std::string text = contents(meshed_on_rank_0(extruded_block, 3, "block"));
  for (std::size_t size = 30; size + 20 < text.size(); size += 1 + text.size() / 100) {
    SCOPED_TRACE(size);
    EXPECT_THAT(expect_the_same_error_of("truncated.msh", text.substr(0, size)), HasSubstr("truncated"));
  }
}

TEST(Slices, AMistakeInAMshTextIsTheSameError) {
  const std::string half = replaced(two_squares_2_2, "3 2 0 0\n", "3 2 0\n"), old = two_squares_2_2;
  EXPECT_THAT(expect_the_same_error_of("half.msh", half), HasSubstr(":17: a number expected, found \"$EndNodes\""));
  EXPECT_THAT(expect_the_same_error_of("kind.msh", replaced(old, "12 3 2", "12 93 2")), HasSubstr("gmsh's kind 93"));
  EXPECT_THAT(expect_the_same_error_of("letter.msh", replaced(two_squares_4_1, "2 1 0\n$End", "2 1 x\n$End")),
              HasSubstr("a number expected, found \"x\""));
  EXPECT_THAT(expect_the_same_error_of("nan.msh", replaced(two_squares_4_1, "2 1 0\n$End", "2 1 nan\n$End")),
              HasSubstr("a coordinate is nan"));
}

/// Any four bytes; what comes of it may be a mesh.
TEST(Slices, ADamagedMshFileIsTheSameError) {
  const std::string text = contents(meshed_on_rank_0(structured_plate, 2, "plate"));
  int n_errors = 0;
  for (std::size_t place = 20; place + 4 < text.size(); place += 1 + text.size() / 150) {
    SCOPED_TRACE(place);
    std::string damaged = text;
    damaged.replace(place, 4, "\xff\xff\x7f\x7f");
    n_errors += expect_the_same_error_of("damaged.msh", damaged) == "(no error)" ? 0 : 1;
  }
  EXPECT_GT(n_errors, 20);
}

/// The library reads zeros where the padding of the last variable is missing.
TEST(Slices, ATruncatedExodusFileIsTheSameError) {
  const std::string text = contents(exodus_on_rank_0(by_blocks(mesh::grid<2>({4, 3})), {modes[0]}));
  int n_accepted = 0;
  for (std::size_t size = 10; size + 8 < text.size(); size += 1 + text.size() / 100) {
    SCOPED_TRACE(size);
    n_accepted += expect_the_same_error_of("truncated.e", text.substr(0, size)) == "(no error)" ? 1 : 0;
  }
  EXPECT_LE(n_accepted, 1);
}

TEST(Slices, ADamagedHdf5FileIsRefusedOnAllRanks) {
  const std::string text = contents(exodus_on_rank_0(by_blocks(mesh::grid<2>({4, 3})), {modes[1]}));
  int n_errors = 0;
  for (std::size_t place = 8; place < text.size(); place += 1 + text.size() / 20) {
    SCOPED_TRACE(place);
    std::string damaged = text;
    damaged.replace(place, 4, "\x7f\xff\xff\xff");
    const std::string file = shared_file("damaged.e");
    write_on_rank_0([&] { written(std::filesystem::path(file).filename(), damaged); });
    const std::string error = error_of([&] { read_slice(ranks(), file); });
    EXPECT_EQ(base::broadcast(ranks(), error), error);
    n_errors += error == "(no error)" ? 0 : 1;
  }
  EXPECT_GT(n_errors, 5);
}

TEST(Slices, MistakesInExodusFilesAreTheSameErrors) {
  const mesh::Mesh<2> sound = by_blocks(mesh::grid<2>({4, 3}));
  mesh::Mesh<2> mesh = sound;
  mesh.corners[45] = 77;
  EXPECT_THAT(expect_the_same_error(exodus_on_rank_0(mesh)), HasSubstr("element 12 has node 78; allowed are 1 to 20"));
  mesh = sound;
  mesh.side_sets["left"][1].element = 50;
  EXPECT_THAT(expect_the_same_error(exodus_on_rank_0(mesh)),
              HasSubstr("side set \"left\" has element 51; allowed are 1 to 12"));
  mesh = sound;
  mesh.node_sets["corner"] = {-1};
  EXPECT_THAT(expect_the_same_error(exodus_on_rank_0(mesh)),
              HasSubstr("node set \"corner\" has node 0; allowed are 1 to 20"));
  mesh = sound;
  mesh.coordinates[18][1] = std::nan("");
  EXPECT_THAT(expect_the_same_error(exodus_on_rank_0(mesh)), HasSubstr("a coordinate of node 19 is nan"));
  EXPECT_THAT(expect_the_same_error(exodus_on_rank_0(sound, {modes[1], 0, {"WEDGE", "WEDGE"}})),
              HasSubstr("elements of type \"WEDGE\" with 4 nodes"));
}

TEST(Slices, AFileThatIsNotThereIsAnErrorOnAllRanks) {
  EXPECT_EQ(error_of([] { read_slice(ranks(), "nowhere.msh"); }),
            "nowhere.msh: cannot be read: No such file or directory");
  EXPECT_EQ(error_of([] { read_slice(ranks(), "nowhere.e"); }), "nowhere.e: cannot be read: No such file or directory");
}

}  // namespace
}  // namespace perimorph::mesh_files
