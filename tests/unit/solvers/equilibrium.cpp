// Newton's method with conjugate gradients, on systems small enough to know the answer.

#include "perimorph/solvers/equilibrium.hpp"

#include <gmock/gmock.h>

#include <Teuchos_DefaultComm.hpp>
#include <Tpetra_Core.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>
#include <cmath>
#include <limits>

namespace perimorph::tests {
namespace {

/// Points that each hang on a spring of their own with the force k u + c u^3, pulled by 1; one rank owns each.
class Springs : public operators::NonlinearSystem {
 public:
  static constexpr int n_per_rank = 4;
  double linear, cubic;
  int n_evaluations = 0;

  Springs(double k, double c) : linear(k), cubic(c) {
    const auto comm = Tpetra::getDefaultComm();
    map_ = Teuchos::rcp(new Tpetra::Map<>(n_per_rank * comm->getSize(), 0, comm));
    matrix_ = Teuchos::rcp(new Tpetra::CrsMatrix<double>(map_, 1));
    for (int row = 0; row < n_per_rank; ++row) {
      const auto global = map_->getGlobalElement(row);
      matrix_->insertGlobalValues(global, Teuchos::tuple(global), Teuchos::tuple(linear));
    }
    matrix_->fillComplete();
  }

  void evaluate(base::ConstField u) override {
    force_.assign(u.begin(), u.end());
    for (double& f : force_) f = linear * f + cubic * f * f * f;
    ++n_evaluations;
  }
  Norms residual(Vector& residual) const override {
    const auto values = residual.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (int row = 0; row < n_per_rank; ++row) values(row, 0) = 1. - force_[row];
    return {residual.norm2(), std::sqrt(static_cast<double>(map_->getGlobalNumElements()))};
  }
  void correct(base::Field u, const Vector& correction) override {
    const auto values = correction.getLocalViewHost(Tpetra::Access::ReadOnly);
    for (int row = 0; row < n_per_rank; ++row) u[row] += values(row, 0);
    evaluate(u);
  }
  std::vector<int> prepare_tangent(base::ConstField u) override {
    matrix_->resumeFill();
    for (int row = 0; row < n_per_rank; ++row) {
      matrix_->replaceLocalValues(row, Teuchos::tuple(row), Teuchos::tuple(linear + 3. * cubic * u[row] * u[row]));
    }
    matrix_->fillComplete();
    return {};
  }
  Teuchos::RCP<Operator> tangent() const override { return matrix_; }
  void load_derivative(Vector& derivative) const override { derivative.putScalar(1.); }
  void expand_response(const Vector& x, base::Field response) const override {
    const auto values = x.getLocalViewHost(Tpetra::Access::ReadOnly);
    for (int row = 0; row < n_per_rank; ++row) response[row] = values(row, 0);
  }
  void scale_anchors(double factor) override { anchors *= factor; }
  const Teuchos::RCP<const Tpetra::Map<>>& unknowns() const override { return map_; }
  const Teuchos::RCP<Tpetra::CrsMatrix<double>>& matrix() const { return matrix_; }

  double anchors = 1.;

 private:
  Teuchos::RCP<const Tpetra::Map<>> map_;
  Teuchos::RCP<Tpetra::CrsMatrix<double>> matrix_;
  std::vector<double> force_;
};

class Equilibrium : public testing::Test {
 protected:
  base::Profile profile;
  double force_scale = 0.;
  std::vector<double> u = std::vector<double>(Springs::n_per_rank, 0.);

  static solvers::SolverParameters factorizing() {
    solvers::SolverParameters parameters;
    parameters.muelu.set("multigrid algorithm", "none such");  // a factorization will do
    return parameters;
  }
  solvers::Equilibrium equilibrium{*Tpetra::getDefaultComm(), factorizing(), profile};

  solvers::Equilibrium::Outcome find(Springs& system, double tolerance) {
    const std::vector<Eigen::Vector2d> coordinates(Springs::n_per_rank / 2, Eigen::Vector2d::Zero());
    equilibrium.linear_solver().set_operator(system.tangent(), system.matrix(),
                                             solvers::rigid_body_modes<2>(*system.matrix(), coordinates));
    system.evaluate(base::field(u));
    return equilibrium.find(system, base::field(u), {tolerance, force_scale, true});
  }
};

TEST_F(Equilibrium, TakesOneCorrectionWhereForcesAreLinear) {
  Springs system(4., 0.);

  const auto outcome = find(system, 1e-8);

  EXPECT_TRUE(outcome.converged);
  EXPECT_EQ(outcome.linear_solves, 1);
  for (const double one : u) EXPECT_NEAR(one, 0.25, 1e-8);
}

TEST_F(Equilibrium, CostsNothingWhereForcesBalanceAlready) {
  Springs system(4., 0.);
  u.assign(u.size(), 0.25);

  const auto outcome = find(system, 1e-8);

  EXPECT_TRUE(outcome.converged);
  EXPECT_EQ(outcome.linear_solves, 0);
  EXPECT_EQ(system.n_evaluations, 1);
}

TEST_F(Equilibrium, ConvergesByNewtonsMethodWhereForcesAreNot) {
  Springs system(1., 1.);

  const auto outcome = find(system, 1e-12);

  EXPECT_TRUE(outcome.converged) << outcome.trouble;
  EXPECT_GT(outcome.linear_solves, 2);
  EXPECT_LT(outcome.linear_solves, 8);
  for (const double one : u) EXPECT_NEAR(one + one * one * one, 1., 1e-11);
}

TEST_F(Equilibrium, FindsHowTheDisplacementFollowsTheLoadByTheTangent) {
  Springs system(1., 1.);
  find(system, 1e-12);
  system.prepare_tangent(base::field(u));
  std::vector<double> response(u.size());

  const auto outcome = equilibrium.find_load_response(system, base::field(response), 1e-10);

  EXPECT_TRUE(outcome.converged) << outcome.trouble;
  EXPECT_EQ(outcome.linear_solves, 1);
  for (int i = 0; i < Springs::n_per_rank; ++i) EXPECT_NEAR(response[i], 1. / (1. + 3. * u[i] * u[i]), 1e-9);
}

TEST_F(Equilibrium, SaysThatItDidNotConvergeAndPutsTheAnchorsBack) {
  Springs system(1e-6, 1.);  // the first correction goes a million times too far

  const auto outcome = find(system, 1e-12);

  EXPECT_FALSE(outcome.converged);
  EXPECT_EQ(outcome.linear_solves, 100);
  EXPECT_THAT(outcome.trouble, testing::HasSubstr("the forces do not balance"));
  EXPECT_EQ(system.anchors, 1.);
}

TEST_F(Equilibrium, SaysThatForcesAreNoNumbers) {
  for (const double stiffness : {1e308, std::numeric_limits<double>::infinity(), std::nan("")}) {
    Springs system(stiffness, 1.);
    u.assign(u.size(), 1e10);

    const auto outcome = find(system, 1e-12);

    EXPECT_FALSE(outcome.converged);
    EXPECT_THAT(outcome.trouble, testing::HasSubstr("the forces are no finite numbers"));
  }
}

}  // namespace
}  // namespace perimorph::tests
