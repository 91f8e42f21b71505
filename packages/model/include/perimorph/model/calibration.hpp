#pragma once

#include "perimorph/model/numerical_options.hpp"
#include "perimorph/model/problem.hpp"

namespace perimorph::model {

/// K / sqrt(E G_c) at which a crack runs between regular elements, the mean over two of them, if the critical stretch
/// follows from the integral (materials::critical_stretch). A crack moves from element to element; it is held up at
/// each, and what the body loses as it breaks free is not in the energy of the bonds. Interpolated between measured
/// values (`tools/studies/work-precision --only fracture`), for characteristic lengths of 0.2 to 0.5 elements; beyond,
/// the value of the nearest of these. What dilatation changes of it was measured with a third of an element. Local.
/// @param discontinuous not never
/// @param characteristic_length in element sizes [-]
/// @param dilatational_ratio kappa / mu (materials::dilatational_ratio), [-]
double lattice_resistance(discretization::DiscontinuousElements discontinuous,
                          operators::PeridynamicStiffness stiffness, double characteristic_length,
                          double dilatational_ratio = 0.);

/// Size of the elements in which cracks start: mean edge in the seeds, of all elements if there are none in them,
/// [length]. Collective.
template <int dim>
double element_size(const base::Comm& comm, const mesh::Mesh<dim>& mesh, const Problem<dim>& problem);

/// Whether critical stretch and fracture energy make up for the lattice's resistance. In three dimensions it is small
/// against the weakness of free faces (tests/verification/fracture_3d.csv); with other than two points per direction
/// it has not been measured for all policies; and where elements never part it is no property of the lattice alone.
/// Local.
bool is_calibrated_to_mesh(Calibration calibration, int dimension, const NumericalOptions& options);

/// If the problem is to be calibrated to the mesh, divides critical stretches by the lattice's resistance, so that a
/// crack runs at K = sqrt(E G_c); where the critical stretch is given, changes the fracture energy accordingly. Returns
/// whether it did. Local.
/// @param element_size where cracks start, [length]
template <int dim>
bool calibrate_to_mesh(Problem<dim>& problem, const NumericalOptions& options, double element_size);

}  // namespace perimorph::model
