// The columns of history.csv: each has its own name, and the value that its name says.

#include <gmock/gmock.h>

#include <map>

#include "perimorph/output/increment_record.hpp"

namespace perimorph::tests {
namespace {

using output::IncrementRecord;

IncrementRecord example() {
  IncrementRecord record;
  record.increment = 7;
  record.load_factor = 7.5;
  record.counts.broken_bonds = 1;
  record.counts.damaged_elements = 2;
  record.counts.dgfe_elements = 3;
  record.counts.unknowns = 4;
  record.counts.linear_solves = 5;
  record.counts.cg_iterations = 6;
  record.energies = {10., 20., 35.};
  record.seconds = 8.;
  record.overlap = 9.;
  record.reactions = output::reactions_of<2>({"top", "left"}, {});
  for (std::size_t i = 0; i < record.reactions.size(); ++i) {
    record.reactions[i].force = 100. + static_cast<double>(i);
    record.reactions[i].displacement = 200. + static_cast<double>(i);
  }
  return record;
}

TEST(HistoryColumns, HaveTheValuesThatTheirNamesSay) {
  const auto record = example();
  std::map<std::string, double> values;
  const auto columns = output::history_columns(record.reactions);
  for (const auto& column : columns) values[column.name] = column.value(record);

  EXPECT_EQ(values.size(), columns.size()) << "two columns have one name";
  const std::map<std::string, double> expected = {
      {"load_factor", 7.5},
      {"broken_bonds", 1.},
      {"damaged_elements", 2.},
      {"dgfe_elements", 3.},
      {"unknowns", 4.},
      {"linear_solves", 5.},
      {"cg_iterations", 6.},
      {"wall_seconds", 8.},
      {"elastic_energy", 10.},
      {"dissipated_energy", 20.},
      {"external_work", 35.},
      {"jump_loss", 5.},
      {"overlap", 9.},
      {"reaction_top_x", 100.},
      {"reaction_top_y", 101.},
      {"reaction_left_x", 102.},
      {"reaction_left_y", 103.},
      {"displacement_top_x", 200.},
      {"displacement_top_y", 201.},
      {"displacement_left_x", 202.},
      {"displacement_left_y", 203.},
  };
  EXPECT_EQ(values, expected);
}

TEST(HistoryColumns, AreInTheOrderThatToolsAndEarlierRunsKnow) {
  std::vector<std::string> names;
  for (const auto& column : output::history_columns({})) names.push_back(column.name);
  EXPECT_THAT(names,
              testing::ElementsAre("load_factor", "broken_bonds", "damaged_elements", "dgfe_elements", "unknowns",
                                   "linear_solves", "cg_iterations", "wall_seconds", "elastic_energy",
                                   "dissipated_energy", "external_work", "jump_loss", "overlap"));
}

}  // namespace
}  // namespace perimorph::tests
