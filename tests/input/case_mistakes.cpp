// What the program says to a mistake in the case file: each line of text that a user can meet, by its words.

#include <algorithm>

#include "case_fixture.hpp"

namespace {

using testing::HasSubstr;
using testing::StartsWith;

// --- one mistake: a piece of the valid case, what it becomes, what is said ---

struct Mistake {
  const char* name;
  std::string piece, by, text;
};

void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.name; }

class OneMistake : public CaseFile, public testing::WithParamInterface<Mistake> {};

TEST_P(OneMistake, IsNamedWithFileLineAndPath) {
  const std::string message = error(replaced(valid, GetParam().piece, GetParam().by));

  EXPECT_THAT(message, StartsWith("1 mistake in " + file() + "\n" + file() + ":"));
  EXPECT_THAT(message, HasSubstr(GetParam().text));
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 1) << message;
}

std::string named(const testing::TestParamInfo<Mistake>& info) { return info.param.name; }

const std::string increments = R"xml(name="Increments" type="int" value="100")xml";
const std::string tip = R"xml(<Parameter name="Center" type="Array(double)" value="{100, 10}"/>)xml";
const std::string box = R"xml(<Parameter name="Shape" type="string" value="Box"/>)xml";
const std::string solver = R"xml(<ParameterList name="Solver">)xml";
const std::string elastic_model = R"xml(name="Elastic Model" type="string" value="Plane Stress")xml";

INSTANTIATE_TEST_SUITE_P(
    Names, OneMistake,
    testing::Values(
        Mistake{
            "UnknownParameter", solver, solver + R"xml(<Parameter name="Tolerence" type="double" value="1e-6"/>)xml",
            R"xml(:61: /Solver/Tolerence: unknown parameter; allowed are "Operator", "Preconditioner Matrix", )xml"},
        Mistake{"NearestParameter", solver,
                solver + R"xml(<Parameter name="Tolerence" type="double" value="1e-6"/>)xml",
                R"xml( - did you mean "Tolerance"?)xml"},
        Mistake{"UnknownAtTheTop", solver, R"xml(<Parameter name="Titel" type="string" value=""/>)xml" + solver,
                R"xml(:61: /Titel: unknown parameter; allowed are "Title", "Dimension", )xml"},
        Mistake{"UnknownInAnEntry", tip, tip + R"xml(<Parameter name="Radius" type="double" value="1"/>)xml",
                R"xml(:18: /Morphing/Seeds/tip/Radius: unknown parameter; allowed are "Shape", )xml"},
        Mistake{"UnknownSection", solver, R"xml(<ParameterList name="Solvers"/>)xml" + solver,
                R"xml(:61: /Solvers: unknown section; allowed are "Title", )xml"},
        Mistake{"NearestSection", solver, R"xml(<ParameterList name="Solvers"/>)xml" + solver,
                R"xml( - did you mean "Solver"?)xml"},
        Mistake{"ListForAParameter", solver, R"xml(<ParameterList name="Title"/>)xml" + solver,
                ":61: /Title: found a <ParameterList>; allowed is a <Parameter>"},
        Mistake{"ParameterForAList", solver, R"xml(<Parameter name="Solver" type="string" value="CG"/>)xml" + solver,
                ":61: /Solver: found a <Parameter>; allowed is a <ParameterList>"},
        Mistake{
            "ParameterAmongEntries", R"xml(<ParameterList name="tip">)xml",
            R"xml(<Parameter name="Rim" type="double" value="1"/><ParameterList name="tip">)xml",
            ":17: /Morphing/Seeds/Rim: found a <Parameter>; allowed are only lists of parameters, with names of your "
            "choice"},
        Mistake{"EntryWithASlash", R"xml(<ParameterList name="tip">)xml", R"xml(<ParameterList name="tip/1">)xml",
                R"xml(/Morphing/Seeds/tip/1: found a name with "/", "=" or "*"; allowed are names without these)xml"},
        Mistake{"ParameterTwice", "<Parameter " + increments + "/>",
                "<Parameter " + increments + "/>\n<Parameter " + increments + "/>",
                ":60: /Loading/Increments: given twice; allowed is once"},
        Mistake{"SectionTwice", solver, R"xml(<ParameterList name="Mesh"/>)xml" + solver, ":61: /Mesh: given twice"},
        Mistake{"EntryTwice", R"xml(<ParameterList name="bar">)xml", R"xml(<ParameterList name="tip">)xml",
                ":22: /Morphing/Seeds/tip: given twice; allowed is once"},
        Mistake{"FreeParameterTwice", R"xml(<ParameterList name="MueLu">)xml",
                R"xml(<ParameterList name="MueLu"><Parameter name="coarse: max size" type="int" value="1"/>)xml",
                ":63: /Solver/MueLu/coarse: max size: given twice"}),
    named);

INSTANTIATE_TEST_SUITE_P(
    Missing, OneMistake,
    testing::Values(
        Mistake{"Parameter", "<Parameter " + horizon + "/>", "",
                ":11: /Peridynamics/Horizon: missing; needed is a number > 0"},
        Mistake{"ParameterOfAnEntry", R"xml(<Parameter name="Group" type="string" value="left"/>)xml", "",
                ":37: /Boundary Conditions/Displacements/hold/Group: missing; needed is the name of a group"},
        Mistake{
            "Component", R"xml(<Parameter name="Component" type="string" value="x"/>)xml", "",
            R"xml(:37: /Boundary Conditions/Displacements/hold/Component: missing; needed is either it or a "Direction")xml"},
        Mistake{"Section", "<Parameter " + increments + "/>", "",
                ":58: /Loading/Increments: missing; needed is a whole number >= 1"},
        Mistake{"Points", R"xml(<Parameter name="Points" type="Array(double)" value="{0, 0, 5, 0}"/>)xml", "",
                ":31: /Pre-Cracks/slit/Points: missing; a pre-crack with \"Shape\" \"Polyline\" needs it"}),
    named);

INSTANTIATE_TEST_SUITE_P(
    Types, OneMistake,
    testing::Values(
        Mistake{"IntForDouble", horizon, R"xml(name="Horizon" type="int" value="2")xml",
                R"xml(:12: /Peridynamics/Horizon: found type="int"; write type="double")xml"},
        Mistake{"DoubleForInt", increments, R"xml(name="Increments" type="double" value="2")xml",
                R"xml(:59: /Loading/Increments: found type="double"; write type="int")xml"},
        Mistake{"ScalarForArray", R"xml(type="Array(double)" value="{100, 10}")xml",
                R"xml(type="double" value="100")xml",
                R"xml(/Morphing/Seeds/tip/Center: found type="double"; write type="Array(double)")xml"},
        Mistake{"None", horizon, R"xml(name="Horizon" value="2")xml",
                R"xml(/Peridynamics/Horizon: found no type; write type="double")xml"},
        Mistake{"NoneInAFreeList", R"xml(name="coarse: max size" type="int")xml", R"xml(name="coarse: max size")xml",
                R"xml(:63: /Solver/MueLu/coarse: max size: found no type; allowed are "int", "double", "bool", )xml"},
        Mistake{"UnknownInAFreeList", R"xml(name="coarse: max size" type="int")xml",
                R"xml(name="coarse: max size" type="integer")xml",
                R"xml(found type="integer"; allowed are "int", "double", "bool", "string", "Array(int)", )xml"},
        Mistake{"NoValue", horizon, R"xml(name="Horizon" type="double")xml",
                R"xml(/Peridynamics/Horizon: found no value; write value="..." with a number > 0)xml"}),
    named);

Mistake number(const char* name, const std::string& value) {
  return {name, horizon, "name=\"Horizon\" type=\"double\" value=\"" + value + "\"",
          ":12: /Peridynamics/Horizon: found \"" + value +
              "\", which is not a number such as 1.5 or 2e-3; allowed is a number > 0"};
}

Mistake whole_number(const char* name, const std::string& value) {
  return {name, increments, "name=\"Increments\" type=\"int\" value=\"" + value + "\"",
          ":59: /Loading/Increments: found \"" + value +
              "\", which is not a whole number such as 12; allowed is a whole number >= 1"};
}

Mistake array(const char* name, const std::string& value) {
  return {name, R"xml(value="{100, 10}")xml", "value=\"" + value + "\"",
          ":18: /Morphing/Seeds/tip/Center: found \"" + value + "\", which is not numbers such as {1.5, 2e-3}; "};
}

INSTANTIATE_TEST_SUITE_P(
    Literals, OneMistake,
    testing::Values(number("Letters", "abc"), number("CommaForPoint", "1,5"), number("Unit", "1e-3 mm"),
                    number("NotANumber", "nan"), number("Infinite", "inf"), number("Empty", ""),
                    number("TooLarge", "1e999"), number("Hexadecimal", "0x10"), number("TwoSigns", "+-1"),
                    whole_number("ExponentInInt", "1e3"), whole_number("PointInInt", "2.7"),
                    whole_number("EmptyInt", ""), whole_number("TooLargeInt", "99999999999"),
                    array("NoBraces", "100, 10"), array("OpenBrace", "{100, 10"), array("EmptyItem", "{100, , 10}"),
                    array("EndingComma", "{100, 10,}"), array("LettersInArray", "{a, b}"), array("Nested", "{{1}, 2}"),
                    Mistake{"Boolean", R"xml(type="int" value="50")xml", R"xml(type="bool" value="yes")xml",
                            ":63: /Solver/MueLu/coarse: max size: found \"yes\", which is not true or false"}),
    named);

INSTANTIATE_TEST_SUITE_P(
    Ranges, OneMistake,
    testing::Values(
        Mistake{"Zero", horizon, R"xml(name="Horizon" type="double" value="0")xml",
                R"xml(:12: /Peridynamics/Horizon: found "0"; allowed is a number > 0)xml"},
        Mistake{"Modulus", R"xml(value="30000")xml", R"xml(value="-1")xml",
                R"xml(/Material/Young's Modulus: found "-1"; allowed is a)xml"},
        Mistake{"NoIncrements", R"xml(value="100")xml", R"xml(value="0")xml",
                R"xml(found "0"; allowed is a whole number >= 1)xml"},
        Mistake{"Tolerance", solver, solver + R"xml(<Parameter name="Tolerance" type="double" value="1"/>)xml",
                R"xml(/Solver/Tolerance: found "1"; allowed is a number > 0 and < 1)xml"},
        Mistake{"RebuildGrowth", solver, solver + R"xml(<Parameter name="Renewal Cost" type="double" value="-1"/>)xml",
                R"xml(/Solver/Renewal Cost: found "-1"; allowed is a number >= 0)xml"},
        Mistake{"FourDimensions", R"xml(  <ParameterList name="Mesh">)xml",
                R"xml(<Parameter name="Dimension" type="int" value="4"/><ParameterList name="Mesh">)xml",
                R"xml(:2: /Dimension: found "4"; allowed is 2 or 3)xml"},
        Mistake{"MeshFile", "plate.msh", "", R"xml(:3: /Mesh/File: found ""; allowed is a readable name of a file)xml"},
        Mistake{"MeshFileWithAControlCharacter", "plate.msh", "pl\x1bte.msh",
                R"xml(:3: /Mesh/File: found "pl?te.msh"; allowed is a readable name of a file)xml"},
        Mistake{"EmptyGroup", R"xml(value="left"/>)xml", R"xml(value=""/>)xml",
                R"xml(/Displacements/hold/Group: found ""; allowed is the name of a group)xml"},
        Mistake{
            "Choice", elastic_model, R"xml(name="Elastic Model" type="string" value="plane stres")xml",
            R"xml(:8: /Material/Elastic Model: found "plane stres"; allowed is "Plane Stress" or "Plane Strain" or )xml"
            R"xml("Three-Dimensional" - did you mean "Plane Stress"?)xml"},
        Mistake{"Micromodulus", "<Parameter " + horizon,
                R"xml(<Parameter name="Micromodulus" type="string" value="Constant"/><Parameter )xml" + horizon,
                R"xml(/Peridynamics/Micromodulus: found "Constant"; allowed is "Exponential")xml"},
        Mistake{"Operator", solver, solver + R"xml(<Parameter name="Operator" type="string" value="Dense"/>)xml",
                R"xml(/Solver/Operator: found "Dense"; allowed is "CRS")xml"}),
    named);

INSTANTIATE_TEST_SUITE_P(
    Together, OneMistake,
    testing::Values(
        Mistake{"PoissonOfNoSolid", R"xml(value="0.3333")xml", R"xml(value="0.5")xml",
                ":7: /Material/Poisson's Ratio: found 0.5; allowed are ratios above -1 and below 0.5: beyond, a solid "
                "would not resist shear or a change of its volume"},
        Mistake{"PoissonBelowMinusOne", R"xml(value="0.3333")xml", R"xml(value="-1")xml",
                ":7: /Material/Poisson's Ratio: found -1; allowed are ratios above -1"},
        Mistake{"PoissonInPlaneStrain", R"xml(value="0.3333"/>
    <Parameter name="Elastic Model" type="string" value="Plane Stress"/>)xml",
                R"xml(value="0.46"/>
    <Parameter name="Elastic Model" type="string" value="Plane Strain"/>)xml",
                R"xml(found 0.46; allowed are ratios up to 0.45 for "Plane Strain": closer to 0.5 the volume)xml"},
        Mistake{
            "StretchAndEnergy", R"xml(<Parameter name="Critical Stretch")xml",
            R"xml(<Parameter name="Fracture Energy" type="double" value="1"/><Parameter name="Critical Stretch")xml",
            R"xml(:9: /Material/Fracture Energy: found beside "Critical Stretch"; allowed is one of the two)xml"},
        Mistake{
            "LengthAboveHorizon", R"xml(name="Characteristic Length" type="double" value="0.1")xml",
            R"xml(name="Characteristic Length" type="double" value="1.5")xml",
            R"xml(:12: /Peridynamics/Horizon: found 1.5; allowed is a number > "Characteristic Length", which is 1.5)xml"},
        Mistake{
            "FrictionWithoutContact", horizon,
            horizon + R"xml(/><Parameter name="Friction Coefficient" type="double" value="0.3")xml",
            R"xml(/Peridynamics/Friction Coefficient: found 0.3; allowed with "Crack Faces" = "Free" is 0: faces rub)xml"},
        Mistake{
            "GrowthRadii", R"xml(<ParameterList name="Seeds">)xml",
            R"xml(<Parameter name="Growth Inner Radius" type="double" value="5"/><ParameterList name="Seeds">)xml",
            R"xml(:15: /Morphing/Growth Outer Radius: found 4; allowed is a number > "Growth Inner Radius", which is 5)xml"},
        Mistake{
            "SeedRadii", R"xml(name="Outer Radius" type="double" value="6")xml",
            R"xml(name="Outer Radius" type="double" value="4")xml",
            R"xml(:20: /Morphing/Seeds/tip/Outer Radius: found 4; allowed is a number > "Inner Radius", which is 4)xml"},
        Mistake{"MissingForTheShape", tip, "",
                R"xml(:17: /Morphing/Seeds/tip/Center: missing; a seed with "Shape" "Circle" needs it)xml"},
        Mistake{"AutomaticWithAPlace", tip, R"xml(<Parameter name="Shape" type="string" value="Automatic"/>)xml" + tip,
                R"xml(:18: /Morphing/Seeds/tip/Center: found in a seed with "Shape" "Automatic"; allowed is only)xml"},
        Mistake{
            "AutomaticWithAnOuterRadiusAlone",
            tip + "\n        <Parameter name=\"Inner Radius\" type=\"double\" value=\"4\"/>",
            R"xml(<Parameter name="Shape" type="string" value="Automatic"/>)xml",
            R"xml(:17: /Morphing/Seeds/tip/Inner Radius: missing; an automatic seed with "Outer Radius" needs it)xml"},
        Mistake{
            "OfAnotherShape", box, box + R"xml(<Parameter name="Center" type="Array(double)" value="{0, 0}"/>)xml",
            R"xml(:23: /Morphing/Seeds/bar/Center: found in a seed with "Shape" "Box"; allowed is only what describes)xml"},
        Mistake{
            "ModelOfThreeDimensions", R"xml(value="0.3333"/>
    <Parameter name="Elastic Model" type="string" value="Plane Stress"/>)xml",
            R"xml(value="0.25"/>
    <Parameter name="Elastic Model" type="string" value="Three-Dimensional"/>)xml",
            R"xml(:8: /Material/Elastic Model: found "Three-Dimensional"; allowed is "Plane Stress" or "Plane Str)xml"},
        Mistake{
            "Sphere", tip, R"xml(<Parameter name="Shape" type="string" value="Sphere"/>)xml" + tip,
            R"xml(:18: /Morphing/Seeds/tip/Shape: found "Sphere"; allowed is "Circle" or "Box" or "Everything" or "Automatic" in )xml"
            "two dimensions (/Dimension)"},
        Mistake{"CenterOfThree", "{100, 10}", "{100, 10, 0}",
                ":18: /Morphing/Seeds/tip/Center: found {100, 10, 0}; allowed are 2 numbers, one per dimension"},
        Mistake{"Corners", "{5, 1}", "{5, 0}",
                ":25: /Morphing/Seeds/bar/Upper Corner: found {5, 0}; allowed is a corner above and to the right of "
                "\"Lower Corner\", which is {0, 0}"},
        Mistake{"OddPoints", "{0, 0, 5, 0}", "{0, 0, 5}",
                ":32: /Pre-Cracks/slit/Points: found 3 numbers; allowed are two points or more, {x1, y1, x2, y2, ...}"},
        Mistake{"OnePoint", "{0, 0, 5, 0}", "{0, 0}", "found 2 numbers; allowed are two points or more"},
        Mistake{
            "NoLength", "{0, 0, 5, 0}", "{0, 0, 5, 0, 5, 0}",
            ":32: /Pre-Cracks/slit/Points: found the point (5, 0) twice in a row; allowed are segments that have a"},
        Mistake{
            "ComponentZ", R"xml(value="x")xml", R"xml(value="z")xml",
            R"xml(:39: /Boundary Conditions/Displacements/hold/Component: found "z"; allowed is "x" or "y" or "rotation z" in two)xml"},
        Mistake{"DirectionBesideComponent", R"xml(<Parameter name="Component" type="string" value="x"/>)xml",
                R"xml(<Parameter name="Component" type="string" value="x"/>
                   <Parameter name="Direction" type="Array(double)" value="{1, 1}"/>)xml",
                R"xml(/hold/Direction: found beside "Component"; allowed is one of the two)xml"},
        Mistake{"DirectionWithoutLength", R"xml(<Parameter name="Component" type="string" value="x"/>)xml",
                R"xml(<Parameter name="Direction" type="Array(double)" value="{0, 0}"/>)xml",
                "/hold/Direction: found {0, 0}; allowed is a direction, which has a length"},
        Mistake{"DirectionOfThree", R"xml(<Parameter name="Component" type="string" value="x"/>)xml",
                R"xml(<Parameter name="Direction" type="Array(double)" value="{1, 0, 1}"/>)xml",
                "/hold/Direction: found {1, 0, 1}; allowed are 2 numbers, one per dimension"},
        Mistake{
            "RotationOfNoRigidGroup", R"xml(value="x")xml", R"xml(value="rotation z")xml",
            R"xml(/hold/Component: found "rotation z" of the group "left", which is no rigid body; allowed is it )xml"
            R"xml(for groups of /Boundary Conditions/Rigid Groups with "Shared" = "Rigid Motion")xml"},
        Mistake{"RigidGroupTwice", R"xml(<ParameterList name="Tractions">)xml",
                R"xml(<ParameterList name="Rigid Groups">
                     <ParameterList name="a"><Parameter name="Group" type="string" value="left"/></ParameterList>
                     <ParameterList name="b"><Parameter name="Group" type="string" value="left"/></ParameterList>
                   </ParameterList><ParameterList name="Tractions">)xml",
                R"xml(/Boundary Conditions/Rigid Groups/b/Group: found "left" again; allowed is each group once)xml"},
        Mistake{
            "CenterOfWhatDoesNotTurn", R"xml(<ParameterList name="Tractions">)xml",
            R"xml(<ParameterList name="Rigid Groups"><ParameterList name="a">
                     <Parameter name="Group" type="string" value="top"/>
                     <Parameter name="Shared" type="string" value="y"/>
                     <Parameter name="Center" type="Array(double)" value="{0, 0}"/>
                   </ParameterList></ParameterList><ParameterList name="Tractions">)xml",
            R"xml(/a/Center: found with "Shared" = "y", where it has no effect; allowed is it with "Rigid Motion")xml"},
        Mistake{
            "PrescribedTwice", R"xml(value="right"/>)xml", R"xml(value="left"/>)xml",
            R"xml(:43: /Boundary Conditions/Displacements/pull/Component: found the group "left" with "x" again; )xml"
            "/Boundary Conditions/Displacements/hold prescribes that displacement already"},
        Mistake{"TractionOfOne", "{0, -1}", "{-1}",
                ":54: /Boundary Conditions/Tractions/wind/Rate: found {-1}; allowed are 2 numbers, one per dimension"},
        Mistake{"BodyForceOfThree", R"xml(<ParameterList name="Tractions">)xml",
                R"xml(<ParameterList name="Body Force"><Parameter name="Rate" type="Array(double)" value="{1, 2, 3}"/>
                   </ParameterList><ParameterList name="Tractions">)xml",
                ":51: /Boundary Conditions/Body Force/Rate: found {1, 2, 3}; allowed are 2 numbers"},
        Mistake{"ReactionTwice", "{left, right}", "{left, left}",
                R"xml(:67: /Output/Reactions: found "left" twice; allowed is each group once)xml"}),
    named);

class OneMistakeIn3d : public OneMistake {};

TEST_P(OneMistakeIn3d, IsNamedWithFileLineAndPath) {
  const std::string message = error(replaced(valid_in_3d(), GetParam().piece, GetParam().by));

  EXPECT_THAT(message, StartsWith("1 mistake in " + file() + "\n" + file() + ":"));
  EXPECT_THAT(message, HasSubstr(GetParam().text));
}

const std::string polygon = "{0, 0, 0, 5, 0, 0, 5, 0, 2, 0, 0, 2}";
const std::string not_a_polygon = ":32: /Pre-Cracks/slit/Points: found {";

INSTANTIATE_TEST_SUITE_P(
    InThreeDimensions, OneMistakeIn3d,
    testing::Values(
        Mistake{
            "PlaneModel", R"xml(value="0.25"/>
    <Parameter name="Elastic Model" type="string" value="Three-Dimensional"/>)xml",
            R"xml(value="0.3333"/>
    <Parameter name="Elastic Model" type="string" value="Plane Stress"/>)xml",
            R"xml(:8: /Material/Elastic Model: found "Plane Stress"; allowed is "Three-Dimensional" in three dim)xml"},
        Mistake{"PoissonsRatio", R"xml(value="0.25")xml", R"xml(value="0.49")xml",
                R"xml(:7: /Material/Poisson's Ratio: found 0.49; allowed are ratios up to 0.45 for "Three-Dimen)xml"},
        Mistake{
            "Circle", R"xml(value="Sphere")xml", R"xml(value="Circle")xml",
            R"xml(:18: /Morphing/Seeds/tip/Shape: found "Circle"; allowed is "Sphere" or "Cylinder" or "Box" or )xml"
            R"xml("Everything" or "Automatic" in three dimensions (/Dimension))xml"},
        Mistake{"CircleByDefault", R"xml(<Parameter name="Shape" type="string" value="Sphere"/>)xml", "",
                R"xml(:17: /Morphing/Seeds/tip/Shape: found "Circle"; allowed is "Sphere")xml"},
        Mistake{"CenterOfTwo", "{100, 10, 0}", "{100, 10}",
                ":18: /Morphing/Seeds/tip/Center: found {100, 10}; allowed are 3 numbers, one per dimension"},
        Mistake{
            "CylinderWithoutLength",
            R"xml(value="Sphere"/><Parameter name="Center" type="Array(double)" value="{100, 10, 0}"/>)xml",
            R"xml(value="Cylinder"/><Parameter name="Start" type="Array(double)" value="{1, 2, 3}"/>
                      <Parameter name="End" type="Array(double)" value="{1, 2, 3}"/>)xml",
            R"xml(:19: /Morphing/Seeds/tip/End: found {1, 2, 3}, which is "Start" too; allowed is an axis that)xml"},
        Mistake{"Polyline", R"xml(value="Polygon")xml", R"xml(value="Polyline")xml",
                R"xml(:32: /Pre-Cracks/slit/Shape: found "Polyline"; allowed is "Polygon" or "Disc" in three)xml"},
        Mistake{"TwoPoints", polygon, "{0, 0, 0, 5, 0, 0}",
                "found 6 numbers; allowed are three points or more, {x1, y1, z1, x2, ...}"},
        Mistake{"PointsOfFourNumbers", polygon, "{0, 0, 0, 5, 0, 0, 5, 0, 2, 0}",
                "found 10 numbers; allowed are three"},
        Mistake{"LastPointIsTheFirst", polygon, "{0, 0, 0, 5, 0, 0, 5, 0, 2, 0, 0, 0}",
                "found the point (0, 0, 0) twice in a row"},
        Mistake{"NotFlat", polygon, "{0, 0, 0, 5, 0, 0, 5, 0, 2, 0, 0.1, 2}", not_a_polygon},
        Mistake{"NotConvex", polygon, "{0, 0, 0, 5, 0, 0, 1, 0, 1, 0, 0, 2}", not_a_polygon},
        Mistake{"Star", polygon, "{3, 0, 0, -2.4, 0, 1.8, 0.9, 0, -2.9, 0.9, 0, 2.9, -2.4, 0, -1.8}", not_a_polygon},
        Mistake{"OnALine", polygon, "{0, 0, 0, 5, 0, 0, 10, 0, 0}", not_a_polygon},
        Mistake{
            "DiscWithoutNormal",
            R"xml(value="Polygon"/><Parameter name="Points" type="Array(double)" value="{0, 0, 0, 5, 0, 0, 5, 0, 2, 0, 0, 2}"/>)xml",
            R"xml(value="Disc"/><Parameter name="Center" type="Array(double)" value="{1, 2, 3}"/>
                  <Parameter name="Radius" type="double" value="3"/>)xml",
            R"xml(:31: /Pre-Cracks/slit/Normal: missing; a pre-crack with "Shape" "Disc" needs it)xml"},
        Mistake{
            "DiscWithNormalZero",
            R"xml(value="Polygon"/><Parameter name="Points" type="Array(double)" value="{0, 0, 0, 5, 0, 0, 5, 0, 2, 0, 0, 2}"/>)xml",
            R"xml(value="Disc"/><Parameter name="Center" type="Array(double)" value="{1, 2, 3}"/>
                  <Parameter name="Normal" type="Array(double)" value="{0, 0, 0}"/>
                  <Parameter name="Radius" type="double" value="3"/>)xml",
            R"xml(:33: /Pre-Cracks/slit/Normal: found {0, 0, 0}; allowed is a direction, which has a length)xml"},
        Mistake{
            "TractionOfTwo", "{0, -1, 0}", "{0, -1}",
            ":54: /Boundary Conditions/Tractions/wind/Rate: found {0, -1}; allowed are 3 numbers, one per dimension"}),
    named);

INSTANTIATE_TEST_SUITE_P(
    Markup, OneMistake,
    testing::Values(
        Mistake{"UnknownTag", solver, "<Paramter/>" + solver,
                R"xml(:61: found the tag "Paramter"; allowed are <Parameter .../> and <ParameterList ...>)xml"
                R"xml( - did you mean "Parameter"?)xml"},
        Mistake{"UnknownTagInside", tip, tip + "<!-- fine --><b/>",
                R"xml(:18: /Morphing/Seeds/tip: found the tag "b";)xml"},
        Mistake{"Text", solver, "hello" + solver, R"xml(:61: found the text "hello"; allowed are)xml"},
        Mistake{"TextInAParameter", horizon + "/>", horizon + ">3</Parameter>",
                R"xml(:12: /Peridynamics/Horizon: found the text "3" inside; allowed is value="..." alone)xml"},
        Mistake{
            "UnknownAttribute", horizon, horizon + R"xml( unit="mm")xml",
            R"xml(:12: /Peridynamics/Horizon: found the attribute "unit"; allowed are "name", "type", "value", )xml"},
        Mistake{"AttributeTwice", horizon, horizon + R"xml( value="2")xml",
                R"xml(:12: /Peridynamics/Horizon: found the attribute "value" twice; allowed is once)xml"},
        Mistake{"ValueOfAList", solver, R"xml(<ParameterList name="Solver" value="CG">)xml",
                R"xml(:61: /Solver: found the attribute "value"; allowed are "name", "id", "docString")xml"},
        Mistake{"NoName", solver, solver + R"xml(<Parameter type="int" value="3"/>)xml",
                R"xml(:61: /Solver: <Parameter> without a name; name="..." is needed)xml"},
        Mistake{"LongName", solver,
                solver + "<Parameter name=\"" + std::string(201, 'a') + "\" type=\"int\" value=\"3\"/>",
                R"xml(aaa..."; allowed is a readable one of at most 200 characters)xml"},
        Mistake{"TwoRoots", valid, valid + R"xml(<ParameterList name="second"/>)xml",
                R"xml(:70: found the tag "ParameterList"; allowed is one <ParameterList> that holds everything)xml"},
        Mistake{"TextBesideTheRoot", valid, valid + "the end",
                R"xml(:70: found the text "the end"; allowed is one)xml"},
        Mistake{"DocumentType", valid, "<!DOCTYPE ParameterList>\n" + valid,
                ":1: found a document type (entities are not expanded); allowed is one <ParameterList>"},
        Mistake{"NoParameterList", valid, "<!-- nothing -->", ":1: there is no <ParameterList>; one that holds"},
        Mistake{"UnclosedTag", "    <Parameter " + horizon + "/>", "    <Parameter " + horizon + ">",
                ":14: the XML is broken here (Start-end tags mismatch); is a tag, a quote or a \"/>\" missing?"},
        Mistake{"UnclosedQuote", R"xml(value="1.5"/>)xml", R"xml(value="1.5/>)xml",
                ":13: the XML is broken here (Error parsing"},
        Mistake{"Truncated", "</ParameterList>\n</ParameterList>\n", "", "the XML is broken here"},
        Mistake{"NotXml", valid, "Horizon = 1.5", R"xml(:1: found the text "Horizon = 1.5"; allowed is one)xml"}),
    named);

TEST_F(CaseFile, AMatrixCannotHoldDilatation) {
  const std::string other_ratio = replaced(valid, R"xml(value="0.3333")xml", R"xml(value="0.3")xml");
  EXPECT_THAT(
      error(other_ratio, {"Solver/Operator=CRS"}),
      HasSubstr("--set: /Solver/Operator: found \"CRS\"; with this Poisson's ratio allowed is \"Matrix-Free\" or "
                "\"On-the-Fly\": through the dilatation"));
  EXPECT_EQ(read(valid, {"Solver/Operator=CRS"}).numerical.operator_form, perimorph::operators::OperatorForm::crs);
}

TEST_F(CaseFile, ContactNeedsFacesThatCanMeet) {
  const auto with_contact = [&](const std::string& other) {
    return error(valid, {"Peridynamics/Crack Faces=Contact", other});
  };
  EXPECT_THAT(
      with_contact("Boundary Conditions/Symmetry Planes/middle/Group=top"),
      HasSubstr("--set: /Peridynamics/Crack Faces: found \"Contact\"; with /Boundary Conditions/Symmetry Planes "
                "allowed is \"Free\": contact across the planes is not computed"));
  EXPECT_THAT(with_contact("Morphing/Discontinuous Elements=Never"),
              HasSubstr("--set: /Peridynamics/Crack Faces: found \"Contact\"; with /Morphing/Discontinuous Elements = "
                        "\"Never\" allowed is \"Free\": elements that do not part have no faces"));
}

// --- several mistakes ---

TEST_F(CaseFile, AllMistakesAreListedInOneGoByLine) {
  std::string text = replaced(valid, horizon, R"xml(name="Horizon" type="double" value="abc")xml");
  text = replaced(text, R"xml(value="0.3333")xml", R"xml(value="0.6")xml");
  text = replaced(text, elastic_model, elastic_model + R"xml( unit="none")xml");
  text = replaced(text, R"xml(name="Increments")xml", R"xml(name="Incremnets")xml");
  text = replaced(text, "{0, -1}", "{0}");
  text = replaced(text, R"xml(value="top")xml", R"xml(value="topp")xml");

  const std::string message = error(text, {"Solver/Tolerence=1"});

  EXPECT_THAT(message, StartsWith("8 mistakes in " + file() + "\n"));
  const std::vector<std::string> in_order{":7: /Material/Poisson's Ratio: ",
                                          ":8: /Material/Elastic Model: found the attribute",
                                          ":12: /Peridynamics/Horizon: found \"abc\"",
                                          ":53: /Boundary Conditions/Tractions/wind/Group: the mesh plate.msh has no",
                                          ":54: /Boundary Conditions/Tractions/wind/Rate: ",
                                          ":58: /Loading/Increments: missing",
                                          ":59: /Loading/Incremnets: unknown parameter",
                                          "\n--set: /Solver/Tolerence: unknown parameter"};
  std::size_t at = 0;
  for (const auto& mistake : in_order) {
    at = message.find(mistake, at);
    ASSERT_NE(at, std::string::npos) << mistake << " is not in its place in\n" << message;
  }
}

TEST_F(CaseFile, WhatDoesNotFitTheMeshIsListedWithTheOthers) {
  std::string text = replaced(valid, R"xml(value="0.3333")xml", R"xml(value="0.6")xml");
  text = replaced(text, horizon, R"xml(name="Horizon" type="double" value="0.5")xml");
  text = replaced(text, R"xml(name="guide")xml", R"xml(name="pull again")xml");
  text = replaced(text, R"xml(value="y")xml", R"xml(value="x")xml");
  text = replaced(text, R"xml(value="left"/>
        <Parameter name="Component" type="string" value="x"/>
      </ParameterList>
    </ParameterList>)xml",
                  R"xml(value="top"/>
        <Parameter name="Component" type="string" value="x"/>
      </ParameterList>
    </ParameterList>)xml");

  const std::string message =
      error(text, {"Output/Probes/far/Points={9, 90}", "Morphing/Seeds/bar/Upper Corner={7, 1}"});

  EXPECT_THAT(message, StartsWith("5 mistakes in "));
  for (const char* piece :
       {":7: /Material/Poisson's Ratio: ", ":12: /Peridynamics/Horizon: found 0.5, but in the seed \"bar\" the element",
        ":36: /Boundary Conditions/Displacements: the body can move as a whole: translation in y",
        (":46: /Boundary Conditions/Displacements/pull again: prescribes another x displacement than "
         "/Boundary Conditions/Displacements/pull on 1 node"),
        "--set: /Output/Probes/far/Points: (9, 90) is outside the body"}) {
    EXPECT_THAT(message, HasSubstr(piece));
  }
}

TEST_F(CaseFile, WhatFollowsFromAnotherMistakeIsNotListed) {
  const std::string small = R"xml(name="Horizon" type="double" value="0.5")xml";
  const std::vector<std::string> far{"Output/Probes/far/Points={9, 9}"};
  const std::string unscaled = R"xml(plate.msh"/><Parameter name="Scale" type="double" value="0"/>)xml";
  const std::string unknown = R"xml(value="0.5"/><Parameter name="Length" type="double" value="1"/>)xml";

  EXPECT_THAT(error(replaced(replaced(valid, horizon, small), R"xml(plate.msh"/>)xml", unscaled), far),
              StartsWith("1 mistake in "));
  EXPECT_THAT(error(replaced(replaced(valid, horizon, small), R"xml(value="0.5"/>)xml", unknown)),
              StartsWith("1 mistake in "));
  EXPECT_THAT(error(replaced(valid, R"xml(value="y")xml", R"xml(value="q")xml")), StartsWith("1 mistake in "));
}

TEST_F(CaseFile, AProbeHasNotMorePlacesThanMemory) {
  EXPECT_THAT(
      error(valid, {"Output/Probes/line/Points={0, 0, 1, 1}", "Output/Probes/line/Divisions=2000000000"}),
      HasSubstr("--set: /Output/Probes/line/Divisions: found 2000000000; allowed are less than 1000000 places"));
}

TEST_F(CaseFile, AMeshThatCannotBeReadIsOneMistakeAmongTheOthers) {
  std::filesystem::remove(folder_ / "plate.msh");

  const std::string message = error(replaced(valid, horizon, R"xml(name="Horizon" type="double" value="0")xml"));

  EXPECT_THAT(message, StartsWith("2 mistakes in " + file() + "\n" + file() + ":3: /Mesh/File: "));
  EXPECT_THAT(message, HasSubstr("plate.msh: "));
  EXPECT_THAT(message, HasSubstr(":12: /Peridynamics/Horizon: "));
}

TEST_F(CaseFile, EmptyListMissesAllThatIsRequired) {
  const std::string message = error("<ParameterList/>");

  EXPECT_THAT(message, StartsWith("7 mistakes in "));
  for (const char* path :
       {"/Mesh/File", "/Material/Young's Modulus", "/Material/Poisson's Ratio", "/Material/Elastic Model",
        "/Peridynamics/Horizon", "/Peridynamics/Characteristic Length", "/Loading/Increments"}) {
    EXPECT_THAT(message, HasSubstr(":1: " + std::string(path) + ": missing; needed is"));
  }
}

TEST_F(CaseFile, HopelessFileIsNotReadToItsEnd) {
  std::string tags;
  for (int i = 0; i < 300000; ++i) tags += "<a/>\n";

  const std::string message = error(replaced(valid, solver, tags + solver));

  EXPECT_THAT(message, StartsWith("more than 99 mistakes in " + file() + ", of which the first are\n"));
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 100);
}

}  // namespace
