// Several materials in one case, what joins them, and what the program says to mistakes in them.

#include "case_fixture.hpp"

namespace {

using testing::HasSubstr;

const std::string with_steel = R"xml(<ParameterList name="Materials">
    <ParameterList name="steel">
      <Parameter name="Blocks" type="Array(string)" value="{BLOCK}"/>
      <Parameter name="Young's Modulus" type="double" value="210000"/>
      <Parameter name="Poisson's Ratio" type="double" value="0.3"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Peridynamics">)xml";

/// The valid case with steel in its only block.
std::string steel_in(const std::string& block) {
  return replaced(valid, R"xml(<ParameterList name="Peridynamics">)xml", replaced(with_steel, "BLOCK", block));
}

TEST_F(CaseFile, AMaterialFillsBlocksOfTheMesh) {
  const perimorph::cases::Case input = read(steel_in("body"));
  ASSERT_EQ(input.materials.size(), 1u);
  EXPECT_EQ(input.materials[0].name, "steel");
  EXPECT_EQ(input.materials[0].youngs_modulus, 210000.);
  EXPECT_FALSE(input.materials[0].breaks());
  EXPECT_THAT(error(steel_in("boddy"), {"Solver/Tolerence=1"}),  // the mesh is read beside other mistakes

              HasSubstr("/Materials/steel/Blocks: the mesh plate.msh has no group of elements "
                        "called \"boddy\"; it has"));
}

TEST_F(CaseFile, MistakesOfMaterialsAreNamed) {
  const std::string path = "Materials/steel/",
                    pair = "Interfaces/bond/Materials=", energy = "Interfaces/bond/Fracture Energy=1";
  const std::vector<std::pair<std::vector<std::string>, std::string>> mistakes = {
      {{path + "Poisson's Ratio=0.7"}, "/Materials/steel/Poisson's Ratio: found 0.7; allowed are ratios above -1"},
      {{path + "Blocks={}"}, "/Materials/steel/Blocks: found none; allowed are the names of one block or more"},
      {{path + "Blocks={body, body}"}, "/Materials/steel/Blocks: found \"body\", which /Materials/steel fills already"},
      {{path + "Critical Stretch=0.1", path + "Fracture Energy=1"}, "/Materials/steel/Fracture Energy: found beside"},
      {{path + "Characteristic Length=3"},
       "/Materials/steel/Characteristic Length: found 3; allowed is below the horizon"},
      {{"Material/Name=steel"}, "/Material/Name: found \"steel\", which is the name of /Materials/steel too"},
      {{pair + "{body, steel}"}, "/Interfaces/bond/Fracture Energy: missing, and so is \"Critical Stretch\""},
      {{pair + "{body, stel}", energy}, "/Interfaces/bond/Materials: found \"stel\"; the materials are \"body\""},
      {{pair + "{steel, steel}", energy},
       "/Interfaces/bond/Materials: found {steel, steel}; allowed are the names of two"},
      {{pair + "{steel, body}", energy, "Interfaces/twice/Materials={body, steel}",
        "Interfaces/twice/Fracture Energy=1"},
       "/Interfaces/twice/Materials: found a pair that /Interfaces/bond has already"},
      {{path + "Bond Law=Bilinear", path + "Fracture Energy=1"},
       "/Materials/steel/Tensile Strength: missing; \"Bond Law\" = \"Bilinear\" needs it"},
      {{path + "Bond Law=Exponential", path + "Tensile Strength=3"},
       "/Materials/steel/Fracture Energy: missing; \"Bond Law\" = \"Exponential\" needs it"},
      {{path + "Bond Law=Bilinear", path + "Tensile Strength=3", path + "Fracture Energy=1",
        path + "Critical Stretch=1"},
       "/Materials/steel/Critical Stretch: found beside \"Bond Law\" = \"Bilinear\"; allowed is it with \"Brittle\""},
      {{path + "Tensile Strength=3"},
       "/Materials/steel/Tensile Strength: found with \"Bond Law\" = \"Brittle\"; allowed is it with \"Bilinear\" or"},
      {{path + "Bond Law=Ductile"},
       "/Materials/steel/Bond Law: found \"Ductile\"; allowed is \"Brittle\" or \"Bilinear\""},
      {{pair + "{body, steel}", "Interfaces/bond/Bond Law=Bilinear", energy},
       "/Interfaces/bond/Tensile Strength: missing; \"Bond Law\" = \"Bilinear\" needs it"},
      {{path + "Bond Law=Bilinear", path + "Tensile Strength=3", path + "Fracture Energy=1",
        "Solver/Operator=On-the-Fly"},
       "/Solver/Operator: found \"On-the-Fly\"; with bonds that soften allowed is \"Matrix-Free\" or \"CRS\""},
      {{path + "Bond Law=Bilinear", path + "Tensile Strength=3", path + "Fracture Energy=1",
        "Loading/Breaking Fraction=0.5"},
       "/Loading/Breaking Fraction: found 0.5; with bonds that soften allowed is 1"},
      {{path + "Compressive Strength=-1"},
       "/Materials/steel/Compressive Strength: found \"-1\"; allowed is a number > 0"},
      {{path + "Compressive Strength=40"},
       "/Materials/steel/Compressive Strength: found 40; allowed is none without \"Critical Stretch\" or"},
      {{path + "Compressive Strength=40", path + "Bond Law=Bilinear", path + "Tensile Strength=3",
        path + "Fracture Energy=1"},
       "/Materials/steel/Compressive Strength: found 40; allowed is none with \"Bond Law\" = \"Bilinear\": what a bond "
       "dissipates as it softens"},
      {{path + "Compressive Strength=40", path + "Fracture Energy=1", path + "Poisson's Ratio=-0.1"},
       "/Materials/steel/Compressive Strength: found 40; allowed is none with \"Poisson's Ratio\" = -0.1: compression"},
      {{pair + "{body, steel}", energy, "Interfaces/bond/Compressive Strength=40"},
       "/Interfaces/bond/Compressive Strength: unknown parameter"},
      {{"Loading/Softening Tolerance=0.01"}, "/Loading/Softening Tolerance: found 0.01, but no bonds soften"},
      {{"Boundary Conditions/Self-Weight/Constant={0, -9810}"},
       "/Material/Density: found 0; /Boundary Conditions/Self-Weight needs a density above 0"},
      {{"Boundary Conditions/Temperatures/cold/Rate=-1", "Boundary Conditions/Temperatures/cold/Blocks={body}",
        path + "Thermal Expansion=0", "Material/Thermal Expansion=1e-5"},
       "/Material/Thermal Expansion: found 0 in all materials in which /Boundary Conditions/Temperatures/cold changes"},
      {{"Boundary Conditions/Self-Weight/Constant={0, -9810, 0}", "Material/Density=1", path + "Density=1"},
       "/Boundary Conditions/Self-Weight/Constant: found"},
  };
  for (const auto& [settings, message] : mistakes) {
    EXPECT_THAT(error(steel_in("body"), settings), HasSubstr(message)) << settings[0];
  }
}

}  // namespace
