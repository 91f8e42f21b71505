// What follows from a state: zones, classes, discontinuous elements and numbering; and the state by global ids.

#include "perimorph/discretization/topology.hpp"

#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>

#include "perimorph/base/errors.hpp"
#include "perimorph/discretization/saved_state.hpp"
#include "perimorph/mesh/distribute.hpp"
#include "support/meshes.hpp"

namespace perimorph::tests {
namespace {

using discretization::FlagPoint;
using morphing::ElementClass;

constexpr double horizon = 2.;

/// 20 x 8 squares with a zone around the middle of the left half.
class Topology : public testing::Test {
 protected:
  Teuchos::RCP<const base::Comm> comm = Tpetra::getDefaultComm();
  mesh::Mesh<2> mesh = mesh::distribute(*comm, grid({20, 8, 20., 8.}), horizon);

  using Policy = discretization::DiscontinuousElements;
  discretization::Topology<2> made(Policy policy = Policy::on_damage) const {
    return {comm,
            mesh,
            {{morphing::Zone<2>::ball({5., 4.}, 4., 6.)},
             {},
             materials::Micromodulus{100., 0.4, horizon},
             morphing::BlendingFunction::linear,
             policy,
             2. * horizon,
             4. * horizon}};
  }

  /// Breaks the bonds between the two columns of elements on both sides of x = 5.
  bonds::BondChange crack(const discretization::Topology<2>& topology) const {
    bonds::BondChange change;
    topology.bonds().for_each_bond([&](const bonds::Bond<2>& bond) {
      const double a = mesh::centroid(mesh, bond.first_element)[0], b = mesh::centroid(mesh, bond.second_element)[0];
      if ((a < 5.) != (b < 5.) && std::abs(a - b) < 1.1) change.broken.push_back(bond.id);
    });
    const auto own = std::count_if(change.broken.begin(), change.broken.end(), [&](bonds::BondId b) {
      return topology.bonds().bond(b).first_element < mesh.n_owned_elements;
    });
    change.n_broken = base::sum(*comm, static_cast<base::GlobalId>(own));
    return change;
  }

  base::GlobalId count(const discretization::Topology<2>& topology, ElementClass kind) const {
    const auto end = topology.classes().begin() + mesh.n_owned_elements;
    return base::sum(*comm, static_cast<base::GlobalId>(std::count(topology.classes().begin(), end, kind)));
  }
};

TEST_F(Topology, IsBuiltOnceAndStaysWhileNothingHappens) {
  auto topology = made();
  const auto first = topology.update(topology.grow({}));
  const auto second = topology.update(topology.grow({}));

  EXPECT_TRUE(first.models && first.numbering);
  EXPECT_FALSE(second.models || second.numbering);
  EXPECT_EQ(topology.n_discontinuous(), 0);
  EXPECT_EQ(topology.dofs().n_global_nodes(), 21 * 9);
  EXPECT_GT(count(topology, ElementClass::pd), 0);
  EXPECT_GT(count(topology, ElementClass::fe), 0);
}

TEST_F(Topology, ElementsPartOnceABondOfTheirsBrokeAndTheirNodesStartWhereTheyWere) {
  auto topology = made();
  topology.update(topology.grow({}));
  std::vector<double> u(static_cast<std::size_t>(topology.dofs().n_nodes()) * 2);
  for (std::size_t dof = 0; dof < u.size(); ++dof) {
    u[dof] = mesh.coordinates[topology.dofs().reference_node(static_cast<int>(dof / 2))][dof % 2];
  }
  topology.take(crack(topology));

  const auto change = topology.update(topology.grow({}));

  EXPECT_TRUE(change.numbering);
  EXPECT_GT(topology.n_discontinuous(), 0);
  EXPECT_GT(topology.dofs().n_global_nodes(), 21 * 9);
  const auto carried = topology.carried_over(u);
  for (std::size_t dof = 0; dof < carried.size(); ++dof) {
    EXPECT_EQ(carried[dof], mesh.coordinates[topology.dofs().reference_node(static_cast<int>(dof / 2))][dof % 2]);
  }
}

TEST_F(Topology, ElementsOfWhichNoneMayPartStayTogether) {
  auto topology = made(Policy::never);
  topology.update(topology.grow({}));
  topology.take(crack(topology));

  EXPECT_FALSE(topology.update(topology.grow({})).models);
  EXPECT_EQ(topology.n_discontinuous(), 0);
  EXPECT_EQ(topology.dofs().n_global_nodes(), 21 * 9);
}

TEST_F(Topology, DamagedElementsAreFlaggedOnceAndTheZoneGrowsAroundThem) {
  auto topology = made();
  topology.update(topology.grow({}));
  const auto n_before = count(topology, ElementClass::pd);
  topology.take(crack(topology));
  std::vector<FlagPoint<2>> flags;

  const auto n_flagged = topology.flag_damaged_elements(flags);

  EXPECT_GT(n_flagged, 0);
  EXPECT_EQ(n_flagged, static_cast<base::GlobalId>(flags.size()));
  EXPECT_EQ(topology.flag_damaged_elements(flags), 0);
  EXPECT_TRUE(topology.update(topology.grow(flags)).models);
  EXPECT_GT(count(topology, ElementClass::pd), n_before);
}

TEST_F(Topology, AStateComesBackFromItsShares) {
  auto topology = made();
  topology.update(topology.grow({}));
  discretization::State<2> state;
  state.take(crack(topology));
  topology.take({state.broken.begin()->second});
  topology.update(topology.grow({}));
  for (int dof = 0; dof < topology.dofs().n_nodes() * 2; ++dof) {
    state.displacement.push_back(0.1 * static_cast<double>(topology.dofs().global_node(dof / 2)) + dof % 2);
  }
  const auto share = discretization::save(state, topology);
  // All ranks' shares, as a checkpoint brings them back.
  auto whole = share;
  whole.broken = base::gather_on_all(*comm, share.broken);
  const auto ids = base::gather_on_all(
      *comm, std::vector<base::GlobalId>(mesh.element_ids.begin(), mesh.element_ids.begin() + mesh.n_owned_elements));
  const auto values = base::gather_on_all(*comm, share.displacement);
  constexpr auto stride = static_cast<std::size_t>(discretization::SavedState<2>::values_per_element);
  whole.displacement.clear();
  for (const auto id : mesh.element_ids) {
    const auto place = static_cast<std::size_t>(std::find(ids.begin(), ids.end(), id) - ids.begin());
    whole.displacement.insert(whole.displacement.end(), values.begin() + static_cast<long>(place * stride),
                              values.begin() + static_cast<long>((place + 1) * stride));
  }

  EXPECT_EQ(discretization::find_broken(*comm, whole, topology), state.broken);
  EXPECT_EQ(discretization::nodal_displacement(whole.displacement, topology), state.displacement);
}

TEST_F(Topology, ABondThatIsNotThereIsTheUsersMistake) {
  auto topology = made();
  topology.grow({});
  discretization::SavedState<2> saved;
  saved.counts.broken_bonds = 1;
  saved.broken = {{0, 100000, 1}};
  EXPECT_THROW(discretization::find_broken(*comm, saved, topology), base::UserError);
  saved.softened = {{0, 100000, {0.1, 0.2}}};
  EXPECT_THROW(discretization::find_softened(*comm, saved, topology), base::UserError);
}

TEST_F(Topology, CannotBeUpdatedBeforeItsZonesAreThere) {
  auto topology = made();
  EXPECT_THROW(topology.update(true), base::Bug);
}

}  // namespace
}  // namespace perimorph::tests
