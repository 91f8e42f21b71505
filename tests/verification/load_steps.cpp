// Loads that are held, turned back and repeated, each by an amplitude of its own.

#include <gtest/gtest.h>

#include "support/fracture_body.hpp"

namespace perimorph::tests {
namespace {

using discretization::Amplitude;

Specimen held(const mesh::Mesh<2>& whole) {
  Specimen specimen{whole, 3., 0.3};
  specimen.displacements = {{"hold x", "bottom", 0, {0., 0.}}, {"hold y", "bottom", 1, {0., 0.}}};
  specimen.is_proportional = false;
  return specimen;
}

// ---- an elastic body: its response to each load, added up ----

std::vector<double> displacement_at(const Specimen& specimen, double increment) {
  SpecimenBody test(specimen);
  test.advance(increment);
  const auto u = test.body.displacement();
  return {u.begin(), u.end()};
}

TEST(LoadSteps, EachLoadFollowsItsOwnAmplitude) {
  const auto whole = grid({10, 10, 10., 10., Point2::Zero(), 0.1});
  const Amplitude first({{0., 0.}, {2., 3.}}), second({{0., 0.}, {2., 0.}, {4., -2.}});
  const Point2 on_top(0.3, 1.), on_right(-0.5, 0.2), none = Point2::Zero();
  Specimen both = held(whole), one = held(whole), other = held(whole);
  both.seeds = one.seeds = other.seeds = {Zone<2>::ball({5., 5.}, 3., 6.)};
  both.tractions = {{"top", {on_top, none, &first}}, {"right", {on_right, none, &second}}};
  one.tractions = {{"top", {on_top, none}}};
  other.tractions = {{"right", {on_right, none}}};

  for (const double increment : {1., 3., 4.}) {
    const auto u = displacement_at(both, increment), v = displacement_at(one, first.at(increment)),
               w = displacement_at(other, second.at(increment));
    for (std::size_t dof = 0; dof < u.size(); ++dof) EXPECT_NEAR(u[dof], v[dof] + w[dof], 1e-9);
  }
}

// ---- a crack that is pulled open, released and pulled further ----

Specimen cracked(const Amplitude* amplitude, std::optional<materials::BondLaw> law) {
  mesh::Mesh<2> whole = grid({12, 12, 12., 12.});
  const std::vector<mesh::CrackFacet<2>> slit = {{Point2(-1., 6.), Point2(4., 6.)}};
  mesh::open_along<2>(whole, slit);
  Specimen specimen = held(whole);
  specimen.pre_cracks = slit;
  specimen.seeds = {Zone<2>::everything()};
  specimen.critical_stretch = 0.01;
  specimen.law = law;
  specimen.displacements.push_back({"pull", "top", 1, {0.01, 0., amplitude}});
  return specimen;
}

struct State {
  base::GlobalId broken;
  discretization::Energies energies;
};

State advance(SpecimenBody& test, int increment) {
  test.advance(increment);
  return {test.body.counts().broken_bonds, test.body.energies()};
}

TEST(LoadSteps, WhatIsUnloadedGoesBackToTheOriginAndBreaksOnlyWhenItIsPulledFurther) {
  const Amplitude program({{0., 0.}, {4., 8.}, {6., 0.}, {10., 16.}});  // 8 again in increment 8
  SpecimenBody test(cracked(&program, {})), monotone(cracked(nullptr, {}));
  State pulled{}, straight{};
  for (int k = 1; k <= 4; ++k) pulled = advance(test, k);
  ASSERT_GT(pulled.broken, 50);

  const State half = advance(test, 5), released = advance(test, 6);
  EXPECT_NEAR(half.energies.elastic, 0.25 * pulled.energies.elastic, 1e-6 * pulled.energies.elastic);
  EXPECT_NEAR(released.energies.elastic, 0., 1e-9 * pulled.energies.elastic);
  advance(test, 7);
  const State again = advance(test, 8);
  EXPECT_EQ(again.broken, pulled.broken);
  EXPECT_NEAR(again.energies.elastic, pulled.energies.elastic, 1e-6 * pulled.energies.elastic);
  EXPECT_NEAR(again.energies.external_work, pulled.energies.external_work, 1e-6 * pulled.energies.external_work);

  advance(test, 9);
  const State further = advance(test, 10);
  for (const int load : {2, 4, 6, 8, 12, 16}) {
    monotone.advance(load);
    straight = {monotone.body.counts().broken_bonds, monotone.body.energies()};
  }
  EXPECT_GT(further.broken, pulled.broken);
  EXPECT_EQ(further.broken, straight.broken);
  EXPECT_NEAR(further.energies.dissipated, straight.energies.dissipated, 1e-6 * straight.energies.dissipated);
}

TEST(LoadSteps, SoftenedBondsUnloadToTheOriginTooAndTheEnergyCloses) {
  const auto law = materials::BondLaw::softening(materials::Softening::bilinear, 0.005, 0.0001);
  const Amplitude program({{0., 0.}, {8., 8.}, {10., 0.}, {20., 12.}});
  SpecimenBody test(cracked(&program, law));
  State pulled{};
  for (int k = 1; k <= 8; ++k) pulled = advance(test, k);
  ASSERT_GT(pulled.energies.dissipated, 0.1 * pulled.energies.elastic);

  const State half = advance(test, 9), released = advance(test, 10);
  EXPECT_NEAR(half.energies.elastic, 0.25 * pulled.energies.elastic, 1e-6 * pulled.energies.elastic);
  EXPECT_NEAR(released.energies.elastic, 0., 1e-9 * pulled.energies.elastic);
  EXPECT_EQ(released.energies.dissipated, pulled.energies.dissipated);
  State last{};
  for (int k = 11; k <= 20; ++k) last = advance(test, k);

  EXPECT_GT(last.energies.dissipated, pulled.energies.dissipated);
  const double lost = last.energies.external_work - last.energies.elastic - last.energies.dissipated;
  EXPECT_LT(std::abs(lost), 0.05 * last.energies.dissipated);
}

}  // namespace
}  // namespace perimorph::tests
