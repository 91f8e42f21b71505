// The coupled stiffness of a block of hexahedra: both forms agree, six rigid motions cost nothing.

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Teuchos_DefaultComm.hpp>
#include <Tpetra_Core.hpp>
#include <Tpetra_CrsMatrix.hpp>

#include "perimorph/operators/bond_forces.hpp"
#include "perimorph/operators/local_forces.hpp"
#include "perimorph/operators/stiffness_matrix.hpp"
#include "support/meshes.hpp"

namespace perimorph::tests {
namespace {

/// A block whose lower half is peridynamic, blending into classical elasticity above; all elements continuous.
struct Block {
  static constexpr double youngs_modulus = 1000., horizon = 1.2;
  static constexpr auto model = materials::ElasticModel::three_dimensional;
  Teuchos::RCP<const base::Comm> comm = Tpetra::getDefaultComm();
  mesh::Mesh<3> mesh = mesh::distribute(*comm, brick({4, 4, 4}), horizon);
  double poissons_ratio = 0.25;
  base::Stiffness<3> e0 = materials::elasticity_tensor<3>(model, youngs_modulus, poissons_ratio);
  materials::Micromodulus c0 = materials::calibrate<3>(model, youngs_modulus, poissons_ratio, 0.3, horizon);
  elements::MaterialPoints<3> points{mesh};
  morphing::MorphingField<3> alpha{mesh, points, morphing::BlendingFunction::linear};
  bonds::BondFamilies<3> bonds;
  operators::MorphedStiffness<3> elasticity{e0, operators::PeridynamicStiffness::kept,
                                            0.3 * materials::dilatational_ratio(model, poissons_ratio)};
  discretization::Dirichlet<3> dirichlet{*comm, mesh, {}};
  std::vector<char> continuous = std::vector<char>(mesh.n_elements(), 0);
  discretization::DofMap<3> dofs{comm, mesh, discretization::corner_exchange(*comm, mesh), continuous};

  explicit Block(bonds::StiffnessStorage kept = bonds::StiffnessStorage::stored, double ratio = 0.25)
      : poissons_ratio(ratio), bonds(mesh, points, mesh::active_elements(mesh), c0, {}, kept) {
    bonds.extend(alpha.add({morphing::Zone<3>::box(Point3::Zero(), Point3(4., 4., 1.), 2.)}));
    elasticity.update(mesh, points, bonds, alpha,
                      std::vector<morphing::ElementClass>(mesh.n_elements(), morphing::ElementClass::morph),
                      continuous);
  }
  operators::CoupledModel<3> coupled() const { return {mesh, points, bonds, alpha, elasticity, dofs}; }
  discretization::Space<3> space{dofs, dirichlet};
  operators::ForceTerms<3> terms() const {
    return {Teuchos::rcp(new operators::LocalForces<3>(coupled())),
            Teuchos::rcp(new operators::BondForces<3>(coupled()))};
  }
  operators::StiffnessMatrix<3> matrix() const {
    return {coupled(), space, terms(), std::vector<double>(space.n_owned(), 0.)};
  }
};

Eigen::MatrixXd dense(const Tpetra::CrsMatrix<double>& matrix) {
  const auto local = matrix.getLocalMatrixHost();
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(local.numRows(), local.numCols());
  for (int row = 0; row < local.numRows(); ++row) {
    for (auto i = local.graph.row_map(row); i < local.graph.row_map(row + 1); ++i) {
      k(row, local.graph.entries(i)) = local.values(i);
    }
  }
  return k;
}

TEST(BlockIn3d, IsSymmetricAndPositiveWithSixRigidModesAtZeroEnergy) {
  const Block body;
  ASSERT_GT(body.bonds.n_bonds(), 9000u);
  const auto stiffness = body.matrix();
  const Eigen::MatrixXd k = dense(*stiffness.matrix());
  const double largest = k.cwiseAbs().maxCoeff();
  EXPECT_LT((k - k.transpose()).cwiseAbs().maxCoeff(), 1e-13 * largest);

  const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k).eigenvalues();
  EXPECT_LT(eigenvalues.head(6).cwiseAbs().maxCoeff(), 1e-12 * eigenvalues.maxCoeff());
  EXPECT_GT(eigenvalues[6], 1e-4 * eigenvalues.maxCoeff());
}

class StiffnessIn3d : public ::testing::TestWithParam<bonds::StiffnessStorage> {};

TEST_P(StiffnessIn3d, IsTheSameWithoutAMatrix) {
  const Block body(GetParam());
  const auto stiffness = body.matrix();
  std::vector<double> u(3 * body.dofs.n_nodes()), force(u.size(), 0.);
  for (std::size_t i = 0; i < u.size(); ++i) u[i] = std::sin(1.7 * static_cast<double>(i));

  for (const auto& term : body.terms()) term->add_force(base::field(u), base::field(force));

  const auto n = static_cast<Eigen::Index>(u.size());
  const Eigen::VectorXd expected = dense(*stiffness.matrix()) * Eigen::Map<const Eigen::VectorXd>(u.data(), n);
  EXPECT_LT((Eigen::Map<const Eigen::VectorXd>(force.data(), n) - expected).norm(), 1e-13 * expected.norm());
}

/// What the bonds and the dilatation carry is what E(x) has lost, for every Poisson's ratio: a uniform strain is in
/// balance, and costs what it costs in a classical body.
TEST_P(StiffnessIn3d, UniformStrainCostsWhatItCostsInAClassicalBody) {
  for (const double ratio : {-0.3, 0., 0.2, 0.25, 0.4}) {
    const Block body(GetParam(), ratio);
    Eigen::Matrix3d gradient;
    gradient << 1., 0.3, 0., 0.3, -0.2, 0.1, 0., 0.1, 0.5;
    const base::Voigt<3> strain = (base::Voigt<3>() << 1., -0.2, 0.5, 0.2, 0., 0.6).finished();
    std::vector<double> u(3 * body.dofs.n_nodes());
    for (int n = 0; n < body.dofs.n_nodes(); ++n) {
      Eigen::Map<Point3>(u.data() + 3 * static_cast<std::ptrdiff_t>(n)) =
          gradient * body.mesh.coordinates[body.dofs.reference_node(n)];
    }
    double energy = 0.;
    for (const auto& term : body.terms()) energy += term->energy(base::field(u));
    EXPECT_NEAR(energy, 0.5 * 64. * strain.dot(body.e0 * strain), 1e-6 * energy) << ratio;
  }
}

INSTANTIATE_TEST_SUITE_P(Bonds, StiffnessIn3d,
                         ::testing::Values(bonds::StiffnessStorage::stored, bonds::StiffnessStorage::on_the_fly));

}  // namespace
}  // namespace perimorph::tests
