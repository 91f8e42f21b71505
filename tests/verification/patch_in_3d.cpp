// Patch tests in three dimensions: uniform strain, prescribed as linear displacement on the boundary of a block.

#include <gtest/gtest.h>

#include "patch.hpp"

namespace perimorph::tests {
namespace {

using Gradient = GradientIn<3>;
using mesh::ElementType;

const Gradient any = (Gradient() << 0.01, 0.003, -0.001, -0.002, -0.004, 0.002, 0.001, 0.004, 0.005).finished();
const Gradient uniaxial = Eigen::Vector3d(0.01, 0., 0.).asDiagonal();

TEST(FinitePatchIn3d, LinearFieldIsReproducedToRounding) {
  for (const ElementType type : {ElementType::hex8, ElementType::tet4, ElementType::wedge6, ElementType::pyramid5}) {
    SCOPED_TRACE(mesh::exodus_name(type));
    SpecimenIn<3> specimen = patch<3>(brick({5, 5, 5, 0.1, type}), 2., 0.2, any);
    specimen.tolerance = 1e-13;

    const Errors actual = solve<3>(specimen, any);

    // The residual's tolerance times the condition number, some hundreds.
    EXPECT_LT(actual.displacement, 1e-10);
    EXPECT_LT(actual.strain, 1e-10);
    EXPECT_LT(actual.rms_strain, 1e-10);
  }
}

/// 11 x 11 x 11 cubes with a horizon of two, or 8 x 8 x 8 cut up with a horizon of 1.2 (nearly as many
/// bonds a point); l = 0.2; a peridynamic ball in the middle, with a rim of about a horizon. The errors are those of so
/// steep a rim: bonds of 6 l to 7 l contribute most to E0, and alpha falls by half over them.
struct Hybrid {
  const char* name;
  ElementType type;
  DiscontinuousElements discontinuous;
  PeridynamicStiffness stiffness;
  Errors largest;  ///< a tenth above what they are
};

class HybridPatchIn3d : public testing::TestWithParam<Hybrid> {};

TEST_P(HybridPatchIn3d, LinearFieldIsReproducedAcrossTheMorphingZone) {
  const auto& [name, type, discontinuous, stiffness, largest] = GetParam();
  const bool are_whole = type == ElementType::hex8;
  const double n = are_whole ? 11. : 8., horizon = are_whole ? 2. : 1.2;
  const int n_cubes = static_cast<int>(n);
  SpecimenIn<3> specimen = patch<3>(brick({n_cubes, n_cubes, n_cubes, 0., type}), horizon, 0.2, uniaxial);
  specimen.seeds = {Zone<3>::ball(Point3::Constant(0.5 * n), horizon + 1.2, 0.5 * n)};
  specimen.discontinuous = discontinuous;
  specimen.peridynamic_stiffness = stiffness;
  specimen.tolerance = 1e-8;

  const Errors actual = solve<3>(specimen, uniaxial);

  EXPECT_LT(actual.displacement, largest.displacement);
  EXPECT_LT(actual.strain, largest.strain);
  EXPECT_LT(actual.rms_strain, largest.rms_strain);
  EXPECT_GT(actual.strain, 1e-5);  // the zone is there
}

INSTANTIATE_TEST_SUITE_P(Blocks, HybridPatchIn3d,
                         testing::Values(Hybrid{"Hexahedra",
                                                ElementType::hex8,
                                                DiscontinuousElements::on_damage,
                                                PeridynamicStiffness::dropped,
                                                {0.0065, 0.070, 0.0155}},
                                         Hybrid{"HexahedraWholeZone",
                                                ElementType::hex8,
                                                DiscontinuousElements::whole_zone,
                                                PeridynamicStiffness::dropped,
                                                {0.0065, 0.070, 0.0160}},
                                         Hybrid{"HexahedraKept",
                                                ElementType::hex8,
                                                DiscontinuousElements::on_damage,
                                                PeridynamicStiffness::kept,
                                                {0.0065, 0.070, 0.0155}},
                                         Hybrid{"Pyramids",
                                                ElementType::pyramid5,
                                                DiscontinuousElements::whole_zone,
                                                PeridynamicStiffness::dropped,
                                                {0.0167, 0.071, 0.0155}},
                                         Hybrid{"Wedges",
                                                ElementType::wedge6,
                                                DiscontinuousElements::on_damage,
                                                PeridynamicStiffness::dropped,
                                                {0.0063, 0.050, 0.0160}},
                                         Hybrid{"Tetrahedra",
                                                ElementType::tet4,
                                                DiscontinuousElements::on_damage,
                                                PeridynamicStiffness::dropped,
                                                {0.0057, 0.048, 0.0150}},
                                         Hybrid{"TetrahedraKept",
                                                ElementType::tet4,
                                                DiscontinuousElements::on_damage,
                                                PeridynamicStiffness::kept,
                                                {0.0054, 0.046, 0.0145}}),
                         [](const auto& example) { return std::string(example.param.name); });

}  // namespace
}  // namespace perimorph::tests
