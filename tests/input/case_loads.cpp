// Loads in a case file: what they become, and what the program says to mistakes in them.

#include "case_fixture.hpp"
#include "perimorph/cases/problem.hpp"

namespace {

using testing::HasSubstr;

// --- control by a measure ---

TEST_F(CaseFile, AMeasureIsRead) {
  const perimorph::cases::Case input =
      read(valid, {"Loading/Control=Measure", "Loading/Measure/Group=right", "Loading/Measure/Other Point={1, 5}",
                   "Loading/Measure/Direction={0, 2}", "Loading/Measure/Rate=0.5"});
  const auto problem = perimorph::cases::make_problem<2>(input);
  const auto& control = *problem.control;
  EXPECT_EQ(control.measured.place.group, "right");
  EXPECT_EQ(*control.measured.other->point, (perimorph::base::Point<2>(1., 5.)));
  EXPECT_EQ(control.measured.direction, (perimorph::base::Point<2>(0., 1.)));
  EXPECT_EQ(control.value.at(4.), 2.);
}

TEST_F(CaseFile, MistakesOfAMeasureAreNamed) {
  const std::string path = "Loading/Measure/", on = "Loading/Control=Measure", group = path + "Group=right",
                    direction = path + "Direction={1, 0}", rate = path + "Rate=1";
  const std::vector<std::pair<std::vector<std::string>, std::string>> mistakes = {
      {{rate}, "/Loading/Measure/Rate: found with \"Control\" = \"Load\", where it has no effect"},
      {{on, direction, rate},
       "/Loading/Measure/Group: missing; \"Control\" = \"Measure\" needs a group or a \"Point\""},
      {{on, group, rate}, "/Loading/Measure/Direction: missing"},
      {{on, group, direction}, "/Loading/Measure/Rate: missing"},
      {{on, group, direction, path + "Rate=0"}, "/Loading/Measure/Rate: found 0; allowed is any other number"},
      {{on, group, path + "Direction={0, 0}", rate},
       "/Loading/Measure/Direction: found {0, 0}; allowed is a direction"},
      {{on, group, path + "Direction={1, 0, 0}", rate}, "/Loading/Measure/Direction: found {1, 0, 0}; allowed are 2"},
      {{on, group, path + "Point={1, 1}", direction, rate}, "/Loading/Measure/Point: found beside \"Group\""},
      {{on, path + "Point={1}", direction, rate}, "/Loading/Measure/Point: found {1}; allowed are 2 numbers"},
      {{on, group, path + "Other Group=left", path + "Other Point={1, 1}", direction, rate},
       "/Loading/Measure/Other Point: found beside \"Other Group\""},
      {{on, path + "Group=rihgt", direction, rate, "Solver/Tolerence=1"},
       "/Loading/Measure/Group: the mesh plate.msh has no group of nodes called \"rihgt\""},
      {{on, path + "Point={1, 1}", path + "Other Point={500, 1}", direction, rate, "Solver/Tolerence=1"},
       "/Loading/Measure/Other Point: (500, 1) is outside the body; allowed are places in it"}};
  for (const auto& [options, text] : mistakes) EXPECT_THAT(error(valid, options), HasSubstr(text));
}

// --- pressures ---

TEST_F(CaseFile, APressureIsReadAndItsGroupChecked) {
  const std::string path = "Boundary Conditions/Pressures/gas/";
  const perimorph::cases::Case input = read(valid, {path + "Group=top", path + "Rate=2"});
  ASSERT_EQ(input.boundary_conditions.pressures.size(), 1u);
  EXPECT_EQ(input.boundary_conditions.pressures[0].group, "top");
  EXPECT_EQ(input.boundary_conditions.pressures[0].rate, 2.);
  EXPECT_TRUE(input.boundary_conditions.are_proportional());
  EXPECT_FALSE(read(valid, {path + "Group=top", path + "Constant=2"}).boundary_conditions.are_proportional());
  EXPECT_THAT(
      error(valid, {path + "Group=tpo", "Solver/Tolerence=1"}),
      HasSubstr("/Boundary Conditions/Pressures/gas/Group: the mesh plate.msh has no group of sides called \"tpo\""));
}

// --- steps of the load ---

TEST_F(CaseFile, StepsGiveConditionsTheirAmplitudes) {
  const std::string up = "Loading/Steps/up/", down = "Loading/Steps/down/";
  const perimorph::cases::Case input =
      read(valid, {"Loading/Increments=12", up + "Increments=8", up + "Conditions={pull, wind}", up + "Values={4, 1}",
                   down + "Increments=4", down + "Conditions={pull}", down + "Values={0}"});
  const auto problem = perimorph::cases::make_problem<2>(input);
  EXPECT_FALSE(problem.is_proportional);
  const auto& pull = problem.displacements[1].value;
  EXPECT_EQ(pull.at(4.), 2. * pull.rate);
  EXPECT_EQ(pull.at(10.), 2. * pull.rate);
  EXPECT_EQ(pull.at(12.), 0.);
  EXPECT_EQ(problem.displacements[0].value.amplitude, nullptr);  // it holds
}

TEST_F(CaseFile, ProportionalLoadsWithOneAmplitudeStayProportional) {
  const std::string step = "Loading/Steps/up/";
  const perimorph::cases::Case input = read(
      valid, {"Loading/Increments=8", step + "Increments=8", step + "Conditions={pull, wind}", step + "Values={4, 4}"});
  const auto problem = perimorph::cases::make_problem<2>(input);
  EXPECT_TRUE(problem.is_proportional);
  EXPECT_EQ(problem.scale_at(2.), 1.);
}

TEST_F(CaseFile, MistakesOfStepsAreNamed) {
  const std::string path = "Loading/Steps/up/", n = "Loading/Increments=8", own = path + "Increments=8",
                    both = path + "Conditions={pull, wind}", values = path + "Values={4, 1}";
  const std::vector<std::pair<std::vector<std::string>, std::string>> mistakes = {
      {{own, both, values}, "/Loading/Increments: found 100; allowed are up to 8, as many as the steps have"},
      {{n, own, both}, "/Loading/Steps/up/Values: missing"},
      {{n, own, both, path + "Values={4}"},
       "/Loading/Steps/up/Values: found 1 numbers for 2 conditions; allowed is one"},
      {{n, own, path + "Conditions={pul, wind}", values},
       "/Loading/Steps/up/Conditions: found \"pul\"; the conditions"},
      {{n, own, path + "Conditions={hold, wind}", values},
       "found \"hold\"; the conditions with a \"Rate\" are \"pull\""},
      {{n, own, path + "Conditions={pull, pull}", values}, "/Loading/Steps/up/Conditions: found \"pull\" twice"},
      {{n, own, path + "Conditions={pull}", path + "Values={4}"},
       "/Boundary Conditions/Tractions/wind/Rate: found, but no step in /Loading/Steps names this condition"},
      {{n, own, both, values, "Loading/Control=Measure"}, "/Loading/Control: found \"Measure\" beside /Loading/Steps"}};
  for (const auto& [options, text] : mistakes) EXPECT_THAT(error(valid, options), HasSubstr(text));
}

}  // namespace
