// The balance of forces as a list of terms: what a solver sees of it agrees with finite differences and sums.

#include "perimorph/operators/coupled_system.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/coupled_body.hpp"

namespace perimorph::tests {
namespace {

using Vector = Tpetra::Vector<double>;
using discretization::CrackFaces;

constexpr double sticky = 1e9;  // so much friction that nothing slides, where the tangent is exact

/// Irregular elements with a zone and a pre-crack in it, pulled at a side and by a traction and a body force; some of
/// them heated, and every second element expands more.
class CoupledSystem
    : public testing::TestWithParam<std::tuple<operators::OperatorForm, double, CrackFaces, double, bool>> {
 protected:
  static constexpr double load_factor = 2.;
  CoupledBody body{[] {
    tests::Setup setup{{9, 7, 9., 7., Point2::Zero(), 0.15}, 2.2, 0.4, {}};
    setup.zones = {morphing::Zone<2>::ball({4.5, 3.5}, 4.5, 6.)};
    setup.prescribed = {{"hold", "left", 0, {0., 0.}}, {"pull", "left", 1, {0.01, 0.02}}};
    setup.poissons_ratio = std::get<1>(GetParam());
    setup.law = soft_law();
    setup.pre_cracks = {{Point2(4., 2.3), Point2(5.5, 4.6)}};
    setup.crack_faces = std::get<2>(GetParam());
    return setup;
  }()};
  discretization::Loads<2> loads{{{"top", {Point2(0.3, 1.), Point2(0., 0.5)}}}, {Point2(0.1, -0.2), Point2::Zero()}};
  base::Profile profile;
  operators::CoupledSystem<2> system{*body.comm, body.topology, body.dirichlet, loads, {body.elasticity, eigenstrain()},
                                     options(),  profile};
  std::vector<double> u;

  static operators::SystemOptions options() {
    return {
        std::get<0>(GetParam()), operators::PreconditionerMatrix::short_range, 1.2, std::get<3>(GetParam()), {2., 1.}};
  }

  discretization::Eigenstrain<2> eigenstrain() const {
    if (!std::get<4>(GetParam())) return {};
    std::vector<double> expansion;
    for (const auto id : body.mesh.element_ids) expansion.push_back(1e-3 * (1. + id % 2));
    const discretization::Profile<2> slanting{Point2(0.6, 0.8), discretization::PiecewiseLinear({{1., 1.}, {6., -2.}})};
    return {body.mesh, body.points, {{{0.02, 0.3}, {"body"}, slanting}}, expansion};
  }

  /// Of the springs and elements, one by one, over all ranks.
  double stored_energy() const {
    double sum = 0.;
    for (const double energy : operators::element_fields(system.model(), base::field(u), system.at_points()).energy) {
      sum += energy;
    }
    return base::sum(*body.comm, sum);
  }

  void SetUp() override {
    system.follow_morphing();
    system.assemble();
    system.apply_load(load_factor);
    for (int dof = 0; dof < body.dofs->n_nodes() * 2; ++dof) {
      const Point2& x = body.mesh.coordinates[body.dofs->reference_node(dof / 2)];
      u.push_back(0.01 * std::sin(1.3 * x[0] + 0.7 * x[1] + (dof % 2)));
    }
    system.space().expand(base::field(u), load_factor);
    system.evaluate(base::field(u));
  }

  Vector residual() const {
    Vector r(system.unknowns());
    system.residual(r);
    return r;
  }

  Vector product(const Vector& x) const {
    Vector result(system.unknowns());
    system.tangent()->apply(x, result);
    return result;
  }

  /// Of forces on some degrees of freedom, and none on others, from these.
  static double distance(const operators::Window::Forces& forces, const Vector& from) {
    Vector difference(from, Teuchos::Copy);
    for (std::size_t i = 0; i < forces.dofs.size(); ++i) {
      difference.sumIntoLocalValue(forces.dofs[i], -forces.values[i]);
    }
    return difference.norm2();
  }
};

/// Of conjugate gradients' matrix, whose constraints are on the diagonal.
TEST_P(CoupledSystem, WindowIsThePartOfTheTangentThatItsNodesHave) {
  EXPECT_EQ(system.window(), nullptr);  // nothing has happened yet
  system.prepare_tangent(base::field(u));
  system.expect_breaks({4.5, 3.5});
  const auto window = system.window();
  ASSERT_NE(window, nullptr);
  EXPECT_LT(window->unknowns()->getGlobalNumElements(), system.unknowns()->getGlobalNumElements());
  Vector here(window->unknowns()), forces(window->unknowns()), everywhere(system.unknowns());
  here.randomize();
  const auto& nodes = window->nodes();
  const auto values = here.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t i = 0; i < 2 * nodes.size(); ++i) {
    everywhere.replaceLocalValue(nodes[i / 2] * 2 + static_cast<int>(i % 2), values(i, 0));
  }

  window->tangent()->apply(here, forces);

  const Vector all = product(everywhere);
  double error = 0.;
  const auto of_all = all.getLocalViewHost(Tpetra::Access::ReadOnly),
             of_window = forces.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t i = 0; i < 2 * nodes.size(); ++i) {
    error = std::max(error, std::abs(of_all(nodes[i / 2] * 2 + i % 2, 0) - of_window(i, 0)));
  }
  EXPECT_GT(all.norm2(), 0.);
  EXPECT_LT(base::max(*body.comm, error), 1e-6 * all.norm2());  // bonds in single precision
  EXPECT_LT(distance(window->product(everywhere), all), 1e-6 * all.norm2());
}

TEST_P(CoupledSystem, WindowKnowsWhatChangesTheTangent) {
  for (int x = 0; x <= 9; ++x) {
    for (int y = 0; y <= 7; ++y) system.expect_breaks({x, y});
  }
  system.prepare_tangent(base::field(u));
  const auto window = system.window();
  ASSERT_NE(window, nullptr);
  const auto field = Teuchos::rcp(new Vector(system.unknowns()));
  field->randomize();
  for (const int dof : system.space().prescribed()) {
    if (static_cast<std::size_t>(dof) < system.space().n_owned()) field->replaceLocalValue(dof, 0.);
  }
  window->changes({});
  window->note_field(0, *field);
  const Vector before = product(*field);

  system.take(body.soften_each(2, 0.1));
  system.take({body.break_each(3)});
  system.prepare_tangent(base::field(u));

  Vector change = product(*field);
  change.update(-1., before, 1.);
  EXPECT_GT(change.norm2(), 0.);
  EXPECT_LT(distance(window->changes({field}).front(), change), 1e-6 * before.norm2());
  EXPECT_LT(distance(window->changes({field}).front(), Vector(system.unknowns())), 1e-12 * before.norm2());
}

TEST_P(CoupledSystem, TangentIsTheDerivativeOfTheResidual) {
  Vector change(system.unknowns()), product(system.unknowns());
  change.randomize();
  change.scale(1e-6);  // contacts do not close or open on the way
  for (const int dof : system.space().prescribed()) {
    if (static_cast<std::size_t>(dof) < system.space().n_owned()) change.replaceLocalValue(dof, 0.);
  }
  const Vector before = residual();
  EXPECT_EQ(system.at_points().contacts.empty(), std::get<2>(GetParam()) == CrackFaces::free);
  system.prepare_tangent(base::field(u));
  system.tangent()->apply(change, product);

  system.correct(base::field(u), change);

  Vector difference = residual();
  difference.update(-1., before, 1.);
  difference.update(1., product, 1.);
  EXPECT_LT(difference.norm2(), 1e-6 * product.norm2());  // anchors carry no force
}

TEST_P(CoupledSystem, LoadDerivativeIsThatOfTheResidual) {
  Vector derivative(system.unknowns());
  system.prepare_tangent(base::field(u));
  system.load_derivative(derivative);
  const Vector before = residual();

  constexpr double step = 0.5;  // everything is linear in the load
  system.apply_load(load_factor + step);
  system.space().expand(base::field(u), load_factor + step);
  system.evaluate(base::field(u));

  Vector difference = residual();
  difference.update(-1., before, 1.);
  difference.update(-step, derivative, 1.);
  EXPECT_GT(derivative.norm2(), 0.);
  EXPECT_LT(difference.norm2(), 1e-10 * derivative.norm2());
}

TEST_P(CoupledSystem, EnergiesOfTheTermsAddUpToThatOfTheInternalForce) {
  double of_terms = 0.;
  for (const auto& term : system.terms()) of_terms += term->energy(base::field(u));
  of_terms = base::sum(*body.comm, of_terms);
  const double of_force = base::sum(*body.comm, system.elastic_energy(base::field(u)));
  EXPECT_GT(of_terms, 0.);
  EXPECT_NEAR(of_terms, of_force, 1e-12 * of_terms);
}

TEST_P(CoupledSystem, EnergiesOfElementsAddUpToThatOfTheInternalForce) {
  const double stored = stored_energy();
  EXPECT_GT(stored, 0.);
  // Bonds are in single precision.
  EXPECT_NEAR(stored, base::sum(*body.comm, system.elastic_energy(base::field(u))), 1e-6 * stored);
}

TEST_P(CoupledSystem, ForceIsTheDerivativeOfTheEnergy) {
  const double before = stored_energy();
  const auto force = system.internal_force(), u_before = u;
  for (int dof = 0; dof < body.dofs->n_nodes() * 2; ++dof) {
    u[dof] += 1e-7 * std::cos(body.dofs->global_node(dof / 2) + dof % 2);
  }
  system.evaluate(base::field(u));

  double work = 0.;  // energy is of second degree
  for (std::size_t dof = 0; dof < system.space().n_owned(); ++dof) {
    work += 0.5 * (force[dof] + system.internal_force()[dof]) * (u[dof] - u_before[dof]);
  }
  work = base::sum(*body.comm, work);
  EXPECT_NE(work, 0.);
  EXPECT_NEAR(stored_energy() - before, work, 1e-5 * std::abs(work));  // bonds in single precision
}

TEST_P(CoupledSystem, ConfinementIsTheDerivativeOfTheEnergyWithTheEigenstrain) {
  if (!system.eigenstrain().exists()) {
    EXPECT_TRUE(system.confinement(base::field(u)).empty());
    return;
  }
  const double before = stored_energy();
  const auto confinement = system.confinement(base::field(u)), strain = system.eigenstrain().at_points();
  system.apply_load(load_factor + 1e-4);
  system.evaluate(base::field(u));

  double work = 0.;
  const auto after = system.confinement(base::field(u));
  for (std::size_t p = 0; p < after.size(); ++p) {
    work += 0.5 * (confinement[p] + after[p]) * (system.eigenstrain().at_points()[p] - strain[p]);
  }
  work = base::sum(*body.comm, work);
  EXPECT_NE(work, 0.);
  EXPECT_NEAR(stored_energy() - before, work, 1e-5 * std::abs(work));
}

TEST_P(CoupledSystem, ForcesAfterABreakAreThoseOfAFreshEvaluation) {
  system.take(body.soften_each(2, 0.1));
  system.take({body.break_each(3)});
  if (system.breaks_change_more()) {
    EXPECT_FALSE(system.has_forces());
    return;
  }
  const auto updated = system.internal_force();

  system.evaluate(base::field(u));

  double error = 0., size = 0.;
  for (std::size_t dof = 0; dof < updated.size(); ++dof) {
    error = std::max(error, std::abs(updated[dof] - system.internal_force()[dof]));
    size = std::max(size, std::abs(updated[dof]));
  }
  EXPECT_GT(size, 0.);
  EXPECT_LT(error, 1e-6 * size);  // bonds in single precision
}

using operators::OperatorForm;
INSTANTIATE_TEST_SUITE_P(Forms, CoupledSystem,
                         testing::Values(std::tuple(OperatorForm::crs, 1. / 3., CrackFaces::free, 0., false),
                                         std::tuple(OperatorForm::matrix_free, 1. / 3., CrackFaces::free, 0., false),
                                         std::tuple(OperatorForm::matrix_free, 0.2, CrackFaces::free, 0., false),
                                         std::tuple(OperatorForm::crs, 1. / 3., CrackFaces::contact, 0., false),
                                         std::tuple(OperatorForm::matrix_free, 0.2, CrackFaces::contact, 0., false),
                                         std::tuple(OperatorForm::crs, 1. / 3., CrackFaces::contact, sticky, false),
                                         std::tuple(OperatorForm::matrix_free, 1. / 3., CrackFaces::free, 0., true),
                                         std::tuple(OperatorForm::matrix_free, 0.2, CrackFaces::free, 0., true),
                                         std::tuple(OperatorForm::matrix_free, 0.2, CrackFaces::contact, 0., true),
                                         std::tuple(OperatorForm::crs, 1. / 3., CrackFaces::contact, sticky, true)));

}  // namespace
}  // namespace perimorph::tests
