// Conjugate gradients with multigrid on the coupled stiffness.

#include "perimorph/solvers/linear_solver.hpp"

#include <gmock/gmock.h>

#include "perimorph/operators/point_basis.hpp"
#include "support/coupled_body.hpp"

namespace perimorph::tests {
namespace {

using solvers::MultiVector;

/// 24 x 20 squares with a zone of discontinuous elements; held at the left unless it is to float.
Setup hybrid(bool held) {
  Setup setup{{24, 20, 24., 20.}, 3., 0.2, {}};
  setup.zones = {morphing::Zone<2>::ball({12., 10.}, 5., 8.)};
  setup.whole_zone_discontinuous = true;
  if (held) setup.prescribed = {{"x", "left", 0, {0., 0.}}, {"y", "left", 1, {0., 0.}}};
  return setup;
}

class LinearSolver : public testing::Test {
 protected:
  CoupledBody body{hybrid(true)};
  base::Profile profile;
  const base::Comm& comm = *Tpetra::getDefaultComm();
  Teuchos::RCP<solvers::Matrix> matrix = body.stiffness->matrix();
  MultiVector b{matrix->getRowMap(), 1}, x{matrix->getRowMap(), 1};

  static solvers::NearNullSpace modes(const CoupledBody& body) {
    return solvers::rigid_body_modes<2>(*body.stiffness->matrix(), body.node_coordinates());
  }

  static void use(solvers::LinearSolver& solver, const CoupledBody& body) {
    solver.set_operator(body.stiffness->matrix(), body.stiffness->matrix(), modes(body));
  }

  void SetUp() override {
    const auto values = b.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (std::size_t i = 0; i < values.extent(0); ++i) {
      values(i, 0) = std::sin(0.37 * static_cast<double>(matrix->getRowMap()->getGlobalElement(static_cast<int>(i))));
    }
  }

  double residual() const {
    MultiVector r(b, Teuchos::Copy);
    matrix->apply(x, r, Teuchos::NO_TRANS, -1., 1.);
    return norm(r);
  }
  static double norm(const MultiVector& v) {
    Teuchos::Array<double> n(1);
    v.norm2(n());
    return n[0];
  }
};

TEST_F(LinearSolver, MovesToAnotherTopologyWithTheSamePreconditioner) {
  auto setup = hybrid(true);
  setup.whole_zone_discontinuous = false;
  const CoupledBody before(setup);
  solvers::LinearSolver moved(comm, {}, profile), fresh(comm, {}, profile);
  use(moved, before);
  MultiVector old_b(before.stiffness->matrix()->getRowMap(), 1), old_x(old_b.getMap(), 1);
  old_b.putScalar(1.);
  moved.solve(old_b, old_x, 1e-6);

  moved.set_operator(matrix, matrix, modes(body), Teuchos::null,
                     operators::weights_of_old_unknowns<2>(body.model(), nullptr, *before.dofs, nullptr));
  use(fresh, body);

  const int iterations = fresh.solve(b, x, 1e-8).iterations;
  EXPECT_LE(moved.solve(b, x, 1e-8).iterations, 1.5 * iterations);
  EXPECT_LE(residual(), 1.01e-8);
}

TEST_F(LinearSolver, ReachesTheTargetResidual) {
  solvers::LinearSolver solver(comm, {}, profile);
  use(solver, body);
  for (const double target : {1e-2, 1e-6, 1e-9}) {
    const int iterations = solver.solve(b, x, target).iterations;

    EXPECT_LE(residual(), 1.01 * target);  // CG's own residual drifts from the true one by rounding
    EXPECT_GT(iterations, 0);
    EXPECT_LT(iterations, 60);  // multigrid works: CASES.md has 9 to 13 for 1e-8
  }
}

TEST_F(LinearSolver, GivesZeroWithoutIterationsForAResidualBelowTheTarget) {
  solvers::LinearSolver solver(comm, {}, profile);
  use(solver, body);
  x.putScalar(3.);

  EXPECT_EQ(solver.solve(b, x, 2. * norm(b)).iterations, 0);
  EXPECT_EQ(norm(x), 0.);
}

TEST_F(LinearSolver, SolvesTheSameMatrixAfterItsValuesChanged) {
  solvers::LinearSolver solver(comm, {}, profile);
  use(solver, body);
  solver.solve(b, x, 1e-8);
  MultiVector before(x, Teuchos::Copy);

  body.stiffness->take({body.break_bonds(body.bonds_across(0, 12., 10.))});
  solver.solve(b, x, 1e-8);
  EXPECT_LE(residual(), 1.01e-8);
  before.update(-1., x, 1.);
  EXPECT_GT(norm(before), 0.01 * norm(x));  // the crack matters

  for (int again = 0; again < 3; ++again) {  // also with a preconditioner that was found aged
    solver.solve(b, x, 1e-8);
    EXPECT_LE(residual(), 1.01e-8);
  }
}

TEST_F(LinearSolver, ANewMatrixReplacesTheOldOne) {
  solvers::LinearSolver solver(comm, {}, profile);
  use(solver, body);
  solver.solve(b, x, 1e-6);
  auto other = hybrid(true);
  other.whole_zone_discontinuous = false;
  const CoupledBody continuous(other);

  use(solver, continuous);
  MultiVector rhs(continuous.stiffness->matrix()->getRowMap(), 1), solution(rhs.getMap(), 1), product(rhs.getMap(), 1);
  rhs.putScalar(1.);
  solver.solve(rhs, solution, 1e-6);

  continuous.stiffness->matrix()->apply(solution, product);
  product.update(-1., rhs, 1.);
  EXPECT_LE(norm(product), 1.01e-6);
}

TEST_F(LinearSolver, AnIndefiniteMatrixIsToldAsSuch) {
  solvers::LinearSolver solver(comm, {}, profile);
  const auto space = modes(body);
  // Half of the body has negative stiffness.
  {
    Tpetra::Vector<double> sign(matrix->getRowMap());
    const auto values = sign.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (std::size_t i = 0; i < values.extent(0); ++i) {
      values(i, 0) = matrix->getRowMap()->getGlobalElement(static_cast<int>(i)) % 4 < 2 ? 1. : -1.;
    }
    matrix->leftScale(sign);
  }
  solver.set_operator(matrix, matrix, space);

  const auto outcome = solver.solve(b, x, 1e-10);

  EXPECT_FALSE(outcome.converged) << "the residual is " << residual();
  EXPECT_THAT(outcome.trouble, testing::HasSubstr("conjugate gradients"));
}

TEST_F(LinearSolver, AFactorizationSolvesWhatMultigridDoesNotSolveInTime) {
  solvers::SolverParameters parameters;
  parameters.max_iterations = 2;
  solvers::LinearSolver solver(comm, parameters, profile);
  use(solver, body);

  for (int again = 0; again < 2; ++again) {
    solver.solve(b, x, 1e-10);
    EXPECT_LE(residual(), 1.01e-10);
  }
  EXPECT_THAT(solver.fallbacks(),
              testing::ElementsAre("the usual multigrid failed (no convergence in 2 iterations); instead a robust one "
                                   "serves, which is slower",
                                   "the robust multigrid failed (no convergence in 2 iterations); instead the matrix "
                                   "is factorized, on one rank"));
}

TEST_F(LinearSolver, AFactorizationSolvesWhereMultigridCannotBeSetUp) {
  solvers::SolverParameters parameters;
  parameters.muelu.set("multigrid algorithm", "none such");
  solvers::LinearSolver solver(comm, parameters, profile);
  use(solver, body);

  solver.solve(b, x, 1e-10);
  EXPECT_LE(residual(), 1.01e-10);
  ASSERT_EQ(solver.fallbacks().size(), 2u);
  EXPECT_THAT(solver.fallbacks()[0],
              testing::AllOf(testing::HasSubstr("failed (the preconditioner could not be set up: "),
                             testing::HasSubstr("multigrid algorithm"), testing::Not(testing::HasSubstr("\n"))));
}

TEST_F(LinearSolver, WhatSolvesAtFirstFallsBackOnNothing) {
  solvers::LinearSolver solver(comm, {}, profile);
  use(solver, body);
  solver.solve(b, x, 1e-10);
  EXPECT_TRUE(solver.fallbacks().empty());
}

TEST_F(LinearSolver, AFactorizationAddsToAScaledVector) {
  const solvers::Factorization factorization(matrix);
  MultiVector product(b.getMap(), 1);
  x.putScalar(3.);

  factorization.apply_inverse()->apply(b, x, Teuchos::NO_TRANS, -2., 0.5);  // 1.5 - 2 A^-1 b

  const auto values = x.getLocalViewHost(Tpetra::Access::ReadWrite);
  for (std::size_t i = 0; i < values.extent(0); ++i) values(i, 0) = (1.5 - values(i, 0)) / 2.;
  matrix->apply(x, product);
  product.update(-1., b, 1.);
  EXPECT_LT(norm(product), 1e-6 * norm(b));  // it is shifted by 1e-11 of the diagonal
}

TEST_F(LinearSolver, AFloatingBodyIsSolvedForForcesInBalance) {
  const CoupledBody floating(hybrid(false));
  solvers::LinearSolver solver(comm, {}, profile);
  use(solver, floating);
  const auto& stiffness = *floating.stiffness->matrix();
  MultiVector shape(stiffness.getRowMap(), 1), load(shape.getMap(), 1), solution(shape.getMap(), 1);
  shape.randomize();
  stiffness.apply(shape, load);  // in the range of a matrix that has rigid motions

  const double target = 1e-8 * norm(load);
  const int iterations = solver.solve(load, solution, target).iterations;
  EXPECT_LT(iterations, 60);
  stiffness.apply(solution, load, Teuchos::NO_TRANS, -1., 1.);
  EXPECT_LE(norm(load), 1.01 * target);
}

TEST_F(LinearSolver, TooFewIterationsEndInAComputationErrorThatSaysSo) {
  solvers::SolverParameters parameters;
  parameters.max_iterations = 2;
  solvers::LinearSolver solver(comm, parameters, profile);
  auto other = hybrid(true);
  other.characteristic_length = 1.;
  const CoupledBody softer(other);  // not near enough to the body to solve in two iterations
  solver.set_operator(matrix, softer.stiffness->matrix(), modes(body));

  const auto outcome = solver.solve(b, x, 1e-10);

  EXPECT_FALSE(outcome.converged) << "the residual is " << residual();
  EXPECT_THAT(outcome.trouble, testing::HasSubstr("within 2 iterations"));
  EXPECT_THAT(outcome.trouble, testing::HasSubstr("a factorization"));
}

TEST_F(LinearSolver, AResidualThatIsNotANumberIsToldAsSuch) {
  solvers::LinearSolver solver(comm, {}, profile);
  use(solver, body);
  b.putScalar(std::nan(""));

  const auto outcome = solver.solve(b, x, 1e-10);

  EXPECT_FALSE(outcome.converged);
  EXPECT_EQ(outcome.trouble, "the residual is not a finite number");
}

TEST(RigidBodyModes, GiveNoForcesOnTheUnconstrainedMatrix) {
  const CoupledBody body(hybrid(false));
  const auto& matrix = *body.stiffness->matrix();

  const auto space = solvers::rigid_body_modes<2>(matrix, body.node_coordinates());

  ASSERT_EQ(space.modes->getNumVectors(), 3u);
  MultiVector forces(space.modes->getMap(), 3);
  matrix.apply(*space.modes, forces);
  Teuchos::Array<double> force(3), motion(3);
  forces.normInf(force());
  space.modes->normInf(motion());
  // The anchors of discontinuous elements: 1e-8 of a diagonal of some times Young's modulus.
  for (int mode = 0; mode < 3; ++mode) EXPECT_LT(force[mode], 1e-7 * CoupledBody::youngs_modulus * motion[mode]);
}

/// MueLu gives up where a mode is zero on all nodes of an aggregate, on that rank alone, and the others wait for it.
TEST(RigidBodyModes, AreZeroAtNoNodeNotEvenOnTheAxisOfARotation) {
  const CoupledBody body(hybrid(false));
  const auto space = solvers::rigid_body_modes<2>(*body.stiffness->matrix(), body.node_coordinates());

  const auto modes = space.modes->getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t node = 0; node < modes.extent(0) / 2; ++node) {
    for (int mode = 0; mode < 3; ++mode) {
      EXPECT_TRUE(modes(2 * node, mode) != 0. || modes(2 * node + 1, mode) != 0.)
          << "node " << node << " mode " << mode;
    }
  }
}

}  // namespace
}  // namespace perimorph::tests
