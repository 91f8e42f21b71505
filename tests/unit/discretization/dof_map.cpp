#include "perimorph/discretization/dof_map.hpp"

#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <map>
#include <set>

#include "support/meshes.hpp"

namespace perimorph::tests {
namespace {

using base::GlobalId;

/// 10 x 8 squares of size 1, some of them split, on all ranks.
class DofMap : public testing::Test {
 protected:
  Teuchos::RCP<const base::Comm> comm = Tpetra::getDefaultComm();
  mesh::Mesh<2> mesh = distributed_grid(*comm, {10, 8, 10., 8.}, 2.5);
  std::vector<char> discontinuous = split(mesh);
  discretization::DofMap<2> dofs{comm, mesh, discretization::corner_exchange(*comm, mesh), discontinuous};

  static bool is_split(const Point2& centroid) { return (centroid - Point2(5., 4.)).norm() < 2.6; }
  static std::vector<char> split(const mesh::Mesh<2>& mesh) {
    std::vector<char> is(mesh.n_elements());
    for (int e = 0; e < mesh.n_elements(); ++e) is[e] = is_split(mesh::centroid(mesh, e));
    return is;
  }

  /// One per reference node with a continuous element, four per split one.
  static GlobalId expected_nodes() {
    const mesh::Mesh<2> whole = grid({10, 8, 10., 8.});
    const auto is = split(whole);
    std::set<int> shared;
    GlobalId n = 0;
    for (int e = 0; e < whole.n_elements(); ++e) {
      if (is[e]) n += 4;
      for (int k = 0; k < 4 && !is[e]; ++k) shared.insert(whole.corners_of(e)[k]);
    }
    return n + static_cast<GlobalId>(shared.size());
  }

  struct Corner {
    GlobalId element;
    int k;
    GlobalId node;
  };
  /// The global node at every corner of every local element, of all ranks.
  std::vector<Corner> all_corners() const {
    std::vector<Corner> own;
    for (int e = 0; e < mesh.n_elements(); ++e) {
      for (int k = 0; k < 4; ++k) own.push_back({mesh.element_ids[e], k, dofs.global_node(dofs.nodes_of(e)[k])});
    }
    return base::gather_on_all(*comm, own);
  }
};

TEST_F(DofMap, HasTheSameNumberOfNodesOnAnyNumberOfRanks) {
  EXPECT_EQ(dofs.n_global_nodes(), expected_nodes());
  EXPECT_GT(dofs.n_global_nodes(), mesh.n_global_nodes);
  EXPECT_EQ(base::sum(*comm, GlobalId{dofs.n_owned_nodes()}), dofs.n_global_nodes());
}

TEST_F(DofMap, GlobalNumbersAreContiguousByRankOwnedNodesFirst) {
  std::vector<GlobalId> owned;
  for (int n = 0; n < dofs.n_owned_nodes(); ++n) owned.push_back(dofs.global_node(n));
  const auto all = base::gather_on_all(*comm, owned);
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i], static_cast<GlobalId>(i));

  const std::set<GlobalId> own(owned.begin(), owned.end());
  for (int n = dofs.n_owned_nodes(); n < dofs.n_nodes(); ++n) EXPECT_EQ(own.count(dofs.global_node(n)), 0u);
}

TEST_F(DofMap, AllCopiesOfACornerAgreeOnItsNode) {
  std::map<std::pair<GlobalId, int>, GlobalId> node_of;
  for (const auto& corner : all_corners()) {
    const auto [entry, is_new] = node_of.try_emplace({corner.element, corner.k}, corner.node);
    EXPECT_EQ(entry->second, corner.node);
  }
  EXPECT_EQ(node_of.size(), 4u * 80u);
}

TEST_F(DofMap, SplitElementsHaveNodesOfTheirOwnAndContinuousOnesShareThem) {
  const mesh::Mesh<2> whole = grid({10, 8, 10., 8.});
  const auto is = split(whole);
  std::map<GlobalId, std::set<GlobalId>> elements_at;  // a node of the topology
  std::map<int, std::set<GlobalId>> shared_nodes_at;   // a node of the reference mesh
  for (const auto& corner : all_corners()) {
    elements_at[corner.node].insert(corner.element);
    if (!is[corner.element])
      shared_nodes_at[whole.corners_of(static_cast<int>(corner.element))[corner.k]].insert(corner.node);
  }
  int n_split_nodes = 0;
  for (const auto& [node, elements] : elements_at) {
    const bool has_split = std::any_of(elements.begin(), elements.end(), [&](GlobalId e) { return is[e] != 0; });
    EXPECT_TRUE(!has_split || elements.size() == 1);
    n_split_nodes += has_split;
  }
  EXPECT_EQ(n_split_nodes, 4 * std::count(is.begin(), is.end(), 1));
  for (const auto& [reference, nodes] : shared_nodes_at) EXPECT_EQ(nodes.size(), 1u);
}

TEST_F(DofMap, EveryNodeStandsOnItsReferenceNodeAndBelongsToThatOnesOwner) {
  for (int e = 0; e < mesh.n_elements(); ++e) {
    for (int k = 0; k < 4; ++k) {
      const int node = dofs.nodes_of(e)[k];
      EXPECT_EQ(dofs.reference_node(node), mesh.corners_of(e)[k]);
      EXPECT_EQ(node < dofs.n_owned_nodes(), mesh.node_owners[mesh.corners_of(e)[k]] == mesh.rank);
    }
  }
}

TEST_F(DofMap, TheImportBringsTheOwnersValuesToAllCopies) {
  Tpetra::Vector<double> owned(dofs.owned_dofs()), all(dofs.all_dofs());
  {
    const auto values = owned.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (int n = 0; n < dofs.n_owned_nodes(); ++n) {
      for (int c = 0; c < 2; ++c) values(2 * n + c, 0) = 2. * static_cast<double>(dofs.global_node(n)) + c;
    }
  }

  all.doImport(owned, *dofs.import(), Tpetra::INSERT);

  const auto values = all.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (int n = 0; n < dofs.n_nodes(); ++n) {
    for (int c = 0; c < 2; ++c) EXPECT_EQ(values(2 * n + c, 0), 2. * static_cast<double>(dofs.global_node(n)) + c);
  }
}

TEST_F(DofMap, WithoutSplitElementsIsTheReferenceMesh) {
  const discretization::DofMap<2> whole(comm, mesh, discretization::corner_exchange(*comm, mesh),
                                        std::vector<char>(mesh.n_elements(), 0));
  EXPECT_EQ(whole.n_global_nodes(), mesh.n_global_nodes);
  EXPECT_EQ(whole.n_owned_nodes(), mesh.n_owned_nodes);
  EXPECT_EQ(whole.n_nodes(), mesh.n_nodes());
}

TEST_F(DofMap, AnElementExchangeOverwritesTheHaloWithTheOwnersValues) {
  std::vector<GlobalId> values(mesh.n_elements(), -1);
  for (int e = 0; e < mesh.n_owned_elements; ++e) values[e] = 7 * mesh.element_ids[e];

  discretization::element_exchange(*comm, mesh).update(values);

  for (int e = 0; e < mesh.n_elements(); ++e) EXPECT_EQ(values[e], 7 * mesh.element_ids[e]);
}

}  // namespace
}  // namespace perimorph::tests
