#pragma once

// A run of a specimen that checks after every increment what must hold in any body.

#include <gtest/gtest.h>

#include "support/fracture_body.hpp"

namespace perimorph::tests {

/// After an increment.
struct Row {
  double load_factor, force;  ///< on the pulled group, in the direction watched
  base::GlobalId broken;
  fracture::Energies energies;
  int solves;
  double jump_loss() const {
    return energies.external_work - energies.elastic - energies.dissipated - energies.friction;
  }
};

class WatchedRun {
 public:
  /// @param group, component the reaction that is watched
  WatchedRun(const Specimen& specimen, std::string group, int component)
      : test_(specimen), group_(std::move(group)), component_(component) {}

  /// An increment. Broken bonds and dissipated energy never fall, no energy comes from nothing, supports balance, and
  /// all is finite and bounded.
  const Row& advance(double load_factor) {
    constexpr int most_solves = 3000;
    const Row before = rows.empty() ? Row{} : rows.back();
    const int solves = test_.advance(load_factor);
    const auto& body = test_.body;
    rows.push_back({load_factor, reaction(group_, component_), body.counts().broken_bonds, body.energies(), solves});
    const Row& now = rows.back();
    largest_energy_ = std::max({largest_energy_, std::abs(now.energies.external_work), now.energies.elastic});
    largest_force_ = std::max(largest_force_, std::abs(now.force));
    const double little = 1e-6 * largest_energy_;
    SCOPED_TRACE("load factor " + std::to_string(load_factor));
    EXPECT_GE(now.broken, before.broken);
    EXPECT_GE(now.energies.dissipated, before.energies.dissipated);
    EXPECT_GE(now.energies.elastic, -little);
    EXPECT_GE(now.jump_loss(), before.jump_loss() - little);
    EXPECT_TRUE(std::isfinite(now.force) && std::isfinite(now.energies.external_work));
    EXPECT_LE(solves, most_solves);
    EXPECT_LE(std::abs(reaction("all", component_)), 1e-6 * largest_force_);
    return now;
  }

  void advance_to(double load_factor, int increments) {
    const double start = rows.empty() ? 0. : rows.back().load_factor;
    for (int i = 1; i <= increments; ++i) advance(start + (load_factor - start) * i / increments);
  }

  /// The body has parted: no force, no energy, nothing left to break.
  void expect_severed() const {
    EXPECT_LE(std::abs(rows.back().force), 1e-6 * largest_force_);
    EXPECT_LE(rows.back().energies.elastic, 1e-6 * largest_energy_);
    EXPECT_GT(rows.back().broken, 0);
  }

  /// Force that supports exert on a group of nodes.
  double reaction(const std::string& group, int component) const {
    const auto model = test_.body.model();
    const auto& nodes = test_.mesh.node_sets.at(group);
    double force = 0.;
    for (int n = 0; n < model.dofs.n_owned_nodes(); ++n) {
      const int node = model.dofs.reference_node(n);
      if (std::binary_search(nodes.begin(), nodes.end(), node)) force += test_.body.reaction(n)[component];
    }
    return base::sum(*comm_, force);
  }

  double largest_force() const { return largest_force_; }
  const fracture::Body<2>& body() const { return test_.body; }
  const base::Comm& comm() const { return *comm_; }

  std::vector<Row> rows;

 private:
  Teuchos::RCP<const base::Comm> comm_ = Tpetra::getDefaultComm();
  SpecimenBody test_;
  std::string group_;
  int component_;
  double largest_energy_ = 0., largest_force_ = 0.;
};

}  // namespace perimorph::tests
