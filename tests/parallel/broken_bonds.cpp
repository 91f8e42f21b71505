// 1, 2 and 4 ranks give the same broken bonds, increment by increment, as one rank alone.

#include <gtest/gtest.h>

#include <Teuchos_DefaultMpiComm.hpp>

#include "support/fracture_body.hpp"

namespace perimorph::tests {
namespace {

using base::GlobalId;
using mesh::ElementType;

/// A bond by the global ids of its points; trivially copyable, so that it can travel.
struct Ends {
  GlobalId first, second;
  bool operator<(const Ends& other) const { return std::tie(first, second) < std::tie(other.first, other.second); }
  bool operator==(const Ends& other) const { return first == other.first && second == other.second; }
};

/// What an increment leaves behind.
struct Outcome {
  std::vector<Ends> broken;  ///< ascending
  GlobalId n_broken, n_damaged, n_dgfe, unknowns, topologies;
  double elastic, dissipated;
};

/// Broken bonds of all ranks, each from the rank that owns its first element; on rank 0.
template <int dim>
std::vector<Ends> broken_bonds(const base::Comm& comm, const fracture::Body<dim>& body) {
  const auto model = body.model();
  std::vector<Ends> own;
  for (int p = 0; p < model.bonds.n_pairs(); ++p) {
    const auto [first, second] = model.bonds.pair(p);
    if (first >= body.mesh().n_owned_elements) continue;
    for (auto b = model.bonds.first_bond(p); b < model.bonds.first_bond(p + 1); ++b) {
      if (!model.bonds.broken(b)) continue;
      own.push_back({model.points.global_id(first, model.bonds.first_end(b)),
                     model.points.global_id(second, model.bonds.second_end(b))});
    }
  }
  auto all = base::gather_on_root(comm, own);
  std::sort(all.begin(), all.end());
  return all;
}

template <int dim>
std::vector<Outcome> run(const SpecimenIn<dim>& specimen, const std::vector<double>& load_factors,
                         const Teuchos::RCP<const base::Comm>& comm) {
  SpecimenBodyIn<dim> test(specimen, comm);
  std::vector<Outcome> outcomes;
  for (const double factor : load_factors) {
    test.advance(factor);
    const auto& counts = test.body.counts();
    const auto energies = test.body.energies();
    outcomes.push_back({broken_bonds(*comm, test.body), counts.broken_bonds, counts.damaged_elements,
                        counts.dgfe_elements, counts.unknowns, counts.topologies, energies.elastic,
                        energies.dissipated});
  }
  return outcomes;
}

/// A square plate of 24 x 24 elements with a crack from its left edge. The two left corners are pulled apart and the
/// right edge is held: the longer the crack, the softer the plate, so that it grows by a little in each increment.
Specimen plate(mesh::Mesh<2> whole, const std::vector<mesh::CrackFacet<2>>& crack, DiscontinuousElements policy) {
  const int n_per_row = 25;
  whole.node_sets["lower corner"] = {0};
  whole.node_sets["upper corner"] = {24 * n_per_row};
  Specimen specimen{whole, 3., 0.2};  // spacing 1
  specimen.pre_cracks = crack;
  specimen.discontinuous = policy;
  specimen.critical_stretch = 0.05;
  specimen.displacements = {{"pull down", "lower corner", 1, {-1., 0.}},
                            {"pull up", "upper corner", 1, {1., 0.}},
                            {"hold x", "right", 0, {0., 0.}},
                            {"hold y", "right", 1, {0., 0.}}};
  specimen.tolerance = 1e-9;
  return specimen;
}

Specimen plate_with_slit(DiscontinuousElements policy) {
  mesh::Mesh<2> whole = grid({24, 24, 24., 24.});
  const std::vector<mesh::CrackFacet<2>> slit = {{Point2(0., 12.), Point2(8., 12.)}};
  mesh::open_along<2>(whole, slit);
  Specimen specimen = plate(whole, slit, policy);
  specimen.seeds = {Zone<2>::ball({8., 12.}, 5., 8.)};
  return specimen;
}

/// The crack cuts through distorted elements at an angle; the zone must hold all of it.
Specimen plate_with_oblique_crack(DiscontinuousElements policy) {
  const std::vector<mesh::CrackFacet<2>> crack = {{Point2(-1., 9.6), Point2(7.3, 13.2)}};
  Specimen specimen = plate(grid({24, 24, 24., 24., Point2::Zero(), 0.15}), crack, policy);
  specimen.seeds = {Zone<2>::box({0., 10.}, {8., 13.5}, 4.)};
  specimen.seeds[0].inner_radius = 4.;
  return specimen;
}

/// A third of the bonds past the critical stretch, the worst, breaks at a time.
Specimen plate_that_breaks_worst_first() {
  Specimen specimen = plate_with_oblique_crack(DiscontinuousElements::on_damage);
  specimen.breaking_fraction = 1. / 3.;
  return specimen;
}

/// Pressed along the crack against the edge that is held.
Specimen plate_under_compression() {
  Specimen specimen = plate_with_oblique_crack(DiscontinuousElements::on_damage);
  specimen.body_force_rate = {8., 0.};
  specimen.compressive_strength = 300.;
  return specimen;
}

struct Example {
  const char* name;
  Specimen specimen;
  std::vector<double> load_factors;  ///< no bond breaks at the first, hundreds until the last
};

std::vector<Example> examples() {
  const auto whole_zone = DiscontinuousElements::whole_zone, on_damage = DiscontinuousElements::on_damage;
  const auto never = DiscontinuousElements::never;
  return {{"WholeZoneSlitAlongElements", plate_with_slit(whole_zone), {0.5, 0.65, 0.75}},
          {"OnDamageSlitAlongElements", plate_with_slit(on_damage), {0.75, 0.82, 0.85}},
          {"WholeZoneObliqueCrackThroughElements", plate_with_oblique_crack(whole_zone), {0.3, 0.5, 0.6}},
          {"OnDamageObliqueCrackThroughElements", plate_with_oblique_crack(on_damage), {0.3, 0.5, 0.6}},
          {"NeverSlitAlongElements", plate_with_slit(never), {0.75, 1.2, 1.5}},
          {"WorstThirdFirst", plate_that_breaks_worst_first(), {0.3, 0.5, 0.6}},
          {"UnderCompression", plate_under_compression(), {0.3, 0.5, 0.7}}};
}

/// A block of 8 x 6 x 2 cubes, or of these cut up, with an edge crack along faces of elements, pulled apart at the
/// cracked side as the plates. Cut up they have more points, and so a shorter horizon.
SpecimenIn<3> block_with_edge_crack(ElementType type) {
  mesh::Mesh<3> whole = brick({8, 6, 2, 0., type});
  const auto crack = mesh::polygon({{0., 3., 0.}, {3., 3., 0.}, {3., 3., 2.}, {0., 3., 2.}});
  mesh::open_along<3>(whole, crack);
  const bool has_many_points = type == ElementType::tet4 || type == ElementType::pyramid5;
  SpecimenIn<3> specimen{whole, has_many_points ? 1.2 : 2., 0.2};
  for (const char* edge : {"bottom", "top"}) {
    auto& nodes = specimen.whole.node_sets[edge];
    nodes.erase(std::remove_if(nodes.begin(), nodes.end(), [&](int n) { return whole.coordinates[n][0] > 0.5; }),
                nodes.end());
  }
  specimen.pre_cracks = crack;
  specimen.seeds = {Zone<3>::cylinder({3., 3., 0.}, {3., 3., 2.}, 3.2, 5.)};
  specimen.critical_stretch = 0.05;
  specimen.displacements = {{"pull down", "bottom", 1, {-1., 0.}},
                            {"pull up", "top", 1, {1., 0.}},
                            {"hold x", "right", 0, {0., 0.}},
                            {"hold y", "right", 1, {0., 0.}},
                            {"hold z", "right", 2, {0., 0.}}};
  specimen.tolerance = 1e-9;
  return specimen;
}

template <int dim>
void expect_the_same_on_all_ranks(const SpecimenIn<dim>& specimen, const std::vector<double>& load_factors,
                                  std::size_t least_broken) {
  const auto everyone = Tpetra::getDefaultComm();

  const auto together = run(specimen, load_factors, everyone);
  if (everyone->getRank() != 0) return;
  const auto alone = run(specimen, load_factors, Teuchos::rcp(new Teuchos::MpiComm<int>(MPI_COMM_SELF)));

  for (std::size_t i = 0; i < alone.size(); ++i) {
    SCOPED_TRACE("increment " + std::to_string(i + 1));
    EXPECT_EQ(together[i].broken, alone[i].broken);
    EXPECT_EQ(together[i].n_broken, static_cast<GlobalId>(together[i].broken.size()));
    EXPECT_EQ(together[i].n_damaged, alone[i].n_damaged);
    EXPECT_EQ(together[i].n_dgfe, alone[i].n_dgfe);
    EXPECT_EQ(together[i].unknowns, alone[i].unknowns);
    EXPECT_EQ(together[i].topologies, alone[i].topologies);
    // Solutions agree to the tolerance, 1e-9 of the reaction forces, times a condition number of some hundreds.
    EXPECT_NEAR(together[i].elastic, alone[i].elastic, 1e-6 * alone[i].elastic);
    EXPECT_NEAR(together[i].dissipated, alone[i].dissipated, 1e-6 * alone[i].dissipated);
  }
  EXPECT_TRUE(alone.front().broken.empty());
  EXPECT_GT(alone.back().broken.size(), least_broken);
  EXPECT_GT(alone.back().topologies, alone.front().topologies + 1);
}

class BrokenBonds : public testing::TestWithParam<Example> {};

TEST_P(BrokenBonds, AreTheSameOnAnyNumberOfRanks) {
  expect_the_same_on_all_ranks(GetParam().specimen, GetParam().load_factors, 200);
}

TEST(BrokenBondsIn3d, OfHexahedraAreTheSameOnAnyNumberOfRanks) {
  expect_the_same_on_all_ranks(block_with_edge_crack(ElementType::hex8), {0.2, 0.5, 0.6}, 100);
}

TEST(BrokenBondsIn3d, WithACompressiveStrengthAreTheSameOnAnyNumberOfRanks) {
  auto specimen = block_with_edge_crack(ElementType::hex8);
  specimen.body_force_rate = {8., 0., 0.};
  specimen.compressive_strength = 300.;
  expect_the_same_on_all_ranks(specimen, {0.2, 0.5, 0.7}, 100);
}

TEST(BrokenBondsIn3d, OfTetrahedraAreTheSameOnAnyNumberOfRanks) {
  expect_the_same_on_all_ranks(block_with_edge_crack(ElementType::tet4), {0.1, 0.3, 0.4}, 100);
}

TEST(BrokenBondsIn3d, OfHexahedraAndWedgesAreTheSameOnAnyNumberOfRanks) {
  expect_the_same_on_all_ranks(block_with_edge_crack(ElementType::wedge6), {0.2, 0.5, 0.6}, 100);
}

TEST(BrokenBondsIn3d, OfPyramidsAreTheSameOnAnyNumberOfRanks) {
  expect_the_same_on_all_ranks(block_with_edge_crack(ElementType::pyramid5), {0.1, 0.3, 0.4}, 100);
}

INSTANTIATE_TEST_SUITE_P(Plates, BrokenBonds, testing::ValuesIn(examples()),
                         [](const auto& example) { return std::string(example.param.name); });

}  // namespace
}  // namespace perimorph::tests
