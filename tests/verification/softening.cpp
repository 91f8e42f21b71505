// Bars whose bonds soften: the strength and the energy that were asked for, and the balance of energy.

#include "perimorph/materials/softening.hpp"

#include <gtest/gtest.h>

#include "support/fracture_body.hpp"

namespace perimorph::tests {
namespace {

using materials::Softening;

constexpr double youngs_modulus = 37000., strength = 3.9, energy = 0.14;  // concrete, in mm and MPa
constexpr double weakness = 0.98;                                         // of the row in the middle

template <int dim>
materials::Toughness toughness_of(const materials::Material<dim>& material, Softening softening, double share) {
  return materials::softening_toughness(material, material, softening, share * strength, share * energy);
}

/// A bar that is pulled along its last axis, with grips that never break and a row in the middle that is a little
/// weaker. Elements are regular.
template <int dim>
struct Bar {
  double size;                            ///< of an element, [length]
  int width, gauge, grip;                 ///< elements across, between the grips, and of each grip
  double characteristic_length, horizon;  ///< [length]
  Softening softening = Softening::bilinear;
  double poissons_ratio = dim == 2 ? 1. / 3. : 0.25;

  double area() const { return std::pow(width * size, dim - 1); }
  double length() const { return (gauge + 2 * grip) * size; }

  SpecimenIn<dim> specimen(mesh::Mesh<dim> whole) const {
    whole.block_names = {"gauge", "grips", "weak row"};
    for (int e = 0; e < whole.n_elements(); ++e) {
      const double y = mesh::centroid(whole, e)[dim - 1] - 0.5 * length();
      whole.blocks[e] = std::abs(y) < 0.5 * size ? 2 : std::abs(y) < 0.5 * gauge * size ? 0 : 1;
    }
    SpecimenIn<dim> specimen{std::move(whole), horizon, characteristic_length, {Zone<dim>::everything()}};
    specimen.displacements = {{"hold", dim == 2 ? "bottom" : "back", dim - 1, {0., 0.}},
                              {"pull", dim == 2 ? "top" : "front", dim - 1, {1., 0.}}};
    specimen.youngs_modulus = youngs_modulus;
    specimen.poissons_ratio = poissons_ratio;
    specimen.tolerance = 1e-6;
    auto grips = materials::elastic_material<dim>(specimen.elastic_model, youngs_modulus, poissons_ratio,
                                                  characteristic_length, horizon);
    auto weak = grips;
    weak.toughness = toughness_of(weak, softening, weakness);
    specimen.law = toughness_of(grips, softening, 1.).law;
    specimen.others = {grips, weak};
    specimen.material_of_block = {{"gauge", 0}, {"grips", 1}, {"weak row", 2}};
    return specimen;
  }
};

mesh::Mesh<2> mesh_of(const Bar<2>& bar) {
  return grid({bar.width, bar.gauge + 2 * bar.grip, bar.width * bar.size, bar.length()});
}

mesh::Mesh<3> mesh_of(const Bar<3>& bar) { return brick({bar.width, bar.width, bar.gauge + 2 * bar.grip}); }

struct Pull {
  double stiffness = 0.;   ///< over that of a classical bar
  double strength = 0.;    ///< over that which was asked for
  double energy = 0.;      ///< dissipated from the peak on, over that which was asked for of the weak row
  double dissipated = 0.;  ///< in all, over that which was asked for of the gauge
  double imbalance = 0.;   ///< of all energy, over what was dissipated
  double last = 0.;        ///< stress over strength
};

/// To an elongation well beyond the critical stretch's opening of a crack.
template <int dim>
Pull pull(const Bar<dim>& bar, const SpecimenIn<dim>& specimen, double elongation, int increments) {
  SpecimenBodyIn<dim> test(specimen);
  const auto to = [&](int i) { return elongation * std::pow(static_cast<double>(i) / increments, 2.); };
  Pull result;
  constexpr double plateau = 0.99;
  double before_the_fall = 0., stress = 0.;
  for (int i = 1; i <= increments; ++i) {
    test.advance(to(i));
    double force = 0.;
    const auto& dofs = test.body.topology().dofs();
    for (int n = 0; n < dofs.n_owned_nodes(); ++n) {
      const double y = test.mesh.coordinates[dofs.reference_node(n)][dim - 1];
      if (y > bar.length() - 1e-6) force += test.body.reaction(n)[dim - 1];
    }
    stress = base::sum(*Tpetra::getDefaultComm(), force) / bar.area();
    if (i == 1) result.stiffness = stress * bar.length() / (youngs_modulus * to(i));
    result.strength = std::max(result.strength, stress / strength);
    if (stress / strength > plateau * result.strength) before_the_fall = test.body.energies().dissipated;
  }
  const auto energies = test.body.energies();
  result.energy = (energies.dissipated - before_the_fall) / (weakness * energy * bar.area());
  result.dissipated = energies.dissipated / (energy * bar.area());
  result.imbalance = (energies.external_work - energies.elastic - energies.dissipated) / energies.dissipated;
  result.last = stress / strength;
  return result;
}

class SofteningBar : public testing::TestWithParam<std::tuple<Softening, double>> {};

/// Ten horizons wide. What is dissipated before the peak is spread over the whole gauge, and not part of the crack's.
TEST_P(SofteningBar, HasTheStrengthAndTheEnergyThatWereAskedFor) {
  Bar<2> bar{2.5, 30, 9, 3, 2.5 / 3., 7.5, std::get<0>(GetParam()), std::get<1>(GetParam())};
  const auto result = pull(bar, bar.specimen(mesh_of(bar)), 0.25, 60);
  EXPECT_NEAR(result.strength, weakness, 0.05);
  EXPECT_NEAR(result.energy, 1., bar.poissons_ratio == 0.2 ? 0.08 : 0.05);
  EXPECT_LT(std::abs(result.imbalance), 0.05);
  EXPECT_LT(result.last, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Kinds, SofteningBar,
                         testing::Values(std::tuple(Softening::bilinear, 1. / 3.),
                                         std::tuple(Softening::exponential, 1. / 3.),
                                         std::tuple(Softening::bilinear, 0.2)));

/// Of two halves that are half as strong where they meet, the upper one as stiff or three times as stiff. Twenty
/// horizons wide: at its sides bonds are missing.
TEST(SofteningInterface, HasTheStrengthAndTheEnergyThatWereAskedFor) {
  constexpr double share = 0.5;
  const Bar<2> bar{2.5, 60, 8, 0, 2.5 / 3., 7.5};
  for (const double ratio : {1., 3.}) {
    SCOPED_TRACE(ratio);
    auto specimen = bar.specimen(mesh_of(bar));
    const auto lower = specimen.others[0];
    auto upper = materials::elastic_material<2>(specimen.elastic_model, ratio * youngs_modulus, bar.poissons_ratio,
                                                bar.characteristic_length, bar.horizon);
    upper.toughness = toughness_of(upper, bar.softening, 1.);
    specimen.whole.block_names = {"lower", "upper"};
    for (int e = 0; e < specimen.whole.n_elements(); ++e) {
      specimen.whole.blocks[e] = mesh::centroid(specimen.whole, e)[1] > 0.5 * bar.length() ? 1 : 0;
    }
    specimen.others = {upper};
    specimen.material_of_block = {{"lower", 0}, {"upper", 1}};
    specimen.interface = materials::softening_toughness(lower, upper, bar.softening, share * strength, share * energy);

    const auto result = pull(bar, specimen, 0.25, 30);

    EXPECT_NEAR(result.strength, share, 0.05 * share);
    EXPECT_NEAR(result.dissipated, share, 0.05 * share);  // nothing else softens
    EXPECT_LT(std::abs(result.imbalance), 0.05);
    EXPECT_LT(result.last, 0.05);
  }
}

/// At surfaces, where bonds are missing, softening begins earlier: what that costs goes with the surface over the area.
TEST(SofteningBarIn3d, HasTheStrengthThatWasAskedForFarFromItsSurfaces) {
  std::vector<double> strengths;
  for (const int width : {4, 8}) {  // two and four horizons
    const Bar<3> bar{1., width, 5, 2, 1. / 3., 2., Softening::bilinear, 0.25};
    const auto result = pull(bar, bar.specimen(mesh_of(bar)), 0.004, 12);
    EXPECT_NEAR(result.stiffness, 1., 0.02);
    strengths.push_back(result.strength);
  }
  EXPECT_NEAR(strengths[0] / weakness, 0.75, 0.03);
  EXPECT_NEAR(strengths[1] / weakness, 0.87, 0.03);
  EXPECT_NEAR(2. * strengths[1] - strengths[0], weakness, 0.05);
}

TEST(SofteningBarIn3d, TakesTheEnergyThatWasAskedFor) {
  const Bar<3> bar{1., 6, 5, 2, 1. / 3., 2., Softening::bilinear, 0.25};
  const auto result = pull(bar, bar.specimen(mesh_of(bar)), 0.2, 30);
  EXPECT_NEAR(result.energy, 1., 0.1);  // some bonds are missing at its surfaces
  EXPECT_LT(std::abs(result.imbalance), 0.05);
}

}  // namespace
}  // namespace perimorph::tests
