#pragma once

#include "perimorph/base/parallel.hpp"
#include "perimorph/discretization/boundary_conditions.hpp"
#include "perimorph/fracture/case.hpp"
#include "perimorph/materials/micromodulus.hpp"
#include "perimorph/mesh/pre_crack.hpp"
#include "perimorph/morphing/morphing_field.hpp"

namespace perimorph::fracture {

/// A seed whose place follows from the elastic solution (place_automatic_seeds).
struct AutomaticSeed {
  std::string name;
  double inner_radius, outer_radius;  ///< of each zone, [length]
  double share;                       ///< of the largest strain, that a further zone's place must reach [-]
};

/// A case in the terms of the packages that compute it.
template <int dim>
struct Problem {
  base::Stiffness<dim> e0;
  materials::Micromodulus micromodulus;
  double critical_stretch;  ///< infinite if nothing is to break
  double fracture_energy;   ///< G_c that belongs to it, [energy / area]
  std::vector<morphing::Zone<dim>> seeds;
  std::vector<mesh::CrackFacet<dim>> pre_cracks;
  std::vector<discretization::PrescribedComponent> displacements;
  discretization::Loads<dim> loads;
  bool is_proportional;  ///< all loads grow with the increment from zero
  std::vector<AutomaticSeed> automatic_seeds = {};

  bool has_zones() const { return !seeds.empty() || !automatic_seeds.empty(); }
};

template <int dim>
Problem<dim> make_problem(const Case& input);

/// Reads the case's mesh on rank 0 (a .geo file is meshed by gmsh first, and the mesh kept in the folder), opens it
/// along the pre-cracks and checks the case against it. The mesh is whole on rank 0, empty on others. Collective.
/// @throws UserError, on all ranks.
template <int dim>
mesh::Mesh<dim> read_whole_mesh(const base::Comm& comm, const Case& input, const std::string& folder);

/// Each rank's part of it, with a halo as the problem needs it. Collective.
/// @param costs of each element of the whole mesh (on rank 0), or empty for equal ones
template <int dim>
mesh::Mesh<dim> distribute_mesh(const base::Comm& comm, const mesh::Mesh<dim>& whole, const Problem<dim>& problem,
                                const std::vector<double>& costs = {});

}  // namespace perimorph::fracture
