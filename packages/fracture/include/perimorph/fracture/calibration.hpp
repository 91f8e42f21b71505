#pragma once

#include "perimorph/fracture/problem.hpp"

namespace perimorph::fracture {

/// K / sqrt(E G_c) at which a crack runs between regular elements, the mean over two of them, if the critical stretch
/// follows from the integral (materials::critical_stretch). A crack moves from element to element; it is held up at
/// each, and what the body loses as it breaks free is not in the energy of the bonds. Interpolated between measured
/// values (`tools/studies/work-precision --only fracture`), for characteristic lengths of 0.2 to 0.5 elements; beyond,
/// the value of the nearest of these. Local.
/// @param characteristic_length in element sizes [-]
double lattice_resistance(DiscontinuousElements discontinuous, PeridynamicStiffness stiffness,
                          double characteristic_length);

/// Size of the elements in which cracks start: mean edge in the seeds, of all elements if there are none in them,
/// [length]. Collective.
template <int dim>
double element_size(const base::Comm& comm, const mesh::Mesh<dim>& mesh, const Problem<dim>& problem);

/// Whether a case's critical stretch and fracture energy make up for the lattice's resistance. In three dimensions it
/// is small against the weakness of free faces (tests/verification/fracture_3d.csv); with other than two points per
/// direction it has not been measured for all policies. Local.
bool is_calibrated_to_mesh(const Case& input);

/// If the case is to be, divides the critical stretch by the lattice's resistance, so that a crack runs at
/// K = sqrt(E G_c); where the critical stretch is given, changes the fracture energy accordingly. Returns whether it
/// did. Local.
template <int dim>
bool calibrate_to_mesh(Problem<dim>& problem, const Case& input, double element_size);

}  // namespace perimorph::fracture
