// From unknowns to displacements at all nodes of a rank, and back: on every number of ranks.

#include "perimorph/discretization/space.hpp"

#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>
#include <Tpetra_Vector.hpp>

#include "perimorph/base/errors.hpp"
#include "perimorph/mesh/distribute.hpp"
#include "support/meshes.hpp"

namespace perimorph::tests {
namespace {

class Space : public testing::Test {
 protected:
  Teuchos::RCP<const base::Comm> comm = Tpetra::getDefaultComm();
  mesh::Mesh<2> mesh = mesh::distribute(*comm, grid({7, 5, 7., 5.}), 1.5);
  std::vector<char> discontinuous = std::vector<char>(mesh.n_elements(), 0);
  discretization::DofMap<2> dofs{comm, mesh, discretization::corner_exchange(*comm, mesh), discontinuous};
  discretization::Dirichlet<2> dirichlet{*comm, mesh, {{"pull", "left", 0, {0.5, 2.}}}};
  discretization::Space<2> space{dofs, dirichlet};

  Point2 place(int dof) const { return mesh.coordinates[dofs.reference_node(dof / 2)]; }
  /// A number for each degree of freedom, the same on all ranks.
  double value(int dof) const { return place(dof)[0] + 10. * place(dof)[1] + 100. * (dof % 2); }
  bool is_pulled(int dof) const { return place(dof)[0] == 0. && dof % 2 == 0; }
};

TEST_F(Space, CopiesFromOwnersAndSetsWhatIsPrescribed) {
  std::vector<double> u(space.n_local(), -1.);
  for (std::size_t dof = 0; dof < space.n_owned(); ++dof) u[dof] = value(static_cast<int>(dof));

  space.expand(base::field(u), 3.);

  for (int dof = 0; dof < static_cast<int>(space.n_local()); ++dof) {
    EXPECT_EQ(u[dof], is_pulled(dof) ? 3.5 : value(dof));
    EXPECT_EQ(space.is_constrained(dof), is_pulled(dof));
  }
}

TEST_F(Space, AChangeIsZeroWhereTheDisplacementIsPrescribed) {
  discretization::Space<2>::Vector x(dofs.owned_dofs());
  {
    const auto values = x.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (std::size_t dof = 0; dof < space.n_owned(); ++dof) values(dof, 0) = value(static_cast<int>(dof));
  }

  const auto change = space.expand_change(x);

  ASSERT_EQ(static_cast<std::size_t>(change.size()), space.n_local());
  for (int dof = 0; dof < change.size(); ++dof) EXPECT_EQ(change[dof], is_pulled(dof) ? 0. : value(dof));
}

TEST_F(Space, ForcesActOnUnknownsOnly) {
  std::vector<double> forces(space.n_local(), 7.);

  space.restrict_forces(base::field(forces));

  for (std::size_t dof = 0; dof < forces.size(); ++dof)
    EXPECT_EQ(forces[dof], is_pulled(static_cast<int>(dof)) ? 0. : 7.);
}

TEST_F(Space, KnowsHowFastWhatIsPrescribedMoves) {
  const auto rates = space.prescribed_rates(3., 1.);
  for (std::size_t dof = 0; dof < rates.size(); ++dof)
    EXPECT_EQ(rates[dof], is_pulled(static_cast<int>(dof)) ? 0.5 : 0.);
}

TEST_F(Space, RefusesAFieldOfAnotherSize) {
  std::vector<double> too_short(space.n_local() - 1);
  EXPECT_THROW(space.expand(base::field(too_short), 1.), base::Bug);
}

}  // namespace
}  // namespace perimorph::tests
