#include "perimorph/discretization/boundary_conditions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>

#include "perimorph/base/errors.hpp"
#include "support/meshes.hpp"

namespace perimorph::tests {
namespace {

using discretization::PrescribedComponent;
using discretization::Ramp;
using testing::AllOf;
using testing::HasSubstr;

/// A distorted plate of 3 x 2, triangles or quadrilaterals.
class BoundaryConditions : public testing::TestWithParam<bool> {
 protected:
  Teuchos::RCP<const base::Comm> comm = Tpetra::getDefaultComm();
  mesh::Mesh<2> mesh = distributed_grid(*comm, {9, 8, 3., 2., Point2::Zero(), 0.2, GetParam()}, 0.5);
  elements::MaterialPoints<2> points{mesh};

  discretization::DofMap<2> dofs(bool all_split) const {
    return {comm, mesh, discretization::corner_exchange(*comm, mesh), std::vector<char>(mesh.n_elements(), all_split)};
  }
  std::string error_of(const std::vector<PrescribedComponent>& conditions) const {
    try {
      discretization::Dirichlet<2>(*comm, mesh, conditions);
    } catch (const base::UserError& error) {
      return error.what();
    }
    return "";
  }

  struct Resultant {
    double x, y, moment;
  };
  Resultant resultant(const discretization::Loads<2>& loads, const discretization::DofMap<2>& map,
                      double load_factor) const {
    const auto forces = loads.forces(mesh, points, map, load_factor);
    EXPECT_EQ(forces.size(), 2u * map.n_owned_nodes());
    std::vector<double> sums(3, 0.);
    for (int n = 0; n < map.n_owned_nodes(); ++n) {
      const Point2& x = mesh.coordinates[map.reference_node(n)];
      sums[0] += forces[2 * n];
      sums[1] += forces[2 * n + 1];
      sums[2] += x[0] * forces[2 * n + 1] - x[1] * forces[2 * n];
    }
    base::sum(*comm, sums);
    return {sums[0], sums[1], sums[2]};
  }
};

constexpr double rounding = 1e-12;  // sums of some hundred numbers of order 1 to 10

TEST_P(BoundaryConditions, PrescribedValuesGrowWithTheLoadOnTheNodesOfTheirSetOnly) {
  const discretization::Dirichlet<2> dirichlet(*comm, mesh,
                                               {{"pull", "right", 0, {0.1, 0.5}}, {"hold", "left", 1, {0., 0.}}});
  for (int n = 0; n < mesh.n_nodes(); ++n) {
    const double x = mesh.coordinates[n][0];
    EXPECT_EQ(dirichlet.prescribes(n, 0), x == 3.);
    EXPECT_EQ(dirichlet.prescribes(n, 1), x == 0.);
    EXPECT_DOUBLE_EQ(dirichlet.ramp(n, 0).at(4.), x == 3. ? 0.9 : 0.);
  }
}

TEST_P(BoundaryConditions, WhatEndsIsPrescribedNoMoreUnlessSomethingElseHoldsIt) {
  const double never = Ramp<double>{}.end;
  discretization::Dirichlet<2> dirichlet(
      *comm, mesh, {{"a", "left", 0, {0.1, 0., nullptr, 3.}}, {"b", "top", 0, {0.1, 0., nullptr, never}}});
  EXPECT_FALSE(dirichlet.apply_load(3.));
  for (int n = 0; n < mesh.n_nodes(); ++n) {
    EXPECT_EQ(dirichlet.prescribes(n, 0), mesh.coordinates[n][0] == 0. || mesh.coordinates[n][1] == 2.);
  }
  EXPECT_TRUE(dirichlet.apply_load(4.));
  EXPECT_FALSE(dirichlet.apply_load(5.));
  for (int n = 0; n < mesh.n_nodes(); ++n) EXPECT_EQ(dirichlet.prescribes(n, 0), mesh.coordinates[n][1] == 2.);
}

TEST_P(BoundaryConditions, ALoadThatEndsIsGoneWithItsConstant) {
  const discretization::Loads<2> loads({{"top", {Point2(0.5, -2.), Point2(0.25, 1.), nullptr, 2.}}},
                                       {Point2::Zero(), Point2::Zero()});
  EXPECT_NEAR(resultant(loads, dofs(false), 2.).y, -3. * 3., rounding);
  EXPECT_EQ(resultant(loads, dofs(false), 2.5).y, 0.);
}

TEST_P(BoundaryConditions, ContradictoryDisplacementsOfACommonNodeAreTheUsersMistakeOnAllRanks) {
  const std::string error = error_of({{"pull", "right", 1, {0.1, 0.}}, {"hold", "top", 1, {0., 0.}}});
  EXPECT_THAT(error, AllOf(HasSubstr("\"pull\" and \"hold\" prescribe different values"),
                           HasSubstr("the y displacement"), HasSubstr("the node at (3, 2)")));
}

TEST_P(BoundaryConditions, DirectionsContradictOthersThatDecideThem) {
  const PrescribedComponent x{"x", "top", 0, {0.1, 0.}}, y{"y", "top", 1, {0.3, 0.}};
  const auto along = [](double cx, double cy, double rate) {
    return PrescribedComponent{"along", "right", -1, {rate, 0.}, {cx, cy}};
  };
  EXPECT_EQ(error_of({x, along(0.6, 0.8, 7.)}), "");
  EXPECT_EQ(error_of({x, along(-1., 0., -0.1)}), "");
  EXPECT_EQ(error_of({x, y, along(0.6, 0.8, 0.3)}), "");
  EXPECT_THAT(error_of({x, along(-1., 0., 0.1)}), HasSubstr("the displacement along (-1, 0) of the node at (3, 2)"));
  EXPECT_THAT(error_of({x, y, along(0.6, 0.8, 7.)}), HasSubstr("\"x\" and \"along\" prescribe different values"));
}

TEST_P(BoundaryConditions, ADifferentConstantPartContradictsToo) {
  EXPECT_NE(error_of({{"a", "right", 0, {0.1, 0.}}, {"b", "top", 0, {0.1, 0.2}}}), "");
}

TEST_P(BoundaryConditions, EqualValuesOrOtherComponentsOfACommonNodeAreFine) {
  EXPECT_EQ(error_of({{"a", "right", 0, {0.1, 0.}}, {"b", "top", 0, {0.1, 0.}}, {"c", "top", 1, {0.3, 0.}}}), "");
}

TEST_P(BoundaryConditions, TractionsSumToTheirResultantAtTheMiddleOfTheSide) {
  const discretization::Loads<2> loads(
      {{"top", {Point2(0.5, -2.), Point2(0.25, 1.)}}, {"right", {Point2(3., 0.), Point2::Zero()}}},
      {Point2::Zero(), Point2::Zero()});
  for (const bool split : {false, true}) {
    const auto actual = resultant(loads, dofs(split), 2.);
    // Top: (1.25, -3) over 3, at (1.5, 2). Right: (6, 0) over 2, at (3, 1).
    EXPECT_NEAR(actual.x, 1.25 * 3. + 6. * 2., rounding);
    EXPECT_NEAR(actual.y, -3. * 3., rounding);
    EXPECT_NEAR(actual.moment, 1.5 * -9. - 2. * 3.75 - 1. * 12., rounding);
  }
}

TEST_P(BoundaryConditions, BodyForceSumsToForceTimesAreaAtTheCentroid) {
  const discretization::Loads<2> loads({}, {Point2(0.5, -1.), Point2(0., 0.25)});
  for (const bool split : {false, true}) {
    const auto actual = resultant(loads, dofs(split), 3.);
    EXPECT_NEAR(actual.x, 1.5 * 6., rounding);
    EXPECT_NEAR(actual.y, -2.75 * 6., rounding);
    EXPECT_NEAR(actual.moment, 1.5 * -2.75 * 6. - 1. * 1.5 * 6., rounding);
  }
}

TEST_P(BoundaryConditions, PressuresActAgainstTheBodyAlongItsNormals) {
  const Ramp<Point2> none = {Point2::Zero(), Point2::Zero()};
  const discretization::Loads<2> loads({}, none, {}, {{"top", {0.5, 1.}}, {"right", {1.5, 0.}}});
  for (const bool split : {false, true}) {
    const auto actual = resultant(loads, dofs(split), 2.);
    // Top: (0, -2) over 3, at (1.5, 2). Right: (-3, 0) over 2, at (3, 1).
    EXPECT_NEAR(actual.x, -3. * 2., rounding);
    EXPECT_NEAR(actual.y, -2. * 3., rounding);
    EXPECT_NEAR(actual.moment, 1.5 * -6. + 1. * 6., rounding);
  }
}

TEST_P(BoundaryConditions, APressureAllAroundHasNoResultant) {
  mesh.side_sets["skin"] = mesh.boundary;
  const discretization::Loads<2> loads({}, {Point2::Zero(), Point2::Zero()}, {}, {{"skin", {1., 0.}}});
  const auto actual = resultant(loads, dofs(false), 4.);
  EXPECT_NEAR(actual.x, 0., rounding);
  EXPECT_NEAR(actual.y, 0., rounding);
  EXPECT_NEAR(actual.moment, 0., rounding);
}

class PressureIn3d : public testing::TestWithParam<mesh::ElementType> {};

TEST_P(PressureIn3d, HasNoResultantAllAroundAndItsAreaTimesItselfOnOneFace) {
  const auto comm = Tpetra::getDefaultComm();
  auto mesh = mesh::distribute(*comm, brick({3, 4, 2, 0.2, GetParam()}), 0.5);
  mesh.side_sets["skin"] = mesh.boundary;
  for (const auto& side : mesh.boundary) {
    const auto corners = mesh::corner_points(mesh, side);
    const auto is_on = [](const Point3& x) { return x[0] == 3.; };
    if (std::all_of(corners.begin(), corners.end(), is_on)) mesh.side_sets["right"].push_back(side);
  }
  mesh.side_sets.try_emplace("right");
  const elements::MaterialPoints<3> points(mesh);
  const std::vector<char> whole(mesh.n_elements(), 0);
  const discretization::DofMap<3> dofs(comm, mesh, discretization::corner_exchange(*comm, mesh), whole);
  const auto sum_on = [&](const char* set) {
    const discretization::Loads<3> loads({}, {Point3::Zero(), Point3::Zero()}, {}, {{set, {1., 0.}}});
    const auto forces = loads.forces(mesh, points, dofs, 2.);
    std::vector<double> sums(3, 0.);
    for (std::size_t dof = 0; dof < forces.size(); ++dof) sums[dof % 3] += forces[dof];
    base::sum(*comm, sums);
    return sums;
  };

  for (const double sum : sum_on("skin")) EXPECT_NEAR(sum, 0., rounding);
  const auto on_right = sum_on("right");
  EXPECT_NEAR(on_right[0], -2. * 4. * 2., rounding);
  EXPECT_NEAR(on_right[1], 0., rounding);
  EXPECT_NEAR(on_right[2], 0., rounding);
}

INSTANTIATE_TEST_SUITE_P(Types, PressureIn3d, testing::Values(mesh::ElementType::hex8, mesh::ElementType::tet4));

INSTANTIATE_TEST_SUITE_P(Types, BoundaryConditions, testing::Bool(),
                         [](const auto& p) { return p.param ? "Triangles" : "Quadrilaterals"; });

}  // namespace
}  // namespace perimorph::tests
