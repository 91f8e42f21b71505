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

// --- thickness ---

TEST_F(CaseFile, ARefinementFitsItsLevelsAndItsMesh) {
  const auto refinement = read(valid, {"Mesh/Refinement/Levels=2", "Mesh/Refinement/Margin=4"}).numerical.refinement;
  EXPECT_EQ(refinement.levels, 2);
  EXPECT_EQ(refinement.margin, 4.);
  EXPECT_THAT(error(valid, {"Mesh/Refinement/Levels=9"}),
              HasSubstr("/Mesh/Refinement/Levels: found 9; allowed is a whole number up to 8"));
  EXPECT_THAT(error(valid, {"Mesh/Refinement/Levels=-1"}),
              HasSubstr("/Mesh/Refinement/Levels: found \"-1\"; allowed is"));
  EXPECT_THAT(
      error(valid, {"Mesh/Refinement/Grading=4"}),
      HasSubstr("/Mesh/Refinement/Grading: found with \"Levels\" = 0, where it has no effect; allowed is it with "
                "1 or more"));
  EXPECT_THAT(error(valid, {"Mesh/Refinement/Levels=1", "Mesh/Refinement/Margin=1"}),
              HasSubstr("/Mesh/Refinement/Margin: found \"1\"; allowed is a number >= 2"));
  EXPECT_THAT(error(valid, {"Mesh/Perturbation=0.5"}),
              HasSubstr("/Mesh/Perturbation: found 0.5; allowed is 0 up to 0.4"));
}

TEST_F(CaseFile, AThicknessIsForTwoDimensions) {
  EXPECT_EQ(perimorph::cases::make_problem<2>(read(valid)).thickness, 1.);
  EXPECT_EQ(perimorph::cases::make_problem<2>(read(valid, {"Mesh/Thickness=20"})).thickness, 20.);
  EXPECT_THAT(error(valid, {"Mesh/Thickness=0"}), HasSubstr("/Mesh/Thickness: found \"0\"; allowed is a number > 0"));
  EXPECT_THAT(error(valid_in_3d(), {"Mesh/Thickness=20"}),
              HasSubstr("/Mesh/Thickness: found in three dimensions; allowed is it with \"Dimension\" = 2"));
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

// --- temperatures ---

const std::string cold = "Boundary Conditions/Temperatures/cold/", alpha_t = "Material/Thermal Expansion=1e-5";

TEST_F(CaseFile, ATemperatureAndItsProfileAreRead) {
  const perimorph::cases::Case input =
      read(valid, {cold + "Rate=-30", cold + "Direction={0, 2}", cold + "Positions={0, 4}", cold + "Factors={1, 0}",
                   alpha_t, "Loading/Increments=6", "Loading/Steps/up/Increments=6",
                   "Loading/Steps/up/Conditions={pull, wind, cold}", "Loading/Steps/up/Values={1, 1, 3}"});
  const auto problem = perimorph::cases::make_problem<2>(input);
  ASSERT_EQ(problem.temperature_changes.size(), 1u);
  const auto& change = problem.temperature_changes[0];
  EXPECT_EQ(change.value.at(6.), -90.);
  EXPECT_TRUE(change.blocks.empty());
  EXPECT_EQ(change.profile->direction, perimorph::base::Point<2>(0., 1.));
  EXPECT_EQ(change.profile->factor.at(3.), 0.25);
  EXPECT_EQ(problem.materials[0].thermal_expansion, 1e-5);
  EXPECT_FALSE(problem.is_proportional);
}

TEST_F(CaseFile, ATemperatureIsProportionalWithoutAConstant) {
  EXPECT_TRUE(perimorph::cases::make_problem<2>(read(valid, {cold + "Rate=-30", alpha_t})).is_proportional);
  EXPECT_FALSE(perimorph::cases::make_problem<2>(read(valid, {cold + "Constant=-30", alpha_t})).is_proportional);
}

TEST_F(CaseFile, InPlaneStrainABodyExpandsMoreInThePlane) {
  const perimorph::cases::Case input =
      read(valid, {cold + "Rate=-30", alpha_t, "Material/Elastic Model=Plane Strain", "Material/Poisson's Ratio=0.3"});
  EXPECT_DOUBLE_EQ(perimorph::cases::make_problem<2>(input).materials[0].thermal_expansion, 1.3e-5);
}

TEST_F(CaseFile, MistakesOfTemperaturesAreNamed) {
  const std::string rate = cold + "Rate=-30", direction = cold + "Direction={0, 1}",
                    positions = cold + "Positions={0, 4}", factors = cold + "Factors={1, 0}",
                    at = "/Boundary Conditions/Temperatures/cold/";
  const std::vector<std::pair<std::vector<std::string>, std::string>> mistakes = {
      {{rate}, "/Material/Thermal Expansion: found 0 in all materials in which /Boundary Conditions/Temperatures/cold"},
      {{rate, alpha_t, direction}, at + "Positions: missing; a profile needs"},
      {{rate, alpha_t, positions, factors}, at + "Direction: missing; a profile needs"},
      {{rate, alpha_t, cold + "Direction={0, 1, 0}", positions, factors}, at + "Direction: found"},
      {{rate, alpha_t, cold + "Direction={0, 0}", positions, factors},
       at + "Direction: found {0, 0}; allowed is a direction, which has a length"},
      {{rate, alpha_t, direction, cold + "Positions={4, 4}", factors},
       at + "Positions: found {4, 4}; allowed are two or more, each greater than the one before"},
      {{rate, alpha_t, direction, positions, cold + "Factors={1}"},
       at + "Factors: found 1 for 2 of \"Positions\"; allowed is one for each"},
      {{rate, alpha_t, cold + "Blocks={}"}, at + "Blocks: found none; allowed are the names of one block or more"},
      {{rate, alpha_t, cold + "Blocks={bdoy}", "Solver/Tolerence=1"},
       at + "Blocks: the mesh plate.msh has no group of elements called \"bdoy\""},
      {{rate, alpha_t, "Loading/Increments=8", "Loading/Steps/up/Increments=8",
        "Loading/Steps/up/Conditions={pull, wind}", "Loading/Steps/up/Values={4, 1}"},
       at + "Rate: found, but no step in /Loading/Steps names this condition"}};
  for (const auto& [options, text] : mistakes) EXPECT_THAT(error(valid, options), HasSubstr(text)) << text;
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
      {{n, own, both}, "/Loading/Steps/up/Values: missing; needed is one number for each"},
      {{n, own}, "/Loading/Steps/up/Conditions: missing; needed is a list of conditions such as {press}, one in"},
      {{n, own, values}, "/Loading/Steps/up/Values: found without \"Conditions\""},
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

TEST_F(CaseFile, AStepReleasesConditions) {
  const std::string up = "Loading/Steps/up/", free = "Loading/Steps/free/";
  const perimorph::cases::Case input =
      read(valid, {"Loading/Increments=6", up + "Increments=4", up + "Conditions={pull, wind}", up + "Values={4, 4}",
                   free + "Increments=2", free + "Released={wind, pull}"});
  const auto problem = perimorph::cases::make_problem<2>(input);
  EXPECT_FALSE(problem.is_proportional);
  const auto& pull = problem.displacements[1].value;
  EXPECT_EQ(pull.at(4.), 4. * pull.rate);
  EXPECT_EQ(pull.end, 4.);
  EXPECT_GT(problem.displacements[0].value.end, 1e300);
}

TEST_F(CaseFile, MistakesOfWhatAStepReleasesAreNamed) {
  const std::string up = "Loading/Steps/up/", free = "Loading/Steps/free/", last = "Loading/Steps/last/";
  const std::vector<std::string> steps = {"Loading/Increments=5", up + "Increments=4",   up + "Conditions={pull, wind}",
                                          up + "Values={4, 4}",   free + "Increments=1", free + "Released={pull}"};
  const std::vector<std::pair<std::vector<std::string>, std::string>> mistakes = {
      {{up + "Released={hold}"}, "/Loading/Steps/up/Released: found in the first step; allowed is it in later ones"},
      {{free + "Released={pul}"},
       "/Loading/Steps/free/Released: found \"pul\"; the conditions that hold or load the body"
       " are \"guide\", \"hold\", \"pull\", \"wind\" - did you mean \"pull\"?"},
      {{free + "Released={Body Force}"}, "/Loading/Steps/free/Released: found \"Body Force\"; the conditions that"},
      {{free + "Released={pull, pull}"},
       "/Loading/Steps/free/Released: found \"pull\" again; /Loading/Steps/free has released it"},
      {{free + "Conditions={pull}", free + "Values={2}"},
       "/Loading/Steps/free/Conditions: found \"pull\", which /Loading/Steps/free has released for good"},
      {{last + "Increments=1", last + "Released={pull}"},
       "/Loading/Steps/last/Released: found \"pull\" again; /Loading/Steps/free has released it"}};
  for (const auto& [options, text] : mistakes) {
    auto all = steps;
    all.insert(all.end(), options.begin(), options.end());
    EXPECT_THAT(error(valid, all), HasSubstr(text));
  }
}

TEST_F(CaseFile, AStepStartsConditions) {
  const std::string up = "Loading/Steps/up/", grip = "Loading/Steps/grip/";
  const perimorph::cases::Case input =
      read(valid, {"Loading/Increments=6", up + "Increments=4", up + "Conditions={wind}", up + "Values={4}",
                   grip + "Increments=2", grip + "Started={pull}", grip + "Conditions={pull}", grip + "Values={1}"});
  const auto problem = perimorph::cases::make_problem<2>(input);
  EXPECT_FALSE(problem.is_proportional);
  const auto& pull = problem.displacements[1].value;
  EXPECT_EQ(pull.begin, 4.);
  EXPECT_EQ(pull.at(4.), 0.);
  EXPECT_EQ(pull.at(6.), pull.rate);
  EXPECT_LT(problem.displacements[0].value.begin, -1e300);
}

TEST_F(CaseFile, MistakesOfWhatAStepStartsAreNamed) {
  const std::string up = "Loading/Steps/up/", grip = "Loading/Steps/grip/", last = "Loading/Steps/last/";
  const std::vector<std::string> steps = {"Loading/Increments=5", up + "Increments=4",   up + "Conditions={wind}",
                                          up + "Values={4}",      grip + "Increments=1", grip + "Conditions={pull}",
                                          grip + "Values={1}"};
  const std::vector<std::pair<std::vector<std::string>, std::string>> mistakes = {
      {{up + "Started={hold}"}, "/Loading/Steps/up/Started: found in the first step; allowed is it in later ones"},
      {{grip + "Started={wind}"},
       "/Loading/Steps/grip/Started: found \"wind\"; the conditions that hold the body or have"},
      {{grip + "Started={pull, pull}"}, "/Loading/Steps/grip/Started: found \"pull\" again; allowed is each once"},
      {{last + "Increments=1", last + "Started={pull}"},
       "/Loading/Steps/grip/Conditions: found \"pull\", which a later step starts"},
      {{grip + "Started={pull}", "Boundary Conditions/Rigid Groups/grip/Group=right"},
       "/Loading/Steps/grip/Started: found \"pull\", which moves the rigid group \"right\""}};
  for (const auto& [options, text] : mistakes) {
    auto all = steps;
    all.insert(all.end(), options.begin(), options.end());
    EXPECT_THAT(error(valid, all), HasSubstr(text));
  }
}

TEST_F(CaseFile, IncrementsAreCutOnlyWhereSomethingBreaks) {
  const std::string option = "Loading/Largest Break per Increment=40";
  EXPECT_EQ(*read(valid, {option}).loading.largest_break, 40);
  EXPECT_FALSE(read(valid).loading.largest_break.has_value());
  EXPECT_THAT(
      error(replaced(valid, R"xml(<Parameter name="Critical Stretch" type="double" value="0.05"/>)xml", ""), {option}),
      HasSubstr("/Loading/Largest Break per Increment: found, but nothing breaks; allowed is it with"));
}

// --- cycles, and tables from files ---

TEST_F(CaseFile, CyclesLeadToTheValuesAndBack) {
  const std::string hold = "Loading/Steps/hold/", shake = "Loading/Steps/shake/", end = "Loading/Steps/unload/";
  const perimorph::cases::Case input =
      read(valid, {"Loading/Increments=27", hold + "Increments=2", hold + "Conditions={pull, wind}",
                   hold + "Values={1, 3}", shake + "Increments=6", shake + "Cycles=4", shake + "Conditions={pull}",
                   shake + "Values={4}", end + "Increments=1", end + "Conditions={pull}", end + "Values={0}"});
  const auto problem = perimorph::cases::make_problem<2>(input);
  const auto& pull = *problem.displacements[1].value.amplitude;
  for (const double begin : {2., 8., 14., 20.}) {
    EXPECT_EQ(pull.at(begin), 1.);
    EXPECT_EQ(pull.at(begin + 2.), 3.);
    EXPECT_EQ(pull.at(begin + 3.), 4.);
    EXPECT_EQ(pull.at(begin + 5.), 2.);
  }
  EXPECT_EQ(pull.at(26.), 1.);
  EXPECT_EQ(pull.at(27.), 0.);
  EXPECT_THAT(error(valid, {"Loading/Increments=28", shake + "Increments=6", shake + "Cycles=4",
                            shake + "Conditions={pull, wind}", shake + "Values={4, 1}"}),
              HasSubstr("/Loading/Increments: found 28; allowed are up to 24"));
}

class TableOfACase : public CaseFile {
 protected:
  void write(const std::string& text) const { std::ofstream(folder_ / "pull.csv") << text; }

  const std::string pull_ = "Loading/Steps/pull/", table_ = pull_ + "Tables/pull/File=pull.csv";
  const std::vector<std::string> step_ = {"Loading/Increments=20", pull_ + "Increments=10", pull_ + "Cycles=2", table_,
                                          "Boundary Conditions/Tractions/wind/Rate={0, 0}"};
};

TEST_F(TableOfACase, ItsTimesAreSpreadOverTheIncrementsOfEachCycle) {
  write("t, a\n100, 0\n150, 2\n180, -1\n200, 0\n");
  const perimorph::cases::Case input = read(valid, step_);
  const auto problem = perimorph::cases::make_problem<2>(input);
  const auto& pull = *problem.displacements[1].value.amplitude;
  for (const double begin : {0., 10.}) {
    EXPECT_DOUBLE_EQ(pull.at(begin + 2.5), 1.);
    EXPECT_DOUBLE_EQ(pull.at(begin + 5.), 2.);
    EXPECT_DOUBLE_EQ(pull.at(begin + 8.), -1.);
    EXPECT_DOUBLE_EQ(pull.at(begin + 10.), 0.);
  }
}

TEST_F(TableOfACase, ItsRowsDecideWhatIsComputedAndItsNameDoesNot) {
  const auto lines = [&](const std::string& text, const std::string& name) {
    std::ofstream(folder_ / name) << text;
    auto step = step_;
    step[3] = pull_ + "Tables/pull/File=" + name;
    return perimorph::cases::deciding_lines(read(valid, step));
  };
  const std::string one = lines("0,0\n1,2\n2,0\n", "pull.csv");
  EXPECT_EQ(one, lines("# the same\n0, 0\n1, 2.0\n2, 0\n", "other.csv"));
  EXPECT_NE(one, lines("0,0\n1,3\n2,0\n", "pull.csv"));
  EXPECT_THAT(one, HasSubstr("/Loading/Steps/pull/Tables/pull: row 2 = 1, 2\n"));
}

TEST_F(TableOfACase, MistakesNameItsLineAndThatOfTheCase) {
  const std::string at = "/Loading/Steps/pull/Tables/pull/File: " + (folder_ / "pull.csv").string();
  const auto says = [&](const std::string& text, const std::string& message) {
    write(text);
    EXPECT_THAT(error(valid, step_), HasSubstr(at + message));
  };
  says("0,0\n", ": found 1 row of a time and a value; allowed are at least 2");
  says("t,a\n", ": found no row of a time and a value");
  says("0,0\n2,1\n1,0\n", ":3: found the time 1 after 2; allowed are times that rise");
  says("0,0\n1,1\n1,0\n", ":3: found the time 1 after 1; allowed are times that rise");
  says("-1e308,0\n1e308,1\n", ":2: found the time 1e+308 after -1e+308; allowed are times that rise");
  says("0,0\n1,one\n", ":2: found \"1,one\"; allowed are 2 numbers");
  says("0,0.5\n1,0.5\n", ":1: found the value 0.5; allowed is 0, which the condition has at the beginning");
  says("0,0\n1,2\n", ":2: found the value 2; allowed is 0, with which the next cycle begins");
  std::filesystem::remove(folder_ / "pull.csv");
  EXPECT_THAT(error(valid, step_), HasSubstr(at + ": there is no such file; a table (.csv) is needed"));
}

TEST_F(TableOfACase, MistakesOfCyclesAreNamed) {
  write("0,0\n1,1\n2,0\n");
  auto many = step_, odd = step_, twice = step_, unknown = step_;
  many[2] = pull_ + "Cycles=1000000";
  EXPECT_THAT(error(valid, many), HasSubstr("/Loading/Steps/pull/Cycles: found 1000000; allowed are up to 333333"));
  odd[1] = pull_ + "Increments=5";
  EXPECT_THAT(error(valid, odd), HasSubstr("/Loading/Increments: found 20; allowed are up to 10"));
  odd[0] = "Loading/Increments=10";
  odd[3] = pull_ + "Conditions={pull}";
  odd.push_back(pull_ + "Values={1}");
  EXPECT_THAT(error(valid, odd),
              HasSubstr("/Loading/Steps/pull/Increments: found 5 with \"Cycles\"; allowed are even"));
  twice.insert(twice.end(), {pull_ + "Conditions={pull}", pull_ + "Values={1}"});
  EXPECT_THAT(error(valid, twice), HasSubstr("/Loading/Steps/pull/Tables/pull: found \"pull\" twice"));
  unknown[3] = pull_ + "Tables/pul/File=pull.csv";
  EXPECT_THAT(error(valid, unknown),
              HasSubstr("/Loading/Steps/pull/Tables/pul: found \"pul\"; the conditions with a \"Rate\" are"));
}

}  // namespace
