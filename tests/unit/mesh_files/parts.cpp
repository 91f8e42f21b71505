// A mesh that is built in parts, out of slices of its file, is the mesh that is built of the whole file.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>
#include <functional>

#include "abaqus_file.hpp"
#include "gmsh_file.hpp"
#include "gmsh_files.hpp"
#include "mesh_builder.hpp"
#include "mesh_writers.hpp"
#include "perimorph/mesh/distribute.hpp"
#include "unit/mesh/example_meshes.hpp"

namespace perimorph::mesh_files {
namespace {

using mesh::Mesh;
using testing::HasSubstr;

// ---- files and slices ----

/// A file that all ranks read as a whole, under the same name; rank 0 makes it.
template <class Read>
auto read_by_all(const base::Comm& comm, const Read& read, const std::function<std::string()>& make) {
  std::string file;
  base::on_all_ranks(comm, [&] {
    if (comm.getRank() == 0) file = make();
  });
  return read(base::broadcast(comm, file));
}

MeshFile gmsh_text(const base::Comm& comm, const std::string& text) {
  return read_by_all(
      comm, [](const std::string& file) { return read_gmsh_file(file); }, [&] { return written("mesh.msh", text); });
}

MeshFile gmsh_geometry(const base::Comm& comm, const std::string& geo, int dimension, const std::string& options = "") {
  return read_by_all(
      comm, [](const std::string& file) { return read_gmsh_file(file); },
      [&] { return meshed(geo, dimension, "-format msh41 " + options, "mesh"); });
}

MeshFile abaqus_text(const base::Comm& comm, const std::string& text) {
  return read_by_all(
      comm, [](const std::string& file) { return read_abaqus_file(file); }, [&] { return written("mesh.inp", text); });
}

/// How a list is cut among the ranks: the first item of each, and the number of all.
using Cuts = std::function<std::size_t(std::size_t n_items, int rank, int n_ranks)>;

const std::vector<std::pair<const char*, Cuts>> ways_to_cut = {
    {"evenly", [](std::size_t n, int rank, int n_ranks) { return n * rank / n_ranks; }},
    {"most on the first rank",
     [](std::size_t n, int rank, int n_ranks) { return rank == n_ranks ? n : n - n / (1 + 9 * rank * rank); }},
    {"all on the last rank", [](std::size_t n, int rank, int n_ranks) { return rank == n_ranks ? n : 0; }},
};

template <class T>
std::vector<T> cut(const std::vector<T>& items, const Cuts& cuts, const base::Comm& comm) {
  const auto at = [&](int rank) {
    return items.begin() + static_cast<std::ptrdiff_t>(cuts(items.size(), rank, comm.getSize()));
  };
  return {at(comm.getRank()), at(comm.getRank() + 1)};
}

void append_element(MeshFile& file, const MeshFile& from, std::size_t e, int group_list) {
  file.begin_element(from.element_tags[e], from.shapes[e], group_list);
  const auto nodes = from.element_nodes.begin();
  file.element_nodes.insert(file.element_nodes.end(), nodes + static_cast<std::ptrdiff_t>(from.first_node[e]),
                            nodes + static_cast<std::ptrdiff_t>(from.first_node[e + 1]));
  file.end_element();
}

/// This rank's. Lists of groups are numbered anew on each rank.
MeshFile slice_of(const MeshFile& whole, const base::Comm& comm, const Cuts& cuts) {
  const int rank = comm.getRank(), n_ranks = comm.getSize();
  MeshFile slice;
  slice.name = whole.name;
  slice.advice = whole.advice;
  slice.group_names = whole.group_names;
  slice.sides_follow_from_node_sets = whole.sides_follow_from_node_sets;
  if (rank == 0) slice.notes = whole.notes;
  if (rank == n_ranks - 1) slice.n_second_order = whole.n_second_order;
  if (rank == 0) slice.n_plane_bodies = whole.n_plane_bodies;
  slice.mid_nodes = cut(whole.mid_nodes, cuts, comm);
  slice.node_tags = cut(whole.node_tags, cuts, comm);
  slice.coordinates = cut(whole.coordinates, cuts, comm);
  std::map<int, int> lists = {{0, 0}};
  for (std::size_t e = cuts(whole.n_elements(), rank, n_ranks); e < cuts(whole.n_elements(), rank + 1, n_ranks); ++e) {
    const int list = whole.element_groups[e];
    if (lists.count(list) == 0) lists[list] = slice.add_group_list(whole.group_lists[list]);
    append_element(slice, whole, e, lists.at(list));
  }
  return slice;
}

// ---- comparisons ----

template <class Build>
std::string error_of(const Build& build) {
  try {
    build();
  } catch (const base::UserError& error) {
    return error.what();
  }
  return "(no error)";
}

/// The part is that of the whole mesh, to the last bit.
template <int dim>
void expect_part_of(const base::Comm& comm, const Mesh<dim>& whole, const Mesh<dim>& part) {
  const Mesh<dim> expected = mesh::distribute(comm, comm.getRank() == 0 ? whole : Mesh<dim>(), 0.);
  expect_same(part, expected, 0x1p-1000);
  EXPECT_EQ(part.node_ids, expected.node_ids);
  EXPECT_EQ(part.node_owners, expected.node_owners);
  EXPECT_EQ(part.element_ids, expected.element_ids);
  EXPECT_EQ(part.element_owners, expected.element_owners);
  EXPECT_EQ(part.rank, comm.getRank());
  EXPECT_EQ(part.n_owned_nodes, expected.n_owned_nodes);
  EXPECT_EQ(part.n_owned_elements, expected.n_owned_elements);
  EXPECT_EQ(part.n_global_nodes, whole.n_global_nodes);
  EXPECT_EQ(part.n_global_elements, whole.n_global_elements);
  EXPECT_EQ(part.notes, comm.getRank() == 0 ? whole.notes : std::vector<std::string>());
}

template <int dim>
void expect_the_same_in_parts(const base::Comm& comm, const MeshFile& file, double scale = 1.) {
  const Mesh<dim> whole = build_mesh<dim>(file, scale);
  for (const auto& [way, cuts] : ways_to_cut) {
    SCOPED_TRACE(way);
    expect_part_of(comm, whole, build_parts<dim>(comm, slice_of(file, comm, cuts), scale));
  }
}

template <int dim>
void expect_the_same_error(const base::Comm& comm, const MeshFile& file, const std::string& part_of_it,
                           double scale = 1.) {
  const std::string expected = error_of([&] { build_mesh<dim>(file, scale); });
  EXPECT_THAT(expected, HasSubstr(part_of_it));
  for (const auto& [way, cuts] : ways_to_cut) {
    SCOPED_TRACE(way);
    const MeshFile slice = slice_of(file, comm, cuts);
    EXPECT_EQ(error_of([&] { build_parts<dim>(comm, slice, scale); }), expected);
  }
}

class Parts : public testing::Test {
 protected:
  /// The name of a file that rank 0 writes.
  std::string written_by_0(const std::function<std::string()>& write) const {
    return read_by_all(
        *comm, [](const std::string& file) { return file; }, write);
  }

  const Teuchos::RCP<const base::Comm> comm = Tpetra::getDefaultComm();
};

// ---- meshes that are as they should be ----

TEST_F(Parts, MoreRanksThanElements) { expect_the_same_in_parts<2>(*comm, gmsh_text(*comm, two_squares_2_2)); }

TEST_F(Parts, QuadranglesAndTheirSides) {
  expect_the_same_in_parts<2>(*comm, gmsh_geometry(*comm, structured_plate, 2));
}

TEST_F(Parts, SeveralBlocksBothKindsAndAnInnerSet) {
  const MeshFile file = gmsh_geometry(*comm, unstructured_plate, 2);
  expect_the_same_in_parts<2>(*comm, file);
  EXPECT_EQ(build_mesh<2>(file, 1.).side_sets.count("interface"), 1U);
}

TEST_F(Parts, Solids) { expect_the_same_in_parts<3>(*comm, gmsh_geometry(*comm, extruded_block, 3)); }

const std::string two_boxes = R"(
SetFactory("OpenCASCADE"); Box(1) = {0, 0, 0, 1, 1, 1}; Box(2) = {1, 0, 0, 1, 1, 1};
BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; }
Mesh.MeshSizeMax = 0.25;
Physical Volume("west") = {1}; Physical Volume("east") = {2};
Physical Surface("all") = Surface{:}; Physical Surface("some") = {1, 3, 8};
Physical Curve("edges") = Curve{:}; Physical Point("corners") = Point{:};
)";

/// Two blocks with all their faces, edges and corners in groups, in an order that has nothing to do with
/// places.
TEST_F(Parts, ManyTetrahedraInAnyOrder) {
  const MeshFile ordered = gmsh_geometry(*comm, two_boxes, 3);
  MeshFile shuffled = ordered;
  shuffled.element_tags.clear();
  shuffled.shapes.clear();
  shuffled.element_groups.clear();
  shuffled.first_node = {0};
  shuffled.element_nodes.clear();
  const std::size_t n = ordered.n_elements(), n_nodes = ordered.node_tags.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t e = i * 7919 % n;
    append_element(shuffled, ordered, e, ordered.element_groups[e]);
  }
  for (std::size_t i = 0; i < n_nodes; ++i) {
    const std::size_t place = i * 7919 % n_nodes;
    shuffled.node_tags[i] = 1000003 * ordered.node_tags[place];
    shuffled.coordinates[i] = ordered.coordinates[place];
  }
  for (auto& tag : shuffled.element_nodes) tag *= 1000003;
  ASSERT_TRUE(n % 7919 != 0 && n_nodes % 7919 != 0 && n > 500);
  expect_the_same_in_parts<3>(*comm, shuffled);
  EXPECT_EQ(build_mesh<3>(shuffled, 1.).side_sets.size(), 2U);
}

TEST_F(Parts, CoordinatesAreScaled) {
  expect_the_same_in_parts<3>(*comm, gmsh_geometry(*comm, extruded_block, 3), 1000.);
}

TEST_F(Parts, WithoutGroups) {
  MeshFile file = gmsh_geometry(*comm, structured_plate, 2);
  file.group_lists.assign(file.group_lists.size(), {});
  file.group_names.clear();
  expect_the_same_in_parts<2>(*comm, file);
}

/// A wedge written as a hexahedron beside a hexahedron and a tetrahedron in other blocks, with surfaces.
TEST_F(Parts, SolidsWithRepeatedNodes) {
  const MeshFile file = abaqus_text(
      *comm,
      "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n9,2,0,0\n10,2,0,1\n11,3,0,3\n"
      "*ELEMENT,TYPE=C3D8R,ELSET=all\n1,1,2,3,4,5,6,7,8\n2,2,9,3,3,6,10,7,7\n"
      "*ELEMENT,TYPE=C3D4,ELSET=tip\n3,6,10,7,11\n*SURFACE,NAME=top\nall,S2\n*SURFACE,NAME=slant\n2,S4\n"
      "*SURFACE,NAME=nothing\n2,S5\n*SURFACE,NAME=outside\nall,\n*NSET,NSET=upper\n5,6,7,8,10\n");
  expect_the_same_in_parts<3>(*comm, file);
  EXPECT_THAT(build_mesh<3>(file, 1.).notes, testing::Contains(HasSubstr("repeated nodes leave nothing of them")));
}

// ---- what is mended or left out, with a note ----

TEST_F(Parts, NodesBetweenCornersAndOthersAreDropped) {
  MeshFile file = gmsh_geometry(*comm, unstructured_plate, 2, "-order 2");
  for (int n = 0; n < 7; ++n) {
    const std::size_t place = n * file.node_tags.size() / 7;
    file.node_tags.insert(file.node_tags.begin() + static_cast<std::ptrdiff_t>(place), 100000 - n);
    file.coordinates.insert(file.coordinates.begin() + static_cast<std::ptrdiff_t>(place), {1., 2., 3.});
  }
  expect_the_same_in_parts<2>(*comm, file);
  EXPECT_THAT(build_mesh<2>(file, 1.).notes, testing::Contains(HasSubstr("dropped: 7 nodes in no 2D element (100000")));
}

TEST_F(Parts, SolidsOfSecondOrder) {
  expect_the_same_in_parts<3>(*comm, gmsh_geometry(*comm, extruded_block, 3, "-order 2"));
}

/// Mirrors the order of an element's nodes, if it is a plane one.
void reverse(MeshFile& file, std::size_t element) {
  std::reverse(file.element_nodes.begin() + static_cast<std::ptrdiff_t>(file.first_node[element]),
               file.element_nodes.begin() + static_cast<std::ptrdiff_t>(file.first_node[element + 1]));
}

TEST_F(Parts, ReversedElementsAreTurned) {
  MeshFile file = gmsh_geometry(*comm, unstructured_plate, 2);
  for (std::size_t e = file.n_elements() / 2; e < file.n_elements(); e += 3) reverse(file, e);
  expect_the_same_in_parts<2>(*comm, file);
  EXPECT_THAT(build_mesh<2>(file, 1.).notes, testing::Contains(HasSubstr("are turned (the first is element")));
}

TEST_F(Parts, SidesFollowFromNodeSets) {
  const int n = 5;
  std::string text = "*NODE\n";
  for (int i = 0; i < (n + 1) * (n + 1); ++i) text += fmt::format("{},{},{}\n", i + 1, i % (n + 1), i / (n + 1));
  text += "*ELEMENT,TYPE=CPS4,ELSET=plate\n";
  for (int i = 0; i < n * n; ++i) {
    const int first = i / n * (n + 1) + i % n + 1;
    text += fmt::format("{},{},{},{},{}\n", i + 1, first, first + 1, first + n + 2, first + n + 1);
  }
  text += fmt::format("*NSET,NSET=bottom,GENERATE\n1,{}\n*NSET,NSET=inner\n8,9,10\n*NSET,NSET=corner\n1,36\n", n + 1);
  text += "*NSET,NSET=left,GENERATE\n1,31,6\n*NSET,NSET=all,GENERATE\n1,36\n*SURFACE,NAME=right\n5,S2\n10,S2\n25,S2\n";
  const MeshFile file = abaqus_text(*comm, text);
  expect_the_same_in_parts<2>(*comm, file);
  const Mesh<2> whole = build_mesh<2>(file, 1.);
  EXPECT_EQ(whole.side_sets.at("left").size(), 5U);
  EXPECT_EQ(whole.side_sets.count("inner"), 0U);
}

/// In gmsh's structured plate: the first element of a dimension.
std::size_t first_of(const MeshFile& file, int dim) {
  std::size_t e = 0;
  while (dimension(file.shapes[e]) != dim) ++e;
  return e;
}

TEST_F(Parts, GroupsThatDoNotFitAreLeftOut) {
  MeshFile file = gmsh_geometry(*comm, structured_plate, 2);
  // No side: a line between nodes that are no neighbours.
  const std::size_t line = first_of(file, 1);
  file.element_nodes[file.first_node[line + 1] - 1] = file.node_tags.back();
  // Of one name, but with other nodes.
  const int others = file.add_group_list({70}), same = file.add_group_list({71, 72});
  file.group_names[{1, 70}] = "corner";
  file.add_element(9001, Shape::line, others, {file.node_tags[0], file.node_tags[4]});
  // Two of one name with the same nodes, which is a side: this fits.
  file.group_names[{1, 71}] = file.group_names[{1, 72}] = "twice";
  file.add_element(9002, Shape::line, same, {file.node_tags[0], file.node_tags[3]});
  // Without a node of the mesh.
  file.node_tags.push_back(8000);
  file.coordinates.push_back({9., 9., 0.});
  const int outside = file.add_group_list({80});
  file.group_names[{0, 80}] = "outside";
  file.add_element(9003, Shape::point, outside, {8000});
  file.group_names[{1, 81}] = "without elements";

  expect_the_same_in_parts<2>(*comm, file);
  const auto notes = build_mesh<2>(file, 1.).notes;
  for (const char* text : {"\"corner\" are left out, since their nodes differ",
                           "\"outside\" is left out: no 2D element", "\"left\" has nodes but no sides: element"}) {
    EXPECT_THAT(notes, testing::Contains(HasSubstr(text)));
  }
}

TEST_F(Parts, PlaneElementsAreOnlySidesInThreeDimensions) {
  MeshFile file = gmsh_geometry(*comm, extruded_block, 3);
  file.n_plane_bodies = 6;
  file.notes = {"a note of the reader"};
  expect_the_same_in_parts<3>(*comm, file);
}

// ---- files that are read in slices ----

TEST_F(Parts, FilesOfAllFormatsAreReadInParts) {
  const std::string geo = written_by_0([] { return written("plate.geo", unstructured_plate); });
  const std::string folder = std::filesystem::path(geo).parent_path();
  const std::string msh = written_by_0([] { return meshed(structured_plate, 2, "-format msh22 -bin", "plate_22"); });
  const std::string exodus = written_by_0([&] {
    write_exodus(read_mesh<2>(msh), test_file("plate.e"));
    return test_file("plate.e");
  });
  const std::string cdb = written_by_0([&] { return written("plate.cdb", ansys_archive(read_mesh<2>(msh))); });
  for (const std::string& file : {msh, exodus, cdb}) {
    SCOPED_TRACE(file);
    expect_part_of(*comm, read_mesh<2>(file, 10.), mesh_and_read_parts<2>(*comm, file, folder, 10.));
  }
  const Mesh<2> part = mesh_and_read_parts<2>(*comm, geo, folder);
  expect_part_of(*comm, read_mesh<2>(folder + "/plate.msh"), part);
}

TEST_F(Parts, MistakesInFilesAreToldByAllRanks) {
  const std::string unknown = written_by_0([] { return written("mesh.txt", "no mesh"); });
  const std::string geo = written_by_0([] { return written("solid.geo", structured_plate); });
  const std::string folder = std::filesystem::path(geo).parent_path();
  EXPECT_THAT(error_of([&] { mesh_and_read_parts<2>(*comm, unknown, folder); }),
              HasSubstr("neither its content nor its ending"));
  EXPECT_THAT(error_of([&] { mesh_and_read_parts<2>(*comm, folder + "/missing.msh", folder); }),
              HasSubstr("cannot be read"));
  EXPECT_THAT(error_of([&] { mesh_and_read_parts<3>(*comm, geo, folder); }),
              AllOf(HasSubstr(geo + ": the mesh has no elements of dimension 3"), HasSubstr("Physical Volume (3D)")));
}

// ---- errors ----

struct Mistake {
  const char* message;
  std::function<void(MeshFile&)> make;
};

std::size_t node_place(const MeshFile& file, std::size_t e, std::size_t corner) { return file.first_node[e] + corner; }

TEST_F(Parts, MistakesAreToldAsOfTheWholeFile) {
  const MeshFile plate = gmsh_geometry(*comm, structured_plate, 2);
  const std::size_t n = plate.n_elements();
  const auto node = [&](std::size_t e, std::size_t corner) {
    return plate.element_nodes[node_place(plate, e, corner)];
  };
  const std::vector<Mistake> mistakes = {
      {"two nodes have the number",
       [](MeshFile& file) {
         file.node_tags[17] = file.node_tags[2];
         file.node_tags[9] = file.node_tags[12];
       }},
      {"which the file does not list",
       [&](MeshFile& file) {
         for (const std::size_t e : {n - 1, n - 4}) file.element_nodes[node_place(file, e, 1)] = 777;
       }},
      {"has node 778, which the file does not list", [](MeshFile& file) { file.element_nodes[0] = 778; }},
      {"are the corners of no triangle or quadrangle",
       [&](MeshFile& file) {
         for (const std::size_t e : {n - 2, n - 5}) file.element_nodes[node_place(file, e, 2)] = node(e, 0);
       }},
      {"is in no group, but others are", [&](MeshFile& file) { file.element_groups[n - 3] = 0; }},
      {"is in two groups, \"plate\" and \"second\"",
       [&](MeshFile& file) {
         const int group = file.group_lists[file.element_groups[n - 1]][0];
         file.group_names[{2, group + 1}] = "second";
         file.element_groups[n - 2] = file.add_group_list({group, group + 1});
       }},
      {"two groups are named \"plate\"",
       [&](MeshFile& file) {
         file.group_names[{2, 44}] = "plate";
         file.element_groups[n - 2] = file.add_group_list({44});
       }},
      {"surface 44 has a name of 3 characters",
       [&](MeshFile& file) {
         file.group_names[{2, 44}] = "a\nb";
         file.element_groups[n - 2] = file.add_group_list({44});
       }},
      {"point 45 has a name of 0 characters",
       [&](MeshFile& file) {
         file.group_names[{0, 45}] = "";
         file.add_element(9000, Shape::point, file.add_group_list({45}), {file.node_tags[0]});
       }},
      {"must lie in the plane z = constant",
       [](MeshFile& file) {
         file.coordinates[3][2] = -0.25;
         file.coordinates.back()[2] = 0.5;
       }},
      {"has a coordinate of", [](MeshFile& file) { file.coordinates[5][0] = file.coordinates[13][1] = 1e200; }},
      {"is degenerate or not convex (",
       [](MeshFile& file) { file.coordinates.back() = file.coordinates[file.coordinates.size() - 2]; }},
      {"have the same nodes",
       [&](MeshFile& file) {
         for (const std::size_t e : {n - 1, n - 7}) {
           file.add_element(9000 + static_cast<std::int64_t>(e), Shape::quadrangle, file.element_groups[e],
                            {node(e, 1), node(e, 2), node(e, 3), node(e, 0)});
         }
       }},
      {"is in two groups, \"plate\" and \"again\" (there as element 9000)",
       [&](MeshFile& file) {
         file.group_names[{2, 44}] = "again";
         file.add_element(9000, Shape::quadrangle, file.add_group_list({44}),
                          {node(n - 6, 0), node(n - 6, 1), node(n - 6, 2), node(n - 6, 3)});
       }},
      {"lie on the same side of the side they share",
       [&](MeshFile& file) {
         file.node_tags.push_back(8000);
         file.coordinates.push_back({2.1, 1.7, 0.});
         file.add_element(9000, Shape::triangle, file.element_groups[n - 1],
                          {plate.element_nodes[node_place(plate, first_of(plate, 1), 0)],
                           plate.element_nodes[node_place(plate, first_of(plate, 1), 1)], 8000});
       }},
      {"share one side: they overlap",
       [&](MeshFile& file) {
         file.node_tags.push_back(8000);
         file.coordinates.push_back({2.1, 1.7, 0.});
         file.add_element(9000, Shape::triangle, file.element_groups[n - 1], {node(n - 6, 1), node(n - 6, 2), 8000});
       }},
  };
  for (const auto& [message, make] : mistakes) {
    SCOPED_TRACE(message);
    MeshFile file = plate;
    make(file);
    expect_the_same_error<2>(*comm, file, message);
  }
}

TEST_F(Parts, AMeshOfAnotherDimension) {
  expect_the_same_error<3>(*comm, gmsh_geometry(*comm, structured_plate, 2), "no elements of dimension 3, its highest");
  expect_the_same_error<2>(*comm, gmsh_geometry(*comm, extruded_block, 3), "but the case has dimension 2");
  MeshFile nothing;
  nothing.name = "nothing";
  expect_the_same_error<2>(*comm, nothing, "the mesh has no elements");
}

TEST_F(Parts, AScaleThatLeavesNoNumbers) {
  expect_the_same_error<2>(*comm, gmsh_geometry(*comm, structured_plate, 2), "has a coordinate of", 1e300);
}

}  // namespace
}  // namespace perimorph::mesh_files
