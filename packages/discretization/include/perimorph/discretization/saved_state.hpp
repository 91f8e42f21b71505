#pragma once

#include "perimorph/discretization/topology.hpp"

namespace perimorph::discretization {

/// A broken bond by the global ids of its points, and the call in which it broke.
struct BrokenBond {
  base::GlobalId first, second, call;
};

/// A softened bond by the global ids of its points, and its largest stretches, accepted and so far [-].
struct SoftBond {
  base::GlobalId first, second;
  std::array<double, 2> largest_stretches;
};

/// A slip by the global ids of the points between which it is: distance and friction, (2 dim).
template <int dim>
struct SavedSlip {
  base::GlobalId first, second;
  std::array<double, 2 * dim> values;
};

/// One rank's share of a state by global ids, as it goes into a checkpoint or to another partition. From the shares of
/// any number of ranks, any other number of ranks can go on.
template <int dim>
struct SavedState : History<dim> {
  static constexpr int values_per_element = dim << dim;  ///< as many corners as an element can have, dim values each

  std::vector<BrokenBond> broken;     ///< bonds of which this rank owns the first element, as they broke
  std::vector<SoftBond> softened;     ///< unbroken ones, likewise
  std::vector<SavedSlip<dim>> slips;  ///< likewise
  std::vector<double> displacement;   ///< of owned elements, (n_owned_elements, values_per_element), [length]
  std::vector<double> starts;         ///< State::starts likewise; empty if there are none on all ranks
};

/// This rank's share of a state on the topology that follows from it. Local.
template <int dim>
SavedState<dim> save(const State<dim>& state, const Topology<dim>& topology);

/// The broken bonds that this rank holds, out of at least those of which it has the first element, owned or not.
/// Collective. @throws UserError if bonds of the state do not exist in this body.
template <int dim>
BrokenByCall find_broken(const base::Comm& comm, const SavedState<dim>& saved, const Topology<dim>& topology);

/// The softened bonds that this rank holds, likewise. Collective. @throws as above.
template <int dim>
bonds::SofteningHistories find_softened(const base::Comm& comm, const SavedState<dim>& saved,
                                        const Topology<dim>& topology);

/// The slips between points of local elements, likewise. Local.
template <int dim>
bonds::Slips<dim> find_slips(const SavedState<dim>& saved, const Topology<dim>& topology);

/// Displacements on all local degrees of freedom of the topology, [length]. Local.
/// @param saved those of all local elements, as SavedState has them
template <int dim>
std::vector<double> nodal_displacement(const std::vector<double>& saved, const Topology<dim>& topology);

}  // namespace perimorph::discretization
