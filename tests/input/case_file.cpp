// What a sound case file and overrides become, and the reference of all parameters.

#include <Teuchos_XMLParameterListHelpers.hpp>

#include "case_fixture.hpp"
#include "perimorph/cases/reference.hpp"

namespace {

using perimorph::cases::Case;
using perimorph::cases::read_case;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

// --- a valid case ---

TEST_F(CaseFile, ValuesArriveInTheCase) {
  const Case result = read(valid);

  EXPECT_EQ(result.name, "plate");
  EXPECT_EQ(result.directory, folder_.string());
  EXPECT_EQ(result.mesh.file, (folder_ / "plate.msh").string());
  EXPECT_EQ(result.material.elastic_model, perimorph::materials::ElasticModel::plane_stress);
  EXPECT_EQ(result.material.critical_stretch, 0.05);
  EXPECT_FALSE(result.material.fracture_energy);
  ASSERT_EQ(result.morphing.seeds.size(), 2u);
  EXPECT_THAT(result.morphing.seeds[0].center, ElementsAre(100., 10.));
  EXPECT_EQ(result.morphing.seeds[1].shape, perimorph::cases::SeedShape::box);
  EXPECT_EQ(result.morphing.seeds[1].rim, 2.);
  ASSERT_EQ(result.pre_cracks.size(), 1u);
  EXPECT_THAT(result.pre_cracks[0].points, ElementsAre(0., 0., 5., 0.));
  ASSERT_EQ(result.boundary_conditions.displacements.size(), 3u);
  EXPECT_EQ(result.boundary_conditions.displacements[1].node_set, "right");
  EXPECT_EQ(result.boundary_conditions.displacements[1].component, 0);
  EXPECT_EQ(result.boundary_conditions.displacements[1].value.rate, -0.02);
  EXPECT_THAT(result.boundary_conditions.tractions.at(0).rate, ElementsAre(0., -1.));
  EXPECT_EQ(result.loading.increments, 100);
  EXPECT_EQ(result.numerical.solver.muelu.get<int>("coarse: max size"), 50);
}

TEST_F(CaseFile, ValuesOfThreeDimensionsArriveInTheCase) {
  const std::string disc = R"xml(<ParameterList name="Pre-Cracks"><ParameterList name="penny">
      <Parameter name="Shape" type="string" value="Disc"/>
      <Parameter name="Center" type="Array(double)" value="{1, 2, 3}"/>
      <Parameter name="Normal" type="Array(double)" value="{0, 2, 0}"/>
      <Parameter name="Radius" type="double" value="4"/></ParameterList>)xml";
  const Case result = read(replaced(valid_in_3d(), R"xml(<ParameterList name="Pre-Cracks">)xml", disc),
                           {"Morphing/Seeds/front/Shape=Cylinder", "Morphing/Seeds/front/Start={0, 0, 0}",
                            "Morphing/Seeds/front/End={0, 0, 9}", "Morphing/Seeds/front/Inner Radius=2",
                            "Morphing/Seeds/front/Outer Radius=3"});

  EXPECT_EQ(result.dimension, 3);
  EXPECT_EQ(result.material.elastic_model, perimorph::materials::ElasticModel::three_dimensional);
  EXPECT_EQ(result.material.poissons_ratio, 0.25);
  EXPECT_EQ(result.morphing.seeds[0].shape, perimorph::cases::SeedShape::ball);
  EXPECT_EQ(result.morphing.seeds[2].shape, perimorph::cases::SeedShape::cylinder);
  EXPECT_THAT(result.morphing.seeds[2].end, ElementsAre(0., 0., 9.));
  EXPECT_EQ(result.pre_cracks[0].shape, perimorph::cases::PreCrackShape::disc);
  EXPECT_THAT(result.pre_cracks[0].normal, ElementsAre(0., 2., 0.));
  EXPECT_EQ(result.pre_cracks[0].radius, 4.);
  EXPECT_EQ(result.pre_cracks[1].shape, perimorph::cases::PreCrackShape::polygon);
  EXPECT_EQ(result.pre_cracks[1].points.size(), 12u);
  EXPECT_EQ(result.boundary_conditions.displacements[2].component, 2);
  EXPECT_THAT(result.boundary_conditions.body_force_constant, ElementsAre(0., 0., 0.));
}

TEST_F(CaseFile, DefaultsAreFilledIn) {
  const Case result = read(valid);

  EXPECT_EQ(result.dimension, 2);
  EXPECT_EQ(result.morphing.seeds[0].shape, perimorph::cases::SeedShape::ball);
  EXPECT_EQ(result.numerical.growth_inner_radius, 3.);  // 2 horizons of 1.5
  EXPECT_EQ(result.numerical.growth_outer_radius, 6.);
  EXPECT_EQ(result.numerical.short_range_cut_off, 0.52 * 1.5);
  EXPECT_EQ(read(valid_in_3d()).numerical.short_range_cut_off, 0.45 * 1.5);
  EXPECT_EQ(result.boundary_conditions.displacements[0].value.rate, 0.);
  EXPECT_THAT(result.boundary_conditions.tractions.at(0).constant, ElementsAre(0., 0.));
  EXPECT_THAT(result.boundary_conditions.body_force_rate, ElementsAre(0., 0.));
  EXPECT_EQ(result.loading.max_damage_iterations, 20000);
  EXPECT_EQ(result.loading.max_zone_growths, 5000);
  EXPECT_EQ(result.numerical.tolerance, 1e-6);
  EXPECT_EQ(result.numerical.solver.max_iterations, 500);
  EXPECT_EQ(result.numerical.damage_tolerance, 1e-4);
  EXPECT_EQ(result.numerical.solver.renewal_cost, 12.);
  EXPECT_EQ(result.output.every, 1);
}

TEST_F(CaseFile, ResolvedListIsCompleteAndHasNoTemplates) {
  const Teuchos::ParameterList list = read(valid).resolved;

  EXPECT_EQ(list.sublist("Peridynamics").get<std::string>("Micromodulus"), "Exponential");
  EXPECT_EQ(list.sublist("Material").get<double>("Poisson's Ratio"), 1. / 3.);
  EXPECT_FALSE(list.sublist("Material").isParameter("Fracture Energy"));
  EXPECT_EQ(list.sublist("Morphing").sublist("Seeds").sublist("tip").get<std::string>("Shape"), "Circle");
  EXPECT_FALSE(list.sublist("Morphing").sublist("Seeds").isParameter("*"));
  EXPECT_FALSE(list.sublist("Pre-Cracks").isParameter("*"));
}

TEST_F(CaseFile, ResolvedListReadBackGivesItself) {
  const Teuchos::ParameterList first = read(valid).resolved;
  const std::string resolved_file = folder_ / "resolved.xml";
  Teuchos::writeParameterListToXmlFile(first, resolved_file);

  const Teuchos::ParameterList second = read_case(resolved_file).resolved;

  EXPECT_TRUE(Teuchos::haveSameValues(first, second, true));
}

TEST_F(CaseFile, ReactionsDefaultToEachMovedGroupOnce) {
  const Case result = read(replaced(valid, R"xml({left, right})xml", "{}"));

  EXPECT_THAT(result.output.reactions, ElementsAre("left", "right"));
}

TEST_F(CaseFile, PoissonsRatioNearTheRightOneIsTakenAsExact) {
  for (const char* ratio : {"0.333", "0.3333", "0.33333333", "0.3336"}) {
    EXPECT_EQ(read(replaced(valid, "0.3333", ratio)).material.poissons_ratio, 1. / 3.) << ratio;
  }
  const std::string plane_strain = replaced(valid, "Plane Stress", "Plane Strain");
  EXPECT_EQ(read(replaced(plane_strain, "0.3333", "0.2501")).material.poissons_ratio, 0.25);
}

TEST_F(CaseFile, AnotherPoissonsRatioIsTakenAsItIs) {
  for (const char* ratio : {"-0.3", "0", "0.2", "0.332", "0.49"}) {
    EXPECT_EQ(read(replaced(valid, "0.3333", ratio)).material.poissons_ratio, std::stod(ratio));
  }
}

TEST_F(CaseFile, NothingNeedsToBreakAndNoZoneIsNeeded) {
  const auto first = valid.find("  <ParameterList name=\"Morphing\">");
  const auto last = valid.find("  <ParameterList name=\"Pre-Cracks\">");
  std::string text = valid;
  text.erase(first, last - first);
  text = replaced(text, R"xml(<Parameter name="Critical Stretch" type="double" value="0.05"/>)xml", "");

  const Case result = read(text);

  EXPECT_TRUE(result.morphing.seeds.empty());
  EXPECT_FALSE(result.material.critical_stretch);
  EXPECT_FALSE(result.material.fracture_energy);
}

TEST_F(CaseFile, CommentsAndDeclarationAndByteOrderMarkAreFine) {
  EXPECT_EQ(read("\xef\xbb\xbf<?xml version=\"1.0\"?>\n<!-- a plate -->\n" + valid).loading.increments, 100);
}

TEST_F(CaseFile, AbsoluteMeshPathStaysAsItIs) {
  EXPECT_EQ(read(replaced(valid, "plate.msh", "/data/plate.msh")).mesh.file, "/data/plate.msh");
}

TEST(CaseInput, NotchedBeamIsValid) {
  const Case beam = read_case(PERIMORPH_SOURCE_DIR "/inputs/notched_beam/notched_beam.xml");
  EXPECT_EQ(beam.loading.increments, 100);
  EXPECT_EQ(beam.boundary_conditions.displacements.size(), 5u);
}

// --- overrides ---

TEST_F(CaseFile, OverrideReplacesAddsAndCreates) {
  const Case result = read(valid, {"Loading/Increments=7", "/Solver/Tolerance=1e-6", "Material/Young's Modulus=2e5",
                                   "Title=a=b", "Morphing/Seeds/all/Shape=Everything", "Output/Reactions={top}",
                                   "Morphing/Growth Outer Radius=5", "Loading/Increments=8"});

  EXPECT_EQ(result.loading.increments, 8);
  EXPECT_EQ(result.numerical.tolerance, 1e-6);
  EXPECT_EQ(result.material.youngs_modulus, 2e5);
  EXPECT_EQ(result.title, "a=b");
  ASSERT_EQ(result.morphing.seeds.size(), 3u);
  EXPECT_EQ(result.morphing.seeds[2].name, "all");
  EXPECT_THAT(result.output.reactions, ElementsAre("top"));
  EXPECT_EQ(result.numerical.growth_outer_radius, 7.5);
}

TEST_F(CaseFile, OverrideInAFreeListTakesTheTypeOfTheFileOrOfItsLooks) {
  const Teuchos::ParameterList muelu =
      read(valid, {"Solver/MueLu/coarse: max size=9", "Solver/MueLu/verbosity=none", "Solver/MueLu/rap=true",
                   "Solver/MueLu/smoother: params/degree=2", "Solver/MueLu/drop=0.5"})
          .numerical.solver.muelu;

  EXPECT_EQ(muelu.get<int>("coarse: max size"), 9);
  EXPECT_EQ(muelu.get<std::string>("verbosity"), "none");
  EXPECT_EQ(muelu.get<bool>("rap"), true);
  EXPECT_EQ(muelu.sublist("smoother: params").get<int>("degree"), 2);
  EXPECT_EQ(muelu.get<double>("drop"), 0.5);
}

TEST_F(CaseFile, OverrideMendsAMistakeOfTheFile) {
  const std::string wrong = replaced(valid, horizon, R"xml(name="Horizon" type="int" value="abc")xml");
  EXPECT_EQ(read(wrong, {"Peridynamics/Horizon=2"}).peridynamics.horizon, 2.);
}

struct Override {
  const char* name;
  std::string text, error;
};

void PrintTo(const Override& override, std::ostream* out) { *out << override.name; }

class OneOverride : public CaseFile, public testing::WithParamInterface<Override> {};

TEST_P(OneOverride, IsCheckedLikeTheFile) {
  const std::string message = error(valid, {GetParam().text});
  EXPECT_THAT(message, StartsWith("1 mistake in " + file() + "\n--set: "));
  EXPECT_THAT(message, HasSubstr(GetParam().error));
}

INSTANTIATE_TEST_SUITE_P(
    Mistakes, OneOverride,
    testing::Values(
        Override{"NoEquals", "Solver/Tolerance",
                 R"xml(--set: found "Solver/Tolerance"; allowed is "Section/Sub/Name=value")xml"},
        Override{"Empty", "", R"xml(--set: found ""; allowed is "Section/Sub/Name=value")xml"},
        Override{"EmptyPath", "=3", R"xml(found "=3"; allowed is)xml"},
        Override{"EmptySection", "Solver//Tolerance=3", R"xml(found "Solver//Tolerance=3"; allowed is)xml"},
        Override{"UnknownName", "Solver/Tolerence=1e-6",
                 R"xml(/Solver/Tolerence: unknown parameter; allowed are "Operator")xml"},
        Override{"NearestName", "Solver/Tolerence=1e-6", R"xml(did you mean "Tolerance"?)xml"},
        Override{"UnknownSection", "Solvr/Tolerance=1e-6", R"xml(/Solvr: unknown section; allowed are )xml"},
        Override{"Literal", "Solver/Tolerance=small",
                 R"xml(/Solver/Tolerance: found "small", which is not a number)xml"},
        Override{"Range", "Loading/Increments=0",
                 R"xml(/Loading/Increments: found "0"; allowed is a whole number >= 1)xml"},
        Override{"SectionAsParameter", "Solver=CG", "/Solver: found a <Parameter>; allowed is a <ParameterList>"},
        Override{"ParameterAsSection", "Title/Sub=x", "/Title: found a <ParameterList>; allowed is a <Parameter>"},
        Override{"Together", "Morphing/Seeds/tip/Outer Radius=3",
                 "/Morphing/Seeds/tip/Outer Radius: found 3; allowed is"},
        Override{"TypeOfTheFile", "Solver/MueLu/coarse: max size=x", "found \"x\", which is not a whole number"}),
    [](const auto& test) { return test.param.name; });

// --- the reference ---

void expect_documented(const Teuchos::ParameterList& list, const std::string& text, const std::string& path) {
  for (const auto& item : list) {
    const std::string here = path + "/" + item.first;
    EXPECT_FALSE(item.second.docString().empty()) << here;
    EXPECT_THAT(text, HasSubstr(here));
    if (item.second.isList()) {
      expect_documented(list.sublist(item.first), text, here);
    } else {
      EXPECT_TRUE(item.second.validator() != Teuchos::null) << here;
    }
  }
}

TEST(CaseSchema, EveryParameterIsDocumentedAndHasARule) {
  expect_documented(perimorph::cases::case_schema(), perimorph::cases::describe_schema(), "");
}

TEST(CaseSchema, ReferenceSaysTypeDefaultRangeAndUnit) {
  const std::string text = perimorph::cases::describe_schema();
  EXPECT_THAT(text,
              HasSubstr("/Material/Young's Modulus\n    double; required, such as 30000; allowed is a number > 0\n"
                        "    E [stress]."));
  EXPECT_THAT(text, HasSubstr("/Solver/Tolerance\n    double; default 1e-06; allowed is a number > 0 and < 1\n"));
  EXPECT_THAT(text,
              HasSubstr("/Morphing/Seeds/*/Shape\n    string; default Circle; allowed is \"Circle\" or \"Sphere\""));
}

TEST(CaseSchema, WrongDefaultIsRefusedByTeuchosToo) {
  Teuchos::ParameterList schema = perimorph::cases::case_schema();
  EXPECT_ANY_THROW(schema.sublist("Solver").set("Tolerance", 2.));
}

}  // namespace
