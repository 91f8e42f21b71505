#pragma once

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "perimorph/base/errors.hpp"
#include "perimorph/cases/case.hpp"
#include "support/temporary_directory.hpp"

// A valid case. The tests replace a piece of it, and count lines from its first.
inline const std::string valid = R"xml(<ParameterList name="plate">
  <ParameterList name="Mesh">
    <Parameter name="File" type="string" value="plate.msh"/>
  </ParameterList>
  <ParameterList name="Material">
    <Parameter name="Young's Modulus" type="double" value="30000"/>
    <Parameter name="Poisson's Ratio" type="double" value="0.3333"/>
    <Parameter name="Elastic Model" type="string" value="Plane Stress"/>
    <Parameter name="Critical Stretch" type="double" value="0.05"/>
  </ParameterList>
  <ParameterList name="Peridynamics">
    <Parameter name="Horizon" type="double" value="1.5"/>
    <Parameter name="Characteristic Length" type="double" value="0.1"/>
  </ParameterList>
  <ParameterList name="Morphing">
    <ParameterList name="Seeds">
      <ParameterList name="tip">
        <Parameter name="Center" type="Array(double)" value="{100, 10}"/>
        <Parameter name="Inner Radius" type="double" value="4"/>
        <Parameter name="Outer Radius" type="double" value="6"/>
      </ParameterList>
      <ParameterList name="bar">
        <Parameter name="Shape" type="string" value="Box"/>
        <Parameter name="Lower Corner" type="Array(double)" value="{0, 0}"/>
        <Parameter name="Upper Corner" type="Array(double)" value="{5, 1}"/>
        <Parameter name="Rim" type="double" value="2"/>
      </ParameterList>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Pre-Cracks">
    <ParameterList name="slit">
      <Parameter name="Points" type="Array(double)" value="{0, 0, 5, 0}"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Boundary Conditions">
    <ParameterList name="Displacements">
      <ParameterList name="hold">
        <Parameter name="Group" type="string" value="left"/>
        <Parameter name="Component" type="string" value="x"/>
      </ParameterList>
      <ParameterList name="pull">
        <Parameter name="Group" type="string" value="right"/>
        <Parameter name="Component" type="string" value="x"/>
        <Parameter name="Rate" type="double" value="-0.02"/>
      </ParameterList>
      <ParameterList name="guide">
        <Parameter name="Group" type="string" value="left"/>
        <Parameter name="Component" type="string" value="y"/>
      </ParameterList>
    </ParameterList>
    <ParameterList name="Tractions">
      <ParameterList name="wind">
        <Parameter name="Group" type="string" value="top"/>
        <Parameter name="Rate" type="Array(double)" value="{0, -1}"/>
      </ParameterList>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Loading">
    <Parameter name="Increments" type="int" value="100"/>
  </ParameterList>
  <ParameterList name="Solver">
    <ParameterList name="MueLu">
      <Parameter name="coarse: max size" type="int" value="50"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Output">
    <Parameter name="Reactions" type="Array(string)" value="{left, right}"/>
  </ParameterList>
</ParameterList>
)xml";

/// A mesh with its groups, of two rectangles or cuboids.
inline std::string mesh_of(int dimension) {
  const bool flat = dimension == 2;
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n4\n";
  for (const char* name : {"1 \"left\"", "2 \"right\"", "3 \"top\""})
    text += (flat ? "1 " : "2 ") + std::string(name) + "\n";
  text += std::to_string(dimension) + " 4 \"body\"\n$EndPhysicalNames\n$Nodes\n" + (flat ? "6" : "12") + "\n";
  int node = 0;
  for (const int z : {-10, 10}) {
    if (flat && z > 0) break;
    for (const char* xy : {"0 -10", "12 -10", "12 10", "0 10", "200 -10", "200 10"}) {
      text += std::to_string(++node) + " " + xy + " " + std::to_string(flat ? 0 : z) + "\n";
    }
  }
  return text + "$EndNodes\n$Elements\n6\n" +
         (flat ? "1 1 2 1 1 1 4\n2 1 2 2 2 5 6\n3 1 2 3 3 3 4\n4 1 2 3 3 3 6\n5 3 2 4 4 1 2 3 4\n6 3 2 4 4 2 5 6 3\n"
               : "1 3 2 1 1 1 4 10 7\n2 3 2 2 2 5 6 12 11\n3 3 2 3 3 3 4 10 9\n4 3 2 3 3 3 6 12 9\n"
                 "5 5 2 4 4 1 2 3 4 7 8 9 10\n6 5 2 4 4 2 5 6 3 8 11 12 9\n") +
         "$EndElements\n";
}

/// A piece of it that most tests of numbers replace.
inline const std::string horizon = R"xml(name="Horizon" type="double" value="1.5")xml";

inline std::string replaced(std::string text, const std::string& piece, const std::string& by) {
  const auto at = text.find(piece);
  EXPECT_NE(at, std::string::npos) << "the valid case has no " << piece;
  return at == std::string::npos ? text : text.replace(at, piece.size(), by);
}

/// The same in three dimensions.
inline std::string valid_in_3d() {
  std::string text = valid;
  for (
      const auto& [piece, by] : std::vector<std::pair<std::string, std::string>>{
          {R"xml(<ParameterList name="Mesh">)xml",
           R"xml(<Parameter name="Dimension" type="int" value="3"/><ParameterList name="Mesh">)xml"},
          {"plate.msh", "solid.msh"},
          {R"xml(value="0.3333")xml", R"xml(value="0.25")xml"},
          {"Plane Stress", "Three-Dimensional"},
          {R"xml(<Parameter name="Center" type="Array(double)" value="{100, 10}"/>)xml",
           R"xml(<Parameter name="Shape" type="string" value="Sphere"/>)xml"
           R"xml(<Parameter name="Center" type="Array(double)" value="{100, 10, 0}"/>)xml"},
          {"{0, 0}", "{0, 0, 0}"},
          {"{5, 1}", "{5, 1, 1}"},
          {R"xml(<Parameter name="Points" type="Array(double)" value="{0, 0, 5, 0}"/>)xml",
           R"xml(<Parameter name="Shape" type="string" value="Polygon"/>)xml"
           R"xml(<Parameter name="Points" type="Array(double)" value="{0, 0, 0, 5, 0, 0, 5, 0, 2, 0, 0, 2}"/>)xml"},
          {"{0, -1}", "{0, -1, 0}"},
          {R"xml(<ParameterList name="guide">)xml",
           R"xml(<ParameterList name="stop"><Parameter name="Group" type="string" value="left"/>)xml"
           R"xml(<Parameter name="Component" type="string" value="z"/></ParameterList><ParameterList name="guide">)xml"}}) {
    text = replaced(text, piece, by);
  }
  return text;
}

/// A folder of its own for each test, with the case as plate.xml, and its mesh.
class CaseFile : public testing::Test {
 protected:
  CaseFile() {
    std::ofstream(folder_ / "plate.msh") << mesh_of(2);
    std::ofstream(folder_ / "solid.msh") << mesh_of(3);
  }

  std::string file() const { return folder_ / "plate.xml"; }

  perimorph::cases::Case read(const std::string& text, const std::vector<std::string>& overrides = {}) const {
    std::ofstream(file(), std::ios::binary) << text;
    return perimorph::cases::read_case(file(), overrides);
  }

  std::string error_of_file(const std::string& path, const std::vector<std::string>& overrides = {}) const {
    try {
      perimorph::cases::read_case(path, overrides);
    } catch (const perimorph::base::UserError& error) {
      return error.what();
    }
    return "no error";
  }

  std::string error(const std::string& text, const std::vector<std::string>& overrides = {}) const {
    std::ofstream(file(), std::ios::binary) << text;
    return error_of_file(file(), overrides);
  }

  perimorph::tests::TemporaryDirectory directory_;
  const std::filesystem::path& folder_ = directory_.path();
};
