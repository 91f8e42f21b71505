#pragma once

#include <string>
#include <vector>

#include "perimorph/base/parallel.hpp"
#include "perimorph/discretization/boundary_conditions.hpp"
#include "perimorph/materials/micromodulus.hpp"
#include "perimorph/mesh/mesh.hpp"
#include "perimorph/mesh/pre_crack.hpp"
#include "perimorph/morphing/morphing_field.hpp"

namespace perimorph::model {

/// A seed whose place follows from the elastic solution.
struct AutomaticSeed {
  std::string name;
  double inner_radius, outer_radius;  ///< of each zone, [length]
  double share;                       ///< of the largest strain, that a further zone's place must reach [-]
};

/// How critical stretch and fracture energy belong together: by the integral over the micromodulus, or so that a crack
/// runs at K = sqrt(E G_c) on this mesh (calibration.hpp).
enum class Calibration { analytic, mesh_consistent };

/// What is to be computed, in the terms of the packages that compute it.
template <int dim>
struct Problem {
  base::Stiffness<dim> e0;    ///< [stress]
  double dilatational_ratio;  ///< kappa / mu of E0 (materials::dilatational_ratio), [-]; 0: bonds alone carry
  materials::Micromodulus micromodulus;
  double critical_stretch;  ///< infinite if nothing is to break [-]
  double fracture_energy;   ///< G_c that belongs to it, [energy / area]
  std::vector<morphing::Zone<dim>> seeds;
  std::vector<mesh::CrackFacet<dim>> pre_cracks;
  std::vector<discretization::PrescribedComponent> displacements;
  discretization::Loads<dim> loads;
  bool is_proportional;  ///< all loads grow with the increment from zero
  std::vector<AutomaticSeed> automatic_seeds = {};
  Calibration calibration = Calibration::analytic;
  bool is_stretch_given = false;  ///< and the fracture energy follows from it; otherwise the other way round

  bool has_zones() const { return !seeds.empty() || !automatic_seeds.empty(); }
};

/// Each rank's part of the mesh, with a halo as the problem needs it. Collective.
/// @param whole the mesh, on rank 0
/// @param costs of each element of the whole mesh (on rank 0), in any unit, or empty for equal
///        ones
template <int dim>
mesh::Mesh<dim> distribute_mesh(const base::Comm& comm, const mesh::Mesh<dim>& whole, const Problem<dim>& problem,
                                const std::vector<double>& costs = {});

}  // namespace perimorph::model
