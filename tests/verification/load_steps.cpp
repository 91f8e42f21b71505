// Loads that are held, turned back and repeated, each by an amplitude of its own.

#include <gtest/gtest.h>

#include <algorithm>

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

// ---- increments that are cut ----

TEST(LoadSteps, AnIncrementThatBreaksTooMuchIsHalvedUntilItDoesNot) {
  const Specimen specimen = cracked(nullptr, {});
  fracture::LoopLimits limits = unlimited;
  limits.largest_break = 30;
  fracture::LoopObserver<2> nobody;
  fracture::LoopPosition position;
  auto end = fracture::LoopEnd::cut;
  int n_cuts = -1;
  base::GlobalId broken = 0;
  for (; end == fracture::LoopEnd::cut; ++n_cuts) {
    SpecimenBody test(specimen);
    end = fracture::run_increment(test.body, 8. * position.step.end(), limits, nobody, position);
    broken = test.body.counts().broken_bonds;
  }
  ASSERT_EQ(end, fracture::LoopEnd::done);
  EXPECT_GE(n_cuts, 1);
  EXPECT_LE(broken, 30);
  EXPECT_EQ(position.increment, 1);
  EXPECT_EQ(position.step.begin, std::pow(0.5, n_cuts));

  SpecimenBody direct(specimen);
  direct.advance(8. * position.step.begin);
  EXPECT_EQ(direct.body.counts().broken_bonds, broken);
}

// ---- supports and loads that are let go ----

template <int dim>
double largest_reaction(const SpecimenBodyIn<dim>& test) {
  double largest = 0.;
  for (int n = 0; n < test.body.topology().dofs().n_owned_nodes(); ++n) {
    largest = std::max(largest, test.body.reaction(n).norm());
  }
  return largest;
}

/// Pulled at its top in three increments, and then let go.
template <int dim>
void expect_that_it_comes_to_rest(const mesh::Mesh<dim>& whole, const base::Point<dim>& middle) {
  SpecimenIn<dim> bar{whole, 3., 0.3};
  bar.seeds = {Zone<dim>::ball(middle, 2., 5.)};
  for (int c = 0; c < dim; ++c) bar.displacements.push_back({"hold", "bottom", c, {0., 0.}});
  bar.displacements.push_back({"pull", "top", 1, {0.01, 0., nullptr, 3.}});
  bar.is_proportional = false;
  SpecimenBodyIn<dim> test(bar);
  for (int k = 1; k <= 3; ++k) test.advance(k);
  const auto pulled = test.body.energies();
  const double reaction = largest_reaction(test);
  ASSERT_NEAR(pulled.external_work, pulled.elastic, 1e-6 * pulled.elastic);

  for (int k = 4; k <= 5; ++k) {
    test.advance(k);
    EXPECT_NEAR(test.body.energies().elastic, 0., 1e-9 * pulled.elastic);
    EXPECT_NEAR(test.body.energies().external_work, 0., 1e-6 * pulled.elastic);
    EXPECT_LT(largest_reaction(test), 1e-8 * reaction);
  }
}

TEST(LoadSteps, ABodyWhoseSupportLetsGoComesToRestAndGivesItsEnergyBack) {
  expect_that_it_comes_to_rest<2>(grid({10, 10, 10., 10., Point2::Zero(), 0.1}), {5., 5.});
  expect_that_it_comes_to_rest<3>(brick({4, 8, 4, 0.1}), {2., 4., 2.});
}

TEST(LoadSteps, WithoutItsPropABodyIsAsIfThatHadNeverBeenThere) {
  const auto whole = grid({10, 10, 10., 10., Point2::Zero(), 0.1});
  const Point2 none = Point2::Zero();
  Specimen alone = held(whole);
  alone.seeds = {Zone<2>::ball({5., 5.}, 3., 6.)};
  alone.tractions = {{"right", {Point2(-0.5, 0.2), none}}};
  Specimen propped = alone;
  propped.displacements.push_back({"prop", "top", 1, {0., 0., nullptr, 2.}});
  propped.tractions.push_back({"top", {none, Point2(0.3, 0.), nullptr, 2.}});

  SpecimenBody test(propped);
  for (int k = 1; k <= 3; ++k) test.advance(k);
  const auto u = test.body.displacement();
  const auto expected = displacement_at(alone, 3.);
  for (std::size_t dof = 0; dof < expected.size(); ++dof) EXPECT_NEAR(u[dof], expected[dof], 1e-8);
}

TEST(LoadSteps, ACrackGrowsWhenItsClampLetsGoAndNoEnergyComesFromNothing) {
  const Amplitude pull({{0., 0.}, {4., 4.}});
  Specimen specimen = cracked(nullptr, {});
  specimen.seeds = {Zone<2>::ball({5., 6.}, 5., 5.5)};  // away from where forces act
  auto& sets = specimen.whole.node_sets;
  const auto corner_of = [&](double x, double y) {
    std::vector<int> nodes;
    for (int n = 0; n < specimen.whole.n_nodes(); ++n) {
      if ((specimen.whole.coordinates[n] - Point2(x, y)).norm() < 1e-9) nodes.push_back(n);
    }
    return nodes;
  };
  sets["lower"] = corner_of(0., 0.);
  sets["upper"] = corner_of(0., 12.);
  sets["lower clamp"] = corner_of(3., 0.);
  sets["upper clamp"] = corner_of(3., 12.);
  specimen.displacements = {{"hold x", "right", 0, {0., 0.}},
                            {"hold y", "right", 1, {0., 0.}},
                            {"lower clamp", "lower clamp", 1, {0., 0., nullptr, 4.}},
                            {"upper clamp", "upper clamp", 1, {0., 0., nullptr, 4.}},
                            {"pull down", "lower", 1, {-0.03, 0., &pull}},
                            {"pull up", "upper", 1, {0.03, 0., &pull}}};
  SpecimenBody test(specimen);
  State clamped{};
  for (int k = 1; k <= 4; ++k) clamped = advance(test, k);
  ASSERT_EQ(clamped.broken, 0);

  const State released = advance(test, 5);
  EXPECT_GT(released.broken, 20);
  EXPECT_LT(released.energies.external_work, clamped.energies.external_work);
  EXPECT_GT(released.energies.external_work, released.energies.elastic + released.energies.dissipated);
}

// ---- supports that begin where nodes then are ----

/// Pulled by a traction up to increment 2; then its grip holds it and goes on, and the traction ends.
template <int dim>
SpecimenIn<dim> gripped(const Amplitude& further, DiscontinuousElements discontinuous) {
  SpecimenIn<dim> specimen{{}, dim == 2 ? 2.5 : 1.5, 0.3};
  if constexpr (dim == 2) {
    specimen.whole = grid({12, 10, 12., 10., Point2::Zero(), 0.1});
  } else {
    specimen.whole = brick({4, 4, 3, 0.1});
    for (const auto& side : specimen.whole.boundary) {
      const auto corners = mesh::corner_points(specimen.whole, side);
      const bool is_top = std::all_of(corners.begin(), corners.end(), [](const Point3& x) { return x[1] == 4.; });
      if (is_top) specimen.whole.side_sets["top"].push_back(side);
    }
  }
  specimen.seeds = {Zone<dim>::everything()};
  specimen.discontinuous = discontinuous;
  specimen.tolerance = 1e-11;
  specimen.is_proportional = false;
  for (int c = 0; c < dim; ++c) specimen.displacements.push_back({"hold", "bottom", c, {0., 0.}});
  specimen.displacements.push_back({"grip", "top", 1, {0.02, 0., &further, 1e9, 2.}});
  specimen.tractions = {{"top", {base::Point<dim>::Unit(1), base::Point<dim>::Zero(), nullptr, 2.}}};
  return specimen;
}

template <int dim>
void expect_to_go_on_from_where_it_is(DiscontinuousElements discontinuous) {
  const Amplitude further({{0., 0.}, {3., 0.}, {5., 1.}});
  SpecimenBodyIn<dim> test(gripped<dim>(further, discontinuous));
  test.advance(1.);
  test.advance(2.);
  const auto pulled = test.body.displacement();
  const std::vector<double> before(pulled.begin(), pulled.end());
  const auto energy = test.body.energies();

  test.advance(3.);

  const auto held = test.body.displacement();
  ASSERT_EQ(static_cast<std::size_t>(held.size()), before.size());
  for (std::size_t dof = 0; dof < before.size(); ++dof) EXPECT_NEAR(held[dof], before[dof], 1e-9);
  EXPECT_NEAR(test.body.energies().elastic, energy.elastic, 1e-8 * energy.elastic);
  EXPECT_NEAR(test.body.energies().external_work, energy.external_work, 1e-8 * energy.elastic);

  test.advance(4.);
  test.advance(5.);

  const auto& dofs = test.body.topology().dofs();
  const auto& top = test.body.mesh().node_sets.at("top");
  for (int n = 0; n < dofs.n_owned_nodes(); ++n) {
    if (!std::binary_search(top.begin(), top.end(), dofs.reference_node(n))) continue;
    EXPECT_NEAR(test.body.displacement()[n * dim + 1], before[n * dim + 1] + 0.02, 1e-9);
  }
  EXPECT_NEAR(test.body.energies().external_work, test.body.energies().elastic, 1e-7 * energy.elastic);
  EXPECT_GT(test.body.energies().elastic, energy.elastic);
}

TEST(SupportsThatBeginLater, GoOnFromWhereTheNodesAre) {
  expect_to_go_on_from_where_it_is<2>(DiscontinuousElements::on_damage);
}
TEST(SupportsThatBeginLater, GoOnFromWhereEachNodeIsThatHasParted) {
  expect_to_go_on_from_where_it_is<2>(DiscontinuousElements::whole_zone);
}
TEST(SupportsThatBeginLater, GoOnFromWhereTheNodesAreIn3D) {
  expect_to_go_on_from_where_it_is<3>(DiscontinuousElements::whole_zone);
}

TEST(SupportsThatBeginLater, MayTakeOverFromOthers) {
  const Amplitude pull({{0., 0.}, {2., 2.}}), back({{0., 0.}, {2., 0.}, {4., -2.}});
  auto specimen = held(grid({10, 10, 10., 10., Point2::Zero(), 0.1}));
  specimen.seeds = {Zone<2>::ball({5., 5.}, 3., 6.)};
  specimen.displacements.push_back({"pull", "top", 1, {0.01, 0., &pull, 2.}});
  specimen.displacements.push_back({"back", "top", 1, {0.01, 0., &back, 1e9, 2.}});
  SpecimenBody test(specimen);
  test.advance(2.);
  const double pulled = test.body.energies().elastic;
  test.advance(3.);
  EXPECT_NEAR(test.body.energies().elastic, 0.25 * pulled, 1e-7 * pulled);
  test.advance(4.);
  EXPECT_NEAR(test.body.energies().elastic, 0., 1e-9 * pulled);

  specimen.displacements[2].value.end = 3.;
  EXPECT_THROW(SpecimenBody{specimen}, base::UserError);
}

}  // namespace
}  // namespace perimorph::tests
