#pragma once

// A breaking body made in memory, without a case file, and the adaptive loop over it without results.

#include <Tpetra_Core.hpp>
#include <optional>

#include "perimorph/fracture/adaptive_loop.hpp"
#include "perimorph/mesh/distribute.hpp"
#include "perimorph/mesh/images.hpp"
#include "perimorph/model/numerical_options.hpp"
#include "perimorph/model/problem.hpp"
#include "support/meshes.hpp"

namespace perimorph::tests {

using discretization::DiscontinuousElements;
using morphing::Zone;
using operators::PeridynamicStiffness;

/// What a test says of a body; in 2D of unit thickness.
template <int dim>
struct SpecimenIn {
  mesh::Mesh<dim> whole;  ///< used on rank 0
  double horizon, characteristic_length;
  std::vector<Zone<dim>> seeds = {};
  std::vector<discretization::PrescribedComponent> displacements = {};
  DiscontinuousElements discontinuous = DiscontinuousElements::on_damage;
  PeridynamicStiffness peridynamic_stiffness = PeridynamicStiffness::dropped;
  double critical_stretch = std::numeric_limits<double>::infinity();
  std::vector<mesh::CrackFacet<dim>> pre_cracks = {};
  std::vector<discretization::SurfaceTraction<dim>> tractions = {};
  std::vector<discretization::SurfacePressure> pressures = {};
  base::Point<dim> body_force_rate = base::Point<dim>::Zero();
  bool is_proportional = true;
  double tolerance = 1e-10;  ///< residual over reaction forces
  double youngs_modulus = 1000.;
  materials::ElasticModel elastic_model =
      dim == 2 ? materials::ElasticModel::plane_stress : materials::ElasticModel::three_dimensional;
  double breaking_fraction = 1.;   ///< share of the overstretched bonds that break between two solves
  std::vector<double> costs = {};  ///< of elements, by which they are parted among the ranks; equal if there are none
  int points_per_direction = 2;
  std::optional<double> poissons_ratio = {};  ///< none: what bonds alone have
  morphing::BlendingFunction blending_function = morphing::BlendingFunction::linear;
  std::optional<materials::BondLaw> law = {};          ///< none: brittle, at the critical stretch
  std::vector<materials::Material<dim>> others = {};   ///< beside the body's
  std::map<std::string, int> material_of_block = {};   ///< 1: the first of the others
  std::optional<materials::Toughness> interface = {};  ///< between any two materials; none: perfect
  std::optional<model::MeasureControl<dim>> control = {};
  discretization::CrackFaces crack_faces = discretization::CrackFaces::free;
  double friction = 0.;  ///< coefficient
  std::vector<discretization::RigidGroup> rigid_groups = {};
  std::optional<double> compressive_strength = {};  ///< none: that of bonds which break by their stretch alone
  double thermal_expansion = 0.;                    ///< of the body's material, as data sheets give it
  std::vector<discretization::TemperatureChange<dim>> temperature_changes = {};
  std::vector<std::string> symmetry_planes = {};  ///< groups
  double window_radius = 0.;                      ///< of windows of any share; 0: none
};
using Specimen = SpecimenIn<2>;

template <int dim>
model::Problem<dim> make_problem(const SpecimenIn<dim>& specimen) {
  const auto model = specimen.elastic_model;
  const double youngs_modulus = specimen.youngs_modulus;
  const double poissons_ratio = specimen.poissons_ratio.value_or(materials::bond_based_poissons_ratio(model));
  auto material = materials::elastic_material<dim>(model, youngs_modulus, poissons_ratio,
                                                   specimen.characteristic_length, specimen.horizon);
  material.thermal_expansion = specimen.thermal_expansion * materials::expansion_factor(model, poissons_ratio);
  const materials::BondLaw law = specimen.law.value_or(specimen.critical_stretch);
  material.toughness = {law, materials::fracture_energy<dim>(material.micromodulus, std::sqrt(2. * law.area()),
                                                             material.dilatational_ratio)};
  material.compressive_strength = specimen.compressive_strength;
  std::vector<materials::Material<dim>> all = {std::move(material)};
  all.insert(all.end(), specimen.others.begin(), specimen.others.end());
  std::vector<materials::Interface> interfaces;
  for (int m = 0; m < static_cast<int>(all.size()); ++m) {
    for (int n = m + 1; n < static_cast<int>(all.size()); ++n) {
      interfaces.push_back({m, n, specimen.interface.value_or(materials::perfect_interface(all[m], all[n]))});
    }
  }
  model::Problem<dim> problem{
      std::move(all),
      specimen.seeds,
      specimen.pre_cracks,
      specimen.displacements,
      discretization::Loads<dim>(specimen.tractions, {specimen.body_force_rate, base::Point<dim>::Zero()}, {},
                                 specimen.pressures),
      specimen.is_proportional};
  problem.material_of_block = specimen.material_of_block;
  problem.interfaces = std::move(interfaces);
  problem.control = specimen.control;
  problem.crack_faces = specimen.crack_faces;
  problem.friction = specimen.friction;
  problem.rigid_groups = specimen.rigid_groups;
  problem.temperature_changes = specimen.temperature_changes;
  return problem;
}

template <int dim>
model::NumericalOptions make_options(const SpecimenIn<dim>& specimen) {
  model::NumericalOptions options;
  options.blending_function = specimen.blending_function;
  options.discontinuous = specimen.discontinuous;
  options.peridynamic_stiffness = specimen.peridynamic_stiffness;
  options.growth_inner_radius = 2. * specimen.horizon;
  options.growth_outer_radius = 4. * specimen.horizon;
  options.tolerance = options.damage_tolerance = specimen.tolerance;
  if (dim == 2) {
    options.preconditioner_matrix = operators::PreconditionerMatrix::coupled;
  } else {  // the whole matrix would take most of the time
    options.preconditioner_matrix = operators::PreconditionerMatrix::short_range;
    options.short_range_cut_off = 0.6 * specimen.horizon;
  }
  options.breaking_fraction = specimen.breaking_fraction;
  options.points_per_direction = specimen.points_per_direction;
  options.window = {specimen.window_radius, 1.};
  return options;
}

inline constexpr int most = std::numeric_limits<int>::max();
inline constexpr fracture::LoopLimits unlimited = {most, most, most};

template <int dim>
mesh::Mesh<dim> distribute(const base::Comm& comm, const SpecimenIn<dim>& specimen) {
  auto mesh = mesh::distribute(comm, specimen.whole, specimen.horizon, specimen.costs);
  std::vector<mesh::SymmetryPlane> planes;
  for (const auto& group : specimen.symmetry_planes) planes.push_back(mesh::symmetry_plane(comm, mesh, group));
  mesh::add_images(mesh, std::move(planes), specimen.horizon);
  return mesh;
}

/// A body and all that must outlive it.
template <int dim>
struct SpecimenBodyIn {
  mesh::Mesh<dim> mesh;
  model::Problem<dim> problem;
  base::Profile profile;
  fracture::Body<dim> body;

  explicit SpecimenBodyIn(const SpecimenIn<dim>& specimen,
                          const Teuchos::RCP<const base::Comm>& comm = Tpetra::getDefaultComm())
      : mesh(distribute(*comm, specimen)),
        problem(make_problem(specimen)),
        body(comm, mesh, problem, make_options(specimen), profile) {}

  fracture::LoopPosition position = {};

  /// One increment of the adaptive loop. Returns the solves.
  /// @param prescribed the load factor or, with control, the measure
  int advance(double prescribed) {
    struct Count : fracture::LoopObserver<dim> {
      int solves = 0;
      void solved(const fracture::LoopPosition&, const fracture::Body<dim>&) override { ++solves; }
    } count;
    fracture::run_increment(body, prescribed, unlimited, count, position);
    return count.solves;
  }
};
using SpecimenBody = SpecimenBodyIn<2>;

}  // namespace perimorph::tests
