#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "perimorph/base/parallel.hpp"
#include "perimorph/discretization/boundary_conditions.hpp"
#include "perimorph/discretization/eigenstrain.hpp"
#include "perimorph/discretization/measure.hpp"
#include "perimorph/discretization/topology.hpp"
#include "perimorph/materials/bond_materials.hpp"
#include "perimorph/materials/material.hpp"
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

/// A measured displacement that the load factor follows, instead of being prescribed itself.
template <int dim>
struct MeasureControl {
  discretization::MeasuredDisplacement<dim> measured;
  discretization::Ramp<double> value;  ///< by the increment's number, [length]
};

/// What is to be computed, in the terms of the packages that compute it.
template <int dim>
struct Problem {
  std::vector<materials::Material<dim>> materials;  ///< all with one horizon; the first fills what no other does
  std::vector<morphing::Zone<dim>> seeds;
  std::vector<mesh::CrackFacet<dim>> pre_cracks;
  std::vector<discretization::PrescribedComponent> displacements;
  discretization::Loads<dim> loads;
  bool is_proportional;  ///< all loads grow together from zero: with the increment, or by a common amplitude
  std::vector<AutomaticSeed> automatic_seeds = {};
  Calibration calibration = Calibration::analytic;
  discretization::CrackFaces crack_faces = discretization::CrackFaces::free;
  double friction = 0.;                               ///< coefficient, of crack faces in contact [-]
  std::map<std::string, int> material_of_block = {};  ///< place in the list, by the name of a block of the mesh
  std::vector<materials::Interface> interfaces = {};  ///< between any two of the materials
  std::vector<std::shared_ptr<const discretization::Amplitude>> amplitudes = {};  ///< that conditions refer to
  const discretization::Amplitude* common_amplitude = nullptr;  ///< of all loads that are proportional; null: none
  std::optional<MeasureControl<dim>> control = {};              ///< none: the load factor is the increment's number
  std::vector<discretization::RigidGroup> rigid_groups = {};    ///< that displacements may move as a whole
  std::vector<std::string> symmetry_planes = {};  ///< groups on planes beyond which the body goes on as its image
  std::vector<discretization::TemperatureChange<dim>> temperature_changes = {};
  double thickness = 1.;  ///< of a body in two dimensions, which forces and energies are multiplied by, [length]

  /// What an increment prescribes, or a part of one: its load factor [-], or with control what is measured, [length].
  double prescribed_in(double increment) const { return control ? control->value.at(increment) : increment; }

  /// What proportional loads are proportional to, [-].
  double scale_at(double load_factor) const {
    return common_amplitude == nullptr ? load_factor : common_amplitude->at(load_factor);
  }

  bool has_zones() const { return !seeds.empty() || !automatic_seeds.empty(); }
  double horizon() const { return materials[0].micromodulus.horizon; }  ///< [length]
  /// Whether anything can break.
  bool breaks() const;
};

/// The place in the problem's list of each local element's material, (n_elements). Local.
template <int dim>
std::vector<int> materials_of_elements(const mesh::Mesh<dim>& mesh, const Problem<dim>& problem);

/// The problem's materials as the bonds of a mesh see them. Local.
template <int dim>
materials::BondMaterials bond_materials(const mesh::Mesh<dim>& mesh, const Problem<dim>& problem);

/// What material points expand by. Local.
template <int dim>
discretization::Eigenstrain<dim> eigenstrain(const mesh::Mesh<dim>& mesh, const elements::MaterialPoints<dim>& points,
                                             const Problem<dim>& problem);

/// Each rank's part of the mesh, with a halo and images beyond planes of symmetry as the problem needs them.
/// Collective.
/// @param part the mesh, whole on rank 0 or as the ranks have it (mesh::distribute)
/// @param costs of each element that is owned here, in any unit, or empty for equal ones
template <int dim>
mesh::Mesh<dim> distribute_mesh(const base::Comm& comm, const mesh::Mesh<dim>& part, const Problem<dim>& problem,
                                const std::vector<double>& costs = {});

}  // namespace perimorph::model
