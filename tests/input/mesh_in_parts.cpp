// What a case's mesh is checked for, where no rank has the whole of it: the same is said as where one has.

#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>

#include "case_fixture.hpp"
#include "perimorph/base/parallel.hpp"
#include "perimorph/cases/problem.hpp"
#include "perimorph/mesh/distribute.hpp"

namespace {

using namespace perimorph;

/// 24 x 12 squares of size 0.5, with groups at all sides and a row of nodes in the middle.
std::string squares() {
  constexpr int n = 24, m = 12;
  const auto node = [&](int i, int j) { return j * (n + 1) + i + 1; };
  std::string text =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n6\n1 1 \"left\"\n1 2 \"right\"\n1 3 \"top\"\n1 4 "
      "\"bottom\"\n"
      "1 5 \"middle\"\n2 6 \"body\"\n$EndPhysicalNames\n";
  text += fmt::format("$Nodes\n{}\n", (n + 1) * (m + 1));
  for (int j = 0; j <= m; ++j) {
    for (int i = 0; i <= n; ++i) text += fmt::format("{} {} {} 0\n", node(i, j), 0.5 * i, 0.5 * j);
  }
  int tag = 0;
  std::string elements;
  const auto add = [&](int type, int group, const std::vector<int>& nodes) {
    elements += fmt::format("{} {} 2 {} {} {}\n", ++tag, type, group, group, fmt::join(nodes, " "));
  };
  for (int j = 0; j < m; ++j) {
    add(1, 1, {node(0, j), node(0, j + 1)});
    add(1, 2, {node(n, j), node(n, j + 1)});
    add(1, 5, {node(n / 2, j), node(n / 2, j + 1)});
  }
  for (int i = 0; i < n; ++i) {
    add(1, 3, {node(i, m), node(i + 1, m)});
    add(1, 4, {node(i, 0), node(i + 1, 0)});
    for (int j = 0; j < m; ++j) add(3, 6, {node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
  }
  return text + fmt::format("$EndNodes\n$Elements\n{}\n", tag) + elements + "$EndElements\n";
}

/// Sound: held at the left, pulled at the right, cracked from the bottom.
const std::vector<std::string> sound = {
    "Morphing/Seeds/tip/Center={6, 2}",       "Morphing/Seeds/tip/Inner Radius=1.6",
    "Morphing/Seeds/tip/Outer Radius=2",      "Morphing/Seeds/bar/Lower Corner={5, 0}",
    "Morphing/Seeds/bar/Upper Corner={7, 2}", "Pre-Cracks/slit/Points={6.5, 0, 6.5, 2}"};

/// Cases in a folder that all ranks have in common.
class MeshInParts : public testing::Test {
 public:
  MeshInParts() : path_(base::broadcast(*comm_, own_.path().string())) {
    if (comm_->getRank() == 0) {
      std::ofstream(path_ + "/plate.msh") << squares();
      std::ofstream(path_ + "/plate.xml") << valid;
    }
    comm_->barrier();
  }
  ~MeshInParts() override { comm_->barrier(); }

 protected:
  const Teuchos::RCP<const base::Comm> comm_ = Tpetra::getDefaultComm();

  cases::Case with(const std::vector<std::string>& settings) const {
    auto all = sound;
    all.insert(all.end(), settings.begin(), settings.end());
    return cases::read_case(path_ + "/plate.xml", all);
  }
  cases::CheckedMesh<2> in_parts(const cases::Case& input) const { return cases::read_mesh<2>(*comm_, input, path_); }
  cases::CheckedMesh<2> whole(const cases::Case& input) const {
    return cases::read_whole_mesh<2>(*comm_, input, path_);
  }

 private:
  const tests::TemporaryDirectory own_;
  const std::string path_;
};

TEST_F(MeshInParts, ASoundOneIsWhatTheWholeOneComesTo) {
  const auto input = with({});
  const auto [part, warnings] = in_parts(input);
  const auto expected = mesh::distribute(*comm_, whole(input).mesh, 1.5);
  const auto found = mesh::distribute(*comm_, part, 1.5);

  EXPECT_LT(part.n_elements(), part.n_global_elements);
  EXPECT_GT(part.n_owned_elements, 0);
  EXPECT_TRUE(warnings.empty());
  EXPECT_EQ(found.coordinates, expected.coordinates);
  EXPECT_EQ(found.node_ids, expected.node_ids);
  EXPECT_EQ(found.element_ids, expected.element_ids);
  EXPECT_EQ(found.corners, expected.corners);
  EXPECT_EQ(found.node_sets, expected.node_sets);
  EXPECT_EQ(found.boundary.size(), expected.boundary.size());
  EXPECT_EQ(found.n_global_nodes, 25 * 13 + 4);
}

TEST_F(MeshInParts, MistakesAreNamedAsInTheWholeOne) {
  const std::string guide = "Boundary Conditions/Displacements/guide/",
                    hold = "Boundary Conditions/Displacements/hold/";
  for (const std::vector<std::string>& settings : std::vector<std::vector<std::string>>{
           {"Boundary Conditions/Tractions/wind/Group=tpo"},
           {guide + "Group=top", guide + "Component=x", guide + "Rate=1"},
           {guide + "Component=x"},
           {"Output/Probes/ahead/Points={6, 7}"},
           {"Output/Probes/row/Points={1, 1, 13, 1}"},
           {"Morphing/Seeds/tip/Center={60, 20}"},
           {"Pre-Cracks/slit/Points={60, 0, 60, 2}"},
           {"Pre-Cracks/slit/Points={6.5, 0, 6.5, 0.01}"},
           {"Pre-Cracks/slit/Points={6.5, 0, 6.5, 6}"},
           {"Peridynamics/Horizon=0.2"},
           {"Peridynamics/Horizon=100"},
           {"Mesh/Scale=1e40"},
           {"Boundary Conditions/Symmetry Planes/middle/Group=middle"},
       }) {
    SCOPED_TRACE(fmt::format("{}", fmt::join(settings, " ")));
    const auto message_of = [&](auto read) -> std::string {
      try {
        read(with(settings));
      } catch (const base::UserError& error) {
        return error.what();
      }
      return "";
    };
    const auto expected = message_of([&](const auto& input) { whole(input); });
    EXPECT_NE(expected, "");
    EXPECT_EQ(message_of([&](const auto& input) { in_parts(input); }), expected);
  }
}

TEST_F(MeshInParts, WhatIsHardlyMeantIsSaidAsOfTheWholeOne) {
  const auto input = with({"Boundary Conditions/Displacements/guide/Group=bottom"});
  const auto found = in_parts(input), expected = whole(input);

  EXPECT_EQ(found.warnings, expected.warnings);
  EXPECT_EQ(found.warnings.empty(), comm_->getRank() != 0);
  EXPECT_EQ(found.mesh.n_elements(), expected.mesh.n_elements());
}

}  // namespace
