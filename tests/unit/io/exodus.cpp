#include "perimorph/io/exodus.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>

#include "exodus_file.hpp"
#include "limited_file_size.hpp"
#include "perimorph/base/errors.hpp"
#include "support/temporary_directory.hpp"

namespace perimorph {
namespace {

using io::ExodusModel;
using io::ExodusSeries;
using io::ExodusStep;
using mesh::ElementType;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

/// Class of each element of a plate of unit squares: FE far from the middle row, MORPH beside it, and in the middle row
/// DGFE for the first n_discontinuous columns and MORPH for the others.
struct Plate {
  int columns, rows, n_discontinuous;
  int distance_to_middle(int row) const { return std::abs(row - rows / 2); }
  std::string class_of(int column, int row) const {
    const int distance = distance_to_middle(row);
    if (distance == 0 && column < n_discontinuous) return "plate_DGFE";
    return distance <= 1 && n_discontinuous > 0 ? "plate_MORPH" : "plate_FE";
  }
};

/// The plate's file: continuous elements share the grid's nodes, discontinuous ones have four of their own.
ExodusModel<2> model_of(const Plate& plate) {
  ExodusModel<2> model;
  for (int j = 0; j <= plate.rows; ++j) {
    for (int i = 0; i <= plate.columns; ++i) model.coordinates.emplace_back(i, j);
  }
  const auto node = [&](int i, int j) { return j * (plate.columns + 1) + i; };
  for (const std::string name : {"plate_FE", "plate_MORPH", "plate_DGFE"}) {
    ExodusModel<2>::Block block{name, ElementType::quad4, {}, {}};
    for (int row = 0; row < plate.rows; ++row) {
      for (int column = 0; column < plate.columns; ++column) {
        if (plate.class_of(column, row) != name) continue;
        for (const int corner :
             {node(column, row), node(column + 1, row), node(column + 1, row + 1), node(column, row + 1)}) {
          const bool own = name == "plate_DGFE";
          block.connectivity.push_back(own ? static_cast<int>(model.coordinates.size()) : corner);
          const base::Point<2> position = model.coordinates[corner];
          if (own) model.coordinates.push_back(position);
        }
        block.element_ids.push_back(row * plate.columns + column);
      }
    }
    if (!block.element_ids.empty()) model.blocks.push_back(block);
  }
  for (int i = 0; i <= plate.columns; ++i) model.node_sets["top"].push_back(node(i, plate.rows));
  model.node_sets["nowhere"] = {};
  model.side_sets["bottom"] = {{0, 0}, {1, 0}};
  return model;
}

const ExodusSeries<2>::Names plate_names = {
    {"load_factor"}, {"displacement_x", "displacement_y"}, {"alpha", "damage", "stress_xx", "stress_yy", "stress_xy"}};

/// The upper half opens by `opening` around the left end; damage falls with the distance from the middle row.
ExodusStep step_of(const Plate& plate, const ExodusModel<2>& model, double time, double opening) {
  ExodusStep step{time, {0.1 * time}, {{}, {}}, std::vector<std::vector<double>>(5)};
  for (const auto& x : model.coordinates) {
    const double upper = x[1] > 0.5 * plate.rows ? 1. : 0.;
    step.nodal[0].push_back(0.);
    step.nodal[1].push_back(opening * upper * (plate.columns - x[0]) / plate.columns);
  }
  for (const auto& block : model.blocks) {
    for (const auto id : block.element_ids) {
      const int distance = plate.distance_to_middle(static_cast<int>(id) / plate.columns);
      step.element[0].push_back(block.name == "plate_FE" ? 0. : 1.);
      step.element[1].push_back(block.name == "plate_DGFE" ? 0.5 : 0.25 * std::exp(-distance));
      for (int s = 2; s < 5; ++s) step.element[s].push_back(static_cast<double>(s * id));
    }
  }
  return step;
}

TEST(ExodusSeries, AnyChangeOfTopologyMakesAFileThatReadsBackAsItWasWritten) {
  const tests::TemporaryDirectory directory;
  const std::string first = directory.file("case.e");
  const std::vector<Plate> plates = {{12, 7, 0}, {12, 7, 4}, {12, 7, 9}};
  {
    ExodusSeries<2> series(first, "A plate", plate_names, {});
    double time = 0.;
    for (const auto& plate : plates) {
      const ExodusModel<2> model = model_of(plate);
      series.start(model);
      for (int repeat = 0; repeat < 2; ++repeat, time += 1.) {
        series.write(step_of(plate, model, time, 0.2 * plate.n_discontinuous));
      }
    }
  }

  double time = 0.;
  for (std::size_t k = 0; k < plates.size(); ++k, time += 2.) {
    const tests::ExodusFile file(k == 0 ? first : first + "-s000" + std::to_string(k + 1));
    const ExodusModel<2> model = model_of(plates[k]);
    const int n_nodes = static_cast<int>(model.coordinates.size());
    EXPECT_STREQ(file.sizes.title, "A plate");
    EXPECT_EQ(file.sizes.num_dim, 2);
    ASSERT_EQ(file.sizes.num_nodes, n_nodes);
    ASSERT_EQ(file.sizes.num_elem, 12 * 7);
    ASSERT_EQ(file.sizes.num_elem_blk, k == 0 ? 1 : 3);
    const auto coordinates = file.coordinates();
    for (int n = 0; n < n_nodes; ++n) {
      ASSERT_EQ(base::Point<2>(coordinates[0][n], coordinates[1][n]), model.coordinates[n]) << n;
    }

    const auto steps = {step_of(plates[k], model, time, 0.2 * plates[k].n_discontinuous),
                        step_of(plates[k], model, time + 1., 0.2 * plates[k].n_discontinuous)};
    ASSERT_THAT(file.times(), ElementsAre(time, time + 1.));
    EXPECT_THAT(file.truth_table(), ::testing::Each(1));
    int number = 0;
    for (const auto& step : steps) {
      ++number;
      EXPECT_EQ(file.values(number, EX_GLOBAL, 1, 0, 1), step.globals);
      for (int v = 0; v < 2; ++v) EXPECT_EQ(file.values(number, EX_NODAL, v + 1, 1, n_nodes), step.nodal[v]);
      for (int v = 0; v < 5; ++v) {
        std::vector<double> all;
        for (std::size_t b = 0; b < model.blocks.size(); ++b) {
          const int n = static_cast<int>(model.blocks[b].element_ids.size());
          const auto part = file.values(number, EX_ELEM_BLOCK, v + 1, static_cast<int>(b) + 1, n);
          all.insert(all.end(), part.begin(), part.end());
        }
        EXPECT_EQ(all, step.element[v]);
      }
    }
  }
}

TEST(ExodusSeries, NamesIdsAndSetsReadBackOneBased) {
  const tests::TemporaryDirectory directory;
  const std::string first = directory.file("case.e");
  const ExodusModel<2> model = model_of({2, 3, 1});
  ExodusSeries<2>(first, "", plate_names, {}).start(model);

  const tests::ExodusFile file(first);
  EXPECT_THAT(file.names(EX_ELEM_BLOCK), ElementsAre("plate_MORPH", "plate_DGFE"));
  EXPECT_THAT(file.names(EX_NODE_SET), ElementsAre("nowhere", "top"));
  EXPECT_THAT(file.names(EX_SIDE_SET), ElementsAre("bottom"));
  EXPECT_EQ(file.variables(EX_GLOBAL), plate_names.globals);
  EXPECT_EQ(file.variables(EX_NODAL), plate_names.nodal);
  EXPECT_EQ(file.variables(EX_ELEM_BLOCK), plate_names.element);
  EXPECT_EQ(file.topology(1), "QUAD4");
  EXPECT_THAT(file.connectivity(2), ElementsAre(13, 14, 15, 16));  // 12 nodes of the grid, then its own four
  EXPECT_THAT(file.element_ids(), ElementsAre(1, 2, 4, 5, 6, 3));
  EXPECT_THAT(file.set(EX_NODE_SET, 1).first, IsEmpty());
  EXPECT_THAT(file.set(EX_NODE_SET, 2).first, ElementsAre(10, 11, 12));
  EXPECT_THAT(file.set(EX_SIDE_SET, 1).first, ElementsAre(1, 2));
  EXPECT_THAT(file.set(EX_SIDE_SET, 1).second, ElementsAre(1, 1));
}

TEST(ExodusSeries, BlocksHaveTheIdsGivenAndTheirValuesGoWithThem) {
  const tests::TemporaryDirectory directory;
  const std::string first = directory.file("case.e");
  const Plate plate{2, 3, 1};
  ExodusModel<2> model = model_of(plate);
  model.blocks[0].id = 12;
  model.blocks[1].id = 14;
  {
    ExodusSeries<2> series(first, "", plate_names, {});
    series.start(model);
    series.write(step_of(plate, model, 1., 0.));
  }

  const tests::ExodusFile file(first);
  EXPECT_EQ(file.topology(14), "QUAD4");
  EXPECT_THAT(file.connectivity(14), ElementsAre(13, 14, 15, 16));
  EXPECT_THAT(file.values(1, EX_ELEM_BLOCK, 2, 14, 1), ElementsAre(0.5));
}

TEST(ExodusSeries, AThreeDimensionalModelReadsBack) {
  const tests::TemporaryDirectory directory;
  const std::string first = directory.file("cube.e");
  ExodusModel<3> model;
  for (int k = 0; k <= 2; ++k) {
    for (const auto& [x, y] : {std::pair{0., 0.}, {1., 0.}, {1., 1.}, {0., 1.}})
      model.coordinates.emplace_back(x, y, k);
  }
  model.blocks = {{"bar_FE", ElementType::hex8, {0, 1, 2, 3, 4, 5, 6, 7}, {1}},
                  {"bar_MORPH", ElementType::hex8, {4, 5, 6, 7, 8, 9, 10, 11}, {0}}};
  model.side_sets["top"] = {{1, 5}};
  {
    ExodusSeries<3> series(first, "A bar", {{}, {"displacement_z"}, {"damage"}}, {});
    series.start(model);
    series.write({0.5, {}, {{0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2}}, {{0.25, 0.75}}});
  }

  const tests::ExodusFile file(first);
  EXPECT_EQ(file.sizes.num_dim, 3);
  EXPECT_THAT(file.coordinates()[2], ElementsAre(0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2));
  EXPECT_EQ(file.topology(2), "HEX8");
  EXPECT_THAT(file.connectivity(2), ElementsAre(5, 6, 7, 8, 9, 10, 11, 12));
  EXPECT_THAT(file.element_ids(), ElementsAre(2, 1));
  EXPECT_THAT(file.set(EX_SIDE_SET, 1).first, ElementsAre(2));
  EXPECT_THAT(file.set(EX_SIDE_SET, 1).second, ElementsAre(6));
  EXPECT_THAT(file.values(1, EX_NODAL, 1, 1, 12), ElementsAre(0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2));
  EXPECT_THAT(file.values(1, EX_ELEM_BLOCK, 1, 2, 1), ElementsAre(0.75));
}

TEST(ExodusSeries, NamesThatDifferAtTheirEndOnlyAreKeptApart) {
  const tests::TemporaryDirectory directory;
  const std::string first = directory.file("case.e"), name(200, 'n');
  ExodusModel<2> model = model_of({2, 3, 0});
  model.blocks[0].name = name + "_PD";
  model.node_sets[name + "1"] = {0};
  model.node_sets[name + "2"] = {1};
  ExodusSeries<2>(first, "", {{"reaction_" + name + "_x", "reaction_" + name + "_y"}, {}, {}}, {}).start(model);

  const tests::ExodusFile file(first);
  EXPECT_THAT(file.names(EX_ELEM_BLOCK), ElementsAre(name + "_PD"));
  EXPECT_THAT(file.names(EX_NODE_SET), testing::IsSupersetOf({name + "1", name + "2"}));
  EXPECT_THAT(file.variables(EX_GLOBAL), ElementsAre("reaction_" + name + "_x", "reaction_" + name + "_y"));
}

TEST(ExodusSeries, LongNamesAreKeptUpToTheirLimit) {
  const tests::TemporaryDirectory directory;
  const std::string first = directory.file("case.e"), name(64, 'n');
  ExodusModel<2> model = model_of({2, 3, 0});
  model.blocks[0].name = name;
  ExodusSeries<2>(first, "", {{name}, {}, {}}, {}).start(model);

  const tests::ExodusFile file(first);
  EXPECT_THAT(file.names(EX_ELEM_BLOCK), ElementsAre(name));
  EXPECT_THAT(file.variables(EX_GLOBAL), ElementsAre(name));
}

TEST(ExodusSeries, TheCaseIsInTheInfoRecordsWithLongLinesSplitBetweenCharacters) {
  const tests::TemporaryDirectory directory;
  const std::string first = directory.file("case.e");
  const std::string a78(78, 'a'), b79(79, 'b');
  ExodusSeries<2>(first, std::string(100, 't'), plate_names, {"short", "", a78 + "δ", b79 + b79})
      .start(model_of({2, 3, 0}));

  const tests::ExodusFile file(first);
  EXPECT_THAT(file.information(), ElementsAre("short", "", a78, "δ", b79, b79));
  EXPECT_EQ(file.program(), "perimorph");
  EXPECT_EQ(file.sizes.title, std::string(80, 't'));
}

TEST(ExodusSeries, EveryStepIsReadableBeforeTheFileIsClosed) {
  const tests::TemporaryDirectory directory;
  const std::string first = directory.file("case.e");
  const Plate plate{2, 3, 1};
  const ExodusModel<2> model = model_of(plate);
  ExodusSeries<2> series(first, "", plate_names, {});
  series.start(model);
  for (const double time : {1., 2.}) {
    const ExodusStep step = step_of(plate, model, time, time);
    series.write(step);
    std::filesystem::copy_file(first, directory.file("copy.e"), std::filesystem::copy_options::overwrite_existing);
    const tests::ExodusFile copy(directory.file("copy.e"));
    EXPECT_EQ(copy.times().back(), time);
    const int n_nodes = static_cast<int>(model.coordinates.size());
    EXPECT_EQ(copy.values(static_cast<int>(time), EX_NODAL, 2, 1, n_nodes), step.nodal[1]);
  }
}

TEST(ExodusSeries, FilesOfAnEarlierRunAreRemovedSpreadOnesToo) {
  const tests::TemporaryDirectory directory;
  const std::string first = directory.file("case.e");
  const std::vector<std::string> foreign = {"other.e-s0002", "case.e.txt", "case.e.2", "case.e.2.0.bak"};
  const std::vector<std::string> old = {"case.e", "case.e.2.0", "case.e.2.1", "case.e-s0002.12.07", "case.e-s0003"};
  for (const auto& name : foreign) std::ofstream(directory.file(name)) << "old";
  for (const auto& name : old) std::ofstream(directory.file(name)) << "old";
  ExodusSeries<2>(first, "", plate_names, {}).remove_the_rest();
  for (const auto& name : old) EXPECT_FALSE(std::filesystem::exists(directory.file(name))) << name;
  for (const auto& name : foreign) EXPECT_TRUE(std::filesystem::exists(directory.file(name))) << name;
}

TEST(ExodusSeries, APartIsNamedByRankAndHasTheNodesNumbersAndEmptyBlocks) {
  const tests::TemporaryDirectory directory;
  const Plate plate{2, 3, 0};
  auto model = model_of(plate);
  for (std::size_t n = 0; n < model.coordinates.size(); ++n) model.node_ids.push_back(100 + static_cast<long long>(n));
  model.blocks.push_back({"plate_PD", mesh::ElementType::quad4, {}, {}, 13});
  ExodusSeries<2> part(directory.file("case.e"), "", plate_names, {}, io::SpreadPart{7, 12});
  part.start(model);
  part.write(step_of(plate, model, 1., 0.1));

  tests::ExodusFile copy(directory.file("case.e.12.07"));
  EXPECT_EQ(copy.node_ids().front(), 101);
  EXPECT_EQ(copy.names(EX_ELEM_BLOCK).back(), "plate_PD");
}

template <class Work>
std::string message_of(Work work) {
  try {
    work();
  } catch (const base::ComputationError& error) {
    return error.what();
  }
  return "no ComputationError";
}

TEST(ExodusSeries, AnUnwritablePathIsAnErrorThatNamesTheFile) {
  const tests::TemporaryDirectory directory;
  const std::string first = directory.file("absent/case.e");
  ExodusSeries<2> series(first, "", plate_names, {});
  const std::string message = message_of([&] { series.start(model_of({2, 3, 0})); });
  EXPECT_EQ(message, first + ": the file cannot be written: No such file or directory");
}

TEST(ExodusSeries, ADiskThatFillsUpStopsTheComputationAndKeepsTheStepsWritten) {
  const tests::TemporaryDirectory directory;
  const std::string first = directory.file("case.e");
  const Plate plate{60, 61, 0};
  const ExodusModel<2> model = model_of(plate);
  std::string message;
  {
    ExodusSeries<2> series(first, "", plate_names, {});
    series.start(model);
    series.write(step_of(plate, model, 1., 0.));
    const tests::LimitedFileSize limit(std::filesystem::file_size(first) + 1000);
    message = message_of([&] { series.write(step_of(plate, model, 2., 0.)); });
  }
  EXPECT_THAT(message, AllOf(StartsWith(first + ": the "), HasSubstr(" cannot be written: File too large")));
  EXPECT_EQ(tests::ExodusFile(first).times().front(), 1.);
}

TEST(ExodusSeries, ADiskThatIsFullAtANewTopologyStopsTheComputation) {
  const tests::TemporaryDirectory directory;
  const std::string first = directory.file("case.e");
  ExodusSeries<2> series(first, "", plate_names, {});
  const tests::LimitedFileSize limit(1000);
  const std::string message = message_of([&] { series.start(model_of({60, 61, 0})); });
  EXPECT_THAT(message, AllOf(StartsWith(first + ": the "), HasSubstr(" cannot be written: ")));
}

TEST(ExodusSeries, AStepOfTheWrongSizeOrWithoutAModelIsABug) {
  const tests::TemporaryDirectory directory;
  const Plate plate{2, 3, 0};
  const ExodusModel<2> model = model_of(plate);
  ExodusStep step = step_of(plate, model, 1., 0.);
  ExodusSeries<2> series(directory.file("case.e"), "", plate_names, {});
  EXPECT_THROW(series.write(step), base::Bug);
  series.start(model);
  step.element[1].pop_back();
  EXPECT_THROW(series.write(step), base::Bug);
}

}  // namespace
}  // namespace perimorph
