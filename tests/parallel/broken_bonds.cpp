// 1, 2 and 4 ranks give the same broken bonds, increment by increment, as one rank alone.

#include <gtest/gtest.h>

#include <Teuchos_DefaultMpiComm.hpp>

#include "support/fracture_body.hpp"

namespace perimorph::tests {
namespace {

using base::GlobalId;

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

/// Broken bonds of all ranks, each told by the rank that owns its first element; on rank 0.
std::vector<Ends> broken_bonds(const base::Comm& comm, const fracture::Body<2>& body) {
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

std::vector<Outcome> run(const Specimen& specimen, const std::vector<double>& load_factors,
                         const Teuchos::RCP<const base::Comm>& comm) {
  TestBody test(specimen, comm);
  std::vector<Outcome> outcomes;
  for (const double factor : load_factors) {
    test.advance(factor);
    const auto& counts = test.body.counts();
    const auto energies = test.body.energies();
    outcomes.push_back({broken_bonds(*comm, test.body), counts.broken_bonds, counts.damaged_elements, counts.dgfe_elements,
                        counts.unknowns, counts.topologies, energies.elastic, energies.dissipated});
  }
  return outcomes;
}

/// A square plate of 24 x 24 elements, pulled apart by top and bottom, with a seed at the tip of its crack.
Specimen plate(const mesh::Mesh<2>& whole, const std::vector<mesh::CrackFacet<2>>& crack, DiscontinuousElements policy) {
  Specimen specimen{whole, 3., 0.2};  // spacing 1
  specimen.pre_cracks = crack;
  specimen.discontinuous = policy;
  specimen.critical_stretch = 0.05;
  specimen.displacements = {{"bottom", "bottom", 1, {-0.1, 0.}}, {"top", "top", 1, {0.1, 0.}},
                            {"hold", "left", 0, {0., 0.}}};
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
  const std::vector<mesh::CrackFacet<2>> crack = {{Point2(8., 10.), Point2(14., 13.)}};
  Specimen specimen = plate(grid({24, 24, 24., 24., Point2::Zero(), 0.15}), crack, policy);
  specimen.seeds = {Zone<2>::box({7., 9.}, {15., 14.}, 6.)};
  specimen.seeds[0].inner_radius = 4.;
  return specimen;
}

class BrokenBonds : public testing::TestWithParam<std::tuple<DiscontinuousElements, bool>> {};

TEST_P(BrokenBonds, AreTheSameOnAnyNumberOfRanks) {
  const auto [policy, oblique] = GetParam();
  const Specimen specimen = oblique ? plate_with_oblique_crack(policy) : plate_with_slit(policy);
  const std::vector<double> load_factors = {1., 2., 3., 4., 5., 6.};
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
    // Solutions agree to the tolerance, 1e-9 of the reaction forces, times a condition number of some thousands.
    EXPECT_NEAR(together[i].elastic, alone[i].elastic, 1e-6 * alone[i].elastic);
    EXPECT_NEAR(together[i].dissipated, alone[i].dissipated, 1e-6 * alone[i].dissipated);
    std::printf("%zu: %zu broken, %lld damaged, %lld dgfe, %lld unknowns, %lld topologies E %g D %g\n", i, alone[i].broken.size(), alone[i].n_damaged, alone[i].n_dgfe, alone[i].unknowns, alone[i].topologies, alone[i].elastic, alone[i].dissipated);
  }
  EXPECT_TRUE(alone.front().broken.empty());
  EXPECT_GT(alone.back().broken.size(), 200u);
}

INSTANTIATE_TEST_SUITE_P(Policies, BrokenBonds,
                         testing::Combine(testing::Values(DiscontinuousElements::whole_zone, DiscontinuousElements::on_damage),
                                          testing::Bool()),
                         [](const auto& p) {
                           const bool whole = std::get<0>(p.param) == DiscontinuousElements::whole_zone;
                           return std::string(whole ? "WholeZone" : "OnDamage") +
                                  (std::get<1>(p.param) ? "ObliqueCrackThroughElements" : "SlitAlongElements");
                         });

}  // namespace
}  // namespace perimorph::tests
