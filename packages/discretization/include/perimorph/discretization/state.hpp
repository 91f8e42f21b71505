#pragma once

#include <array>
#include <map>
#include <vector>

#include "perimorph/base/algebra.hpp"
#include "perimorph/bonds/bond_change.hpp"

namespace perimorph::discretization {

/// What has happened to a body, over all ranks.
struct Counts {
  base::GlobalId broken_bonds = 0, damaged_elements = 0, dgfe_elements = 0, unknowns = 0;
  base::GlobalId linear_solves = 0, cg_iterations = 0;  ///< since the load was last changed
  base::GlobalId topologies = 0;                        ///< built since the beginning
};

/// Energies of a body, [energy]: what it stores, what breaking and friction have taken, and what the loads have done.
/// What the last exceeds the others by was lost in brittle jumps.
struct Energies {
  double elastic = 0., dissipated = 0., external_work = 0., friction = 0.;
};

/// Around it the zone has grown, since a bond of the element broke. Growths are counted from 1.
template <int dim>
struct FlagPoint {
  base::GlobalId element, growth;
  std::array<double, dim> centroid;  ///< [length]
};

/// The part of a body's state that is the same on all ranks.
template <int dim>
struct History {
  double load_factor = 0.;
  double load_step = 0.;    ///< from the load factor before [-]
  double force_scale = 0.;  ///< below which reactions say nothing of the load, [force]
  Energies energies;        ///< but for the elastic one, which follows from the displacement
  Counts counts;
  base::GlobalId break_calls = 0;                  ///< how often bonds have been looked at for breaking
  base::GlobalId break_calls_before_topology = 0;  ///< of them, those before the last topology
  std::vector<FlagPoint<dim>> flag_points;         ///< as they came
};

/// Bonds that this rank holds, ascending, by the call in which they broke, from 1.
using BrokenByCall = std::map<base::GlobalId, std::vector<bonds::BondId>>;

/// All that makes a body what it has become: plain data. Zones, alpha, the bonds there are, classes and discontinuous
/// elements follow from it (Topology).
template <int dim>
struct State : History<dim> {
  BrokenByCall broken;
  std::vector<double> displacement;  ///< on all local degrees of freedom of the topology, [length]
  /// Likewise: where supports that begin later than the run have found nodes, zero elsewhere; empty before any has.
  std::vector<double> starts;

  /// The ledger of broken bonds: history, count and energy.
  void take(const bonds::BondChange& change) {
    ++this->break_calls;
    if (!change.broken.empty()) broken[this->break_calls] = change.broken;
    this->counts.broken_bonds += change.n_broken;
    this->energies.dissipated += change.energy;
  }
};

}  // namespace perimorph::discretization
