// Running gmsh on a geometry, which is a program of its own.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gmsh_files.hpp"

namespace perimorph::mesh_files {
namespace {

using testing::HasSubstr;
using testing::Not;

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
  EXPECT_THAT(message, HasSubstr("Its messages:\n"));
  EXPECT_THAT(message, HasSubstr("Unknown variable 'unknown'"));
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
  EXPECT_THAT(message, HasSubstr("gmsh failed (status 3)"));
  EXPECT_THAT(message, Not(HasSubstr("OMPI_")));
}

// ---- geometries that do more than describe a body ----

const std::string square = R"(
SetFactory("OpenCASCADE"); Rectangle(1) = {0, 0, 0, 2, 2}; MeshSize{:} = 1;
Physical Surface("body", 1) = {1}; Physical Curve("right", 2) = {2};
)";

/// The message of the error that a geometry is refused with, after the file's name.
std::string refusal(const std::string& text) {
  const std::string geo = written("plate.geo", text), message = error_of_meshing(geo, test_file("plate.msh"));
  EXPECT_THAT(message, testing::StartsWith(geo + ":"));
  return message.substr(std::min(message.size(), geo.size()));
}

TEST(Geometry, CommandsThatRunProgramsOrWriteFilesAreRefused) {
  const std::string file = test_file("written");
  for (const std::string& command : std::vector<std::string>{
           "SystemCall \"touch " + file + "\";", "NonBlockingSystemCall \"touch " + file + "\";",
           "System 'touch " + file + "';", "SystemCall Str(\"touch \", \"" + file + "\");",
           "/* */ SystemCall/**/\"touch " + file + "\" ;", "OnelabRun(\"x\", \"touch " + file + "\");",
           "Field[1] = ExternalProcess; Field[1].CommandLine = \"touch " + file + "\"; Background Field = 1;",
           "Print \"" + file + "\";", "Save \"" + file + "\";", "CreateDir \"" + file + "\";",
           "Printf(\"a (b)\", 1) > \"" + file + "\";", "Printf(\"a\") >> \"" + file + "\";",
           "Macro(\"m\", StrCat(\"Sys\", \"temCall 'touch " + file + "';\")); Call m;",
           "Merge StrCat(\"oth\", \"er.geo\");",
           "General.SaveSession = 1; General.SessionFileName = \"" + file + "\";"}) {
    SCOPED_TRACE(command);
    EXPECT_THAT(refusal(fmt::format("{}\n{}", square, command)),
                HasSubstr("; allowed are geometries that neither run programs nor write "
                          "files, unless --allow-shell is given"));
    EXPECT_FALSE(std::filesystem::exists(file));
  }
}

TEST(Geometry, TheRefusalNamesThePlace) {
  EXPECT_THAT(refusal(square + "// SystemCall \"in a comment\"\nSystemCall \"id\";\n"),
              testing::StartsWith(":5: SystemCall runs a command; allowed"));
  written("other.geo", "\nSave \"x\";");
  written("between.geo", "Include \"other.geo\";\nInclude \"between.geo\";");
  EXPECT_THAT(refusal("Include 'between.geo';" + square), HasSubstr("other.geo:2: Save writes a file; allowed"));
}

TEST(Geometry, OptionsBesideTheGeometryRunNoCommandsEither) {
  const std::string file = test_file("written"),
                    options = written("plate.geo.opt", "Printf(\"a\") > \"" + file + "\";");
  std::filesystem::remove(file);
  EXPECT_THAT(refusal(square), HasSubstr("plate.geo.opt:1: Printf writes a file; allowed"));
  EXPECT_FALSE(std::filesystem::exists(file));
  std::filesystem::remove(options);
}

TEST(Geometry, WhatOnlyLooksLikeACommandIsNotRefused) {
  written("sizes.geo", "h = 1;");
  const std::string geo =
      written("plate.geo", "// SystemCall, Print\n/* Save \"x\"; */ Include \"sizes.geo\";\n" + square +
                               "System = 3; Printf(\"SystemCall > %g\", System > 2); Mesh.SaveAll = 0;\n"
                               "Print.Background = 1; Macro nothing\nReturn\nCall nothing;");
  EXPECT_EQ(error_of_meshing(geo, test_file("plate.msh")), "(no error)");
}

TEST(Geometry, CommandsRunIfTheyAreAllowed) {
  const std::string file = test_file("written"),
                    geo = written("plate.geo", square + "SystemCall \"touch " + file + "\";");
  std::filesystem::remove(file);
  mesh_geometry(geo, test_file("plate.msh"), 2, {SideEffects::allowed});
  EXPECT_TRUE(std::filesystem::exists(file));
}

/// A command that is hidden from us, as by a fault of ours: gmsh's process can start none.
TEST(Geometry, TheProcessCanStartNoOther) {
  const std::string file = test_file("written"), path = std::getenv("PATH");
  std::filesystem::remove(file);
  const std::string gmsh = written("gmsh", "#!/bin/sh\n/usr/bin/touch " + file + " || echo refused\nexit 3\n");
  std::filesystem::permissions(gmsh, std::filesystem::perms::owner_all);
  setenv("PATH", (std::filesystem::path(gmsh).parent_path().string() + ":" + path).c_str(), 1);
  const std::string message = error_of_meshing(written("plate.geo", square), test_file("plate.msh"));
  setenv("PATH", path.c_str(), 1);
  EXPECT_THAT(message, HasSubstr("refused"));
  EXPECT_FALSE(std::filesystem::exists(file));
}

/// Of a mesh made from a geometry: the message of its error, or its notes.
template <int dim>
std::string said_of(const std::string& geo) {
  const std::string folder = std::filesystem::path(geo).parent_path();
  try {
    return notes_of(mesh_and_read<dim>(geo, folder), geo);
  } catch (const base::UserError& error) {
    EXPECT_THAT(error.what(), Not(HasSubstr(".msh")));
    return error.what();
  }
}

TEST(Geometry, MessagesNameTheGeometryNotTheMeshMadeOfIt) {
  const std::string only_curve = written("plate.geo", replaced(square, "Physical Surface(\"body\", 1) = {1};", ""));
  EXPECT_THAT(said_of<2>(only_curve),
              testing::StartsWith(only_curve + ": the mesh has no elements of dimension 2, its "
                                               "highest is 1: put what is to be computed into a "
                                               "Physical Surface"));
  const std::string flat = written("flat.geo", square);
  EXPECT_THAT(said_of<3>(flat),
              testing::StartsWith(flat + ": the mesh has no elements of dimension 3, its highest is 2"));
  const std::string nothing = written("nothing.geo", "Point(1) = {0, 0, 0};");
  EXPECT_THAT(said_of<2>(nothing), testing::StartsWith(nothing + ": "));
  const std::string third = written("third.geo", square + "Mesh.ElementOrder = 3;");
  EXPECT_THAT(said_of<2>(third), HasSubstr("is of gmsh's kind"));
}

/// What gmsh goes on with for ever, each in its own way.
TEST(Geometry, OneThatDoesNotEndIsEndedAndNamed) {
  for (const std::string endless :
       {"For i In {0:1}\n i = 0;\nEndFor\n", "For i In {0:1}\n i = 0; Printf(\"on\");\nEndFor\n", "Sleep 1000;\n",
        "Macro again\n Call again;\nReturn\nCall again;\n"}) {
    SCOPED_TRACE(endless);
    const std::string geo = written("endless.geo", square + endless), msh = test_file("endless.msh");
    try {
      mesh_geometry(geo, msh, 2, {SideEffects::refused, 0.01});
      ADD_FAILURE() << "it ended";
    } catch (const base::UserError& error) {
      EXPECT_EQ(error.what(), geo +
                                  ": gmsh was still meshing it after 0.01 min, and was ended: either it loops forever, "
                                  "or it needs a higher /Mesh/Maximum Meshing Minutes");
    }
    EXPECT_FALSE(std::filesystem::exists(msh));
  }
}

TEST(Geometry, ALastCommandThatGmshPassesOverIsAnError) {
  for (const std::string end : {"Physical Curve(\"a\", 7) = {1}; Physical Curve(\"b\", 8) = {3};",
                                "Physical Curve(\"a\", 7) = {1}; Physical Curve(\"b\", 8) = {3}; // comment"}) {
    EXPECT_THAT(said_of<2>(written("plate.geo", square + end)),
                HasSubstr("plate.geo: gmsh passes over the last command"));
    EXPECT_EQ(said_of<2>(written("plate.geo", square + end + "\n")), "");
  }
  const std::string geo = written("plate.geo", square + "Physical Curve(\"a\", 7) = {1};");
  EXPECT_EQ(mesh_and_read<2>(geo, std::filesystem::path(geo).parent_path()).side_sets.count("a"), 1u);
}

TEST(Geometry, WhatMeshingAnewUndoesIsTold) {
  const std::string crack =
      "Mesh 2; Plugin(Crack).Dimension = 1; Plugin(Crack).PhysicalGroup = 2; Plugin(Crack).Run;\n";
  EXPECT_THAT(said_of<2>(written("plate.geo", square + crack)), HasSubstr("Plugin(Crack) has no effect"));
  EXPECT_THAT(said_of<2>(written("plate.geo", square + "Mesh 2; RecombineMesh;\n")),
              HasSubstr("RecombineMesh has no effect: the geometry is meshed again after all its commands"));
  EXPECT_EQ(said_of<2>(written("plate.geo", square + "// Plugin(Crack).Run;")), "");
}

TEST(Geometry, TheCentreOfACircleIsDropped) {
  const std::string geo =
      written("plate.geo", replaced(unstructured_plate, "Physical Surface", "Mesh.SaveAll = 1; Physical Surface"));
  EXPECT_EQ(said_of<2>(geo), "dropped: 1 node in no 2D element (7)\n");
}

}  // namespace
}  // namespace perimorph::mesh_files
