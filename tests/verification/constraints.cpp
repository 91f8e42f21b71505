// Supports along any direction, and groups that move as one.

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "perimorph/mesh/sorted_sides.hpp"
#include "perimorph/output/reactions.hpp"
#include "support/fracture_body.hpp"

namespace perimorph::tests {
namespace {

using discretization::RigidGroup;

// ---- along directions ----

/// How a specimen is turned: everything with it.
template <int dim>
using Turn = Eigen::Matrix<double, dim, dim>;

Turn<2> turn_2d() { return Eigen::Rotation2Dd(0.4).toRotationMatrix(); }
Turn<3> turn_3d() { return Eigen::AngleAxisd(0.7, Point3(1., 2., -0.5).normalized()).toRotationMatrix(); }

template <int dim>
void prescribe(SpecimenIn<dim>& specimen, const std::string& group, const base::Point<dim>& direction, double rate,
               double end = std::numeric_limits<double>::infinity()) {
  const std::string name = group + " " + std::to_string(specimen.displacements.size());
  specimen.displacements.push_back({name, group, -1, {rate, 0., nullptr, end}, {direction.begin(), direction.end()}});
}

/// Pulled from its upper end, on rollers at the lower one and at the left: a corner on two of them.
template <int dim>
SpecimenIn<dim> on_rollers(const Turn<dim>& turn, double end_of_guide = std::numeric_limits<double>::infinity()) {
  SpecimenIn<dim> specimen{{}, dim == 2 ? 2.5 : 1.5, 0.3};
  if constexpr (dim == 2) {
    specimen.whole = grid({12, 10, 12., 10., Point2::Zero(), 0.1});
  } else {
    specimen.whole = brick({5, 4, 4, 0.1});
  }
  for (auto& x : specimen.whole.coordinates) x = (turn * x).eval();
  specimen.seeds = {dim == 2 ? Zone<dim>::ball(turn * (base::Point<dim>::Ones() * 5.), 4., 6.)
                             : Zone<dim>::everything()};
  specimen.critical_stretch = 0.02;
  specimen.discontinuous = DiscontinuousElements::whole_zone;
  specimen.tolerance = 1e-11;
  const std::string lower = dim == 2 ? "bottom" : "back", upper = dim == 2 ? "top" : "front";
  prescribe<dim>(specimen, lower, turn.col(dim - 1), 0.);
  prescribe<dim>(specimen, "left", turn.col(0), 0., end_of_guide);
  if (dim == 3) prescribe<dim>(specimen, "bottom", turn.col(1), 0.);
  prescribe<dim>(specimen, upper, turn.col(dim - 1), 0.1);
  prescribe<dim>(specimen, upper, (turn.col(0) + turn.col(dim - 1)).normalized(), 0.1 * std::sqrt(0.5));
  return specimen;
}

/// What does not depend on which way is up.
struct Outcome {
  std::vector<double> elastic, work;
  std::vector<base::GlobalId> broken, iterations;
};

template <int dim>
Outcome pulled(const SpecimenIn<dim>& specimen, const std::vector<double>& loads) {
  SpecimenBodyIn<dim> test(specimen);
  Outcome outcome;
  for (const double load : loads) {
    test.advance(load);
    const auto energies = test.body.energies();
    outcome.elastic.push_back(energies.elastic);
    outcome.work.push_back(energies.external_work);
    outcome.broken.push_back(test.body.counts().broken_bonds);
    outcome.iterations.push_back(test.body.counts().cg_iterations);
  }
  return outcome;
}

/// A turned specimen in turned directions, beside one along the axes. Every other direction is oblique.
template <int dim>
void expect_no_direction(const Turn<dim>& turn, const std::vector<double>& loads) {
  const Turn<dim> none = Turn<dim>::Identity();
  const auto straight = pulled(on_rollers<dim>(none), loads), turned = pulled(on_rollers<dim>(turn), loads);
  EXPECT_EQ(straight.broken.front(), 0);
  EXPECT_GT(straight.broken.back(), 20);
  for (std::size_t i = 0; i < loads.size(); ++i) {
    EXPECT_EQ(turned.broken[i], straight.broken[i]) << "load " << loads[i];
    EXPECT_NEAR(turned.elastic[i], straight.elastic[i], 1e-7 * straight.elastic[i]) << "load " << loads[i];
    EXPECT_NEAR(turned.work[i], straight.work[i], 1e-7 * straight.work[i]) << "load " << loads[i];
  }
  EXPECT_LE(turned.iterations.front(), 1.3 * static_cast<double>(straight.iterations.front()));
  EXPECT_NEAR(straight.work.front(), straight.elastic.front(), 1e-7 * straight.elastic.front());
}

TEST(ObliqueSupports, BreakTheSameBondsWhicheverWayIsUp) { expect_no_direction<2>(turn_2d(), {1., 2., 2.6}); }
TEST(ObliqueSupports, BreakTheSameBondsWhicheverWayIsUpIn3D) { expect_no_direction<3>(turn_3d(), {0.5, 0.65, 0.7}); }

TEST(ObliqueSupports, LetGoAsOthersDo) {
  const std::vector<double> loads = {1., 1.5};
  const auto straight = pulled(on_rollers<2>(Turn<2>::Identity(), 1.), loads);
  const auto turned = pulled(on_rollers<2>(turn_2d(), 1.), loads);
  const auto kept = pulled(on_rollers<2>(turn_2d()), loads);
  for (std::size_t i = 0; i < loads.size(); ++i) {
    EXPECT_NEAR(turned.elastic[i], straight.elastic[i], 1e-7 * straight.elastic[i]);
  }
  EXPECT_LT(turned.elastic[1], 0.999 * kept.elastic[1]);
}

TEST(ObliqueSupports, AreAMistakeWhereTheyDecideTwice) {
  auto specimen = on_rollers<2>(turn_2d());
  prescribe<2>(specimen, "top", Point2(0., 1.), 0.3);
  EXPECT_THROW(SpecimenBody{specimen}, base::UserError);
}

// ---- groups ----

/// A block that is pressed by an inclined traction beside its middle, on a rough base.
template <int dim>
SpecimenIn<dim> pressed(const std::vector<RigidGroup>& groups) {
  SpecimenIn<dim> specimen{{}, dim == 2 ? 2.5 : 1.5, 0.3};
  if constexpr (dim == 2) {
    specimen.whole = grid({12, 10, 12., 10., Point2::Zero(), 0.1});
    specimen.whole.side_sets["top"].resize(4);
    specimen.tractions = {{"top", {Point2(0.3, -1.), Point2::Zero()}}};
  } else {
    specimen.whole = brick({5, 4, 4});
    for (const auto& side : specimen.whole.boundary) {
      const auto middle = mesh::centroid(specimen.whole, side.element);
      const auto nodes = mesh::side_nodes(specimen.whole, side);
      const bool is_at_end =
          std::all_of(nodes.begin(), nodes.end(), [&](int node) { return specimen.whole.coordinates[node][0] == 5.; });
      if (is_at_end && middle[1] < 2.) specimen.whole.side_sets["right"].push_back(side);
    }
    specimen.tractions = {{"right", {Point3(-1., 0.4, 0.2), Point3::Zero()}}};
  }
  specimen.seeds = {Zone<dim>::ball(base::Point<dim>::Ones() * 3., 2., 4.)};
  specimen.discontinuous = DiscontinuousElements::whole_zone;
  specimen.tolerance = 1e-11;
  for (int c = 0; c < dim; ++c) specimen.displacements.push_back({"hold", dim == 2 ? "bottom" : "left", c, {0., 0.}});
  specimen.rigid_groups = groups;
  return specimen;
}

template <int dim>
const char* loaded() {
  return dim == 2 ? "top" : "right";
}

template <int dim>
std::vector<output::Reaction> reactions(SpecimenBodyIn<dim>& test) {
  auto all = output::reactions_of<dim>({loaded<dim>()}, test.problem.rigid_groups);
  output::measure(*Tpetra::getDefaultComm(), 1, test.body, all);
  return all;
}

/// Nothing holds the group: no force is left on it, nor a moment, and what its nodes do is a rigid motion. Whoever
/// prescribes that motion finds the same body.
template <int dim>
void expect_a_rigid_motion() {
  auto specimen = pressed<dim>({{"platen", loaded<dim>()}});
  SpecimenBodyIn<dim> test(specimen);
  test.advance(1.);
  const auto energies = test.body.energies();
  EXPECT_NEAR(energies.external_work, energies.elastic, 1e-8 * energies.elastic);
  const auto moved = reactions(test);
  ASSERT_EQ(moved.size(), dim == 2 ? 3 : 6);
  for (const auto& one : moved) EXPECT_NEAR(one.force, 0., 1e-8) << one.column;
  EXPECT_GT(std::abs(moved.back().displacement), dim == 2 ? 1e-5 : 1e-6);  // it turns

  const auto& nodes = specimen.whole.node_sets.at(loaded<dim>());
  for (const auto& one : moved) {
    specimen.displacements.push_back({one.column, loaded<dim>(), one.component, {one.displacement, 0.}});
  }
  specimen.tractions.clear();
  SpecimenBodyIn<dim> driven(specimen);
  driven.advance(1.);
  EXPECT_NEAR(driven.body.energies().elastic, energies.elastic, 1e-8 * energies.elastic);
  EXPECT_NEAR(driven.body.energies().external_work, energies.elastic, 1e-8 * energies.elastic);

  base::Point<dim> middle = base::Point<dim>::Zero(), mean = middle;
  for (const int n : nodes) middle += specimen.whole.coordinates[n] / static_cast<double>(nodes.size());
  for (int c = 0; c < dim; ++c) mean[c] = moved[c].displacement;
  specimen.rigid_groups.clear();
  specimen.displacements.resize(dim);
  for (const int n : nodes) {
    const std::string name = "node " + std::to_string(n);
    specimen.whole.node_sets[name] = {n};
    base::Point<dim> u = mean;
    for (std::size_t k = dim; k < moved.size(); ++k) {
      const int motion = dim == 2 ? 2 : static_cast<int>(k);
      u += moved[k].displacement *
           discretization::rigid_displacement<dim>(motion, specimen.whole.coordinates[n] - middle);
    }
    for (int c = 0; c < dim; ++c) specimen.displacements.push_back({name, name, c, {u[c], 0.}});
  }
  SpecimenBodyIn<dim> prescribed(specimen);
  prescribed.advance(1.);
  EXPECT_NEAR(prescribed.body.energies().elastic, energies.elastic, 1e-6 * energies.elastic);
  EXPECT_LE(test.body.counts().cg_iterations, 1.3 * static_cast<double>(prescribed.body.counts().cg_iterations) + 3.);
}

TEST(RigidGroup, MovesAsForcesOnItDemand) { expect_a_rigid_motion<2>(); }
TEST(RigidGroup, MovesAsForcesOnItDemandIn3D) { expect_a_rigid_motion<3>(); }

TEST(RigidGroup, TakesTheMomentThatKeepsItFromTurning) {
  auto specimen = pressed<2>({{"platen", "top"}});
  specimen.displacements.push_back({"no turn", "top", 5, {0., 0.}});
  SpecimenBody test(specimen);
  test.advance(1.);
  const auto moved = reactions(test);
  EXPECT_NEAR(moved[0].force, 0., 1e-8);
  EXPECT_NEAR(moved[1].force, 0., 1e-8);
  EXPECT_NEAR(moved[2].displacement, 0., 1e-12);
  EXPECT_GT(std::abs(moved[2].force), 1.);  // a traction of 1 on 4 of 12, 4 beside the middle: up to 16

  specimen.rigid_groups[0].shared_component = 1;  // its nodes are free along it, which makes it give way more
  specimen.displacements.pop_back();
  SpecimenBody level(specimen);
  level.advance(1.);
  EXPECT_GT(level.body.energies().elastic, test.body.energies().elastic);
  const auto& mesh = level.mesh;
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (int n = 0; n < level.body.topology().dofs().n_owned_nodes(); ++n) {
    if (mesh.coordinates[level.body.topology().dofs().reference_node(n)][1] < 10.) continue;
    lowest = std::min(lowest, level.body.displacement()[2 * n + 1]);
    highest = std::max(highest, level.body.displacement()[2 * n + 1]);
  }
  const auto comm = Tpetra::getDefaultComm();
  lowest = -base::max(*comm, -lowest);
  highest = base::max(*comm, highest);
  EXPECT_NEAR(lowest, highest, 1e-12);
  EXPECT_LT(highest, -1e-4);
}

/// A rigid platen on a hinge that moves down pulls the crack open: it breaks, and its share of the zone parts.
TEST(RigidGroup, GoesOnWhereElementsHaveParted) {
  auto specimen = pressed<2>({{"platen", "top", -1, {2., 10.}}});
  specimen.tractions.clear();
  specimen.seeds = {Zone<2>::everything()};
  specimen.critical_stretch = 0.01;
  specimen.discontinuous = DiscontinuousElements::on_damage;
  specimen.displacements.push_back({"pull", "top", 1, {0.01, 0.}});
  SpecimenBody test(specimen);
  double last_energy = 0.;
  for (int k = 1; k <= 14; ++k) {
    test.advance(k);
    const auto energies = test.body.energies();
    EXPECT_LT(energies.elastic + energies.dissipated, 1.0001 * energies.external_work);
    EXPECT_GE(energies.external_work, last_energy);
    last_energy = energies.external_work;
    EXPECT_NEAR(reactions(test)[2].force, 0., 1e-6) << "the hinge is at the group's centre";
  }
  EXPECT_GT(test.body.counts().broken_bonds, 100);
}

TEST(RigidGroup, FollowsAMeasure) {
  auto specimen = pressed<2>({{"platen", "top"}});
  SpecimenBody loaded(specimen);
  loaded.advance(2.);
  const auto moved = reactions(loaded);
  specimen.control = model::MeasureControl<2>{{{"top"}, std::nullopt, Point2(0., -1.)}, {1., 0.}};
  SpecimenBody controlled(specimen);
  controlled.advance(-moved[1].displacement);
  EXPECT_NEAR(controlled.body.load_factor(), 2., 1e-7);
}

TEST(RigidGroup, MayNotShareNodesWithOthers) {
  auto specimen = pressed<2>({{"platen", "top"}, {"side", "right"}});
  EXPECT_THROW(SpecimenBody{specimen}, base::UserError);
  specimen.rigid_groups.pop_back();
  specimen.displacements.push_back({"guide", "right", 0, {0., 0.}});
  EXPECT_THROW(SpecimenBody{specimen}, base::UserError);
}

}  // namespace
}  // namespace perimorph::tests
