#pragma once

// A breaking body made in memory, without a case file, and the adaptive loop over it without results.

#include <Tpetra_Core.hpp>

#include "perimorph/fracture/body.hpp"
#include "perimorph/mesh/distribute.hpp"
#include "support/meshes.hpp"

namespace perimorph::tests {

using fracture::DiscontinuousElements;
using morphing::Zone;
using operators::PeridynamicStiffness;

/// What a test says of a body; plane stress, nu = 1/3, unit thickness.
struct Specimen {
  mesh::Mesh<2> whole;  ///< used on rank 0
  double horizon, characteristic_length;
  std::vector<Zone<2>> seeds = {};
  std::vector<discretization::PrescribedComponent> displacements = {};
  DiscontinuousElements discontinuous = DiscontinuousElements::on_damage;
  PeridynamicStiffness peridynamic_stiffness = PeridynamicStiffness::dropped;
  double critical_stretch = std::numeric_limits<double>::infinity();
  std::vector<mesh::CrackFacet<2>> pre_cracks = {};
  std::vector<discretization::SurfaceTraction<2>> tractions = {};
  Point2 body_force_rate = Point2::Zero();
  bool is_proportional = true;
  double tolerance = 1e-10;  ///< residual over reaction forces
  double youngs_modulus = 1000.;
  double breaking_fraction = 1.;  ///< share of the overstretched bonds that break between two solves
};

inline fracture::Problem<2> make_problem(const Specimen& specimen) {
  constexpr auto model = materials::ElasticModel::plane_stress;
  const double youngs_modulus = specimen.youngs_modulus;
  const auto c0 = materials::calibrate<2>(model, youngs_modulus, specimen.characteristic_length, specimen.horizon);
  return {materials::elasticity_tensor<2>(model, youngs_modulus, 1. / 3.),
          c0,
          specimen.critical_stretch,
          materials::fracture_energy<2>(c0, specimen.critical_stretch),
          specimen.seeds,
          specimen.pre_cracks,
          specimen.displacements,
          discretization::Loads<2>(specimen.tractions, {specimen.body_force_rate, Point2::Zero()}),
          specimen.is_proportional};
}

inline fracture::BodyOptions make_options(const Specimen& specimen) {
  fracture::BodyOptions options{};
  options.profile = morphing::Profile::linear;
  options.discontinuous = specimen.discontinuous;
  options.peridynamic_stiffness = specimen.peridynamic_stiffness;
  options.growth_inner_radius = 2. * specimen.horizon;
  options.growth_outer_radius = 4. * specimen.horizon;
  options.tolerance = options.damage_tolerance = specimen.tolerance;
  options.breaking_fraction = specimen.breaking_fraction;
  return options;
}

/// A body and all that must outlive it.
struct SpecimenBody {
  mesh::Mesh<2> mesh;
  fracture::Problem<2> problem;
  base::Profile profile;
  fracture::Body<2> body;

  explicit SpecimenBody(const Specimen& specimen, const Teuchos::RCP<const base::Comm>& comm = Tpetra::getDefaultComm())
      : mesh(mesh::distribute(*comm, specimen.whole, specimen.horizon)),
        problem(make_problem(specimen)),
        body(comm, mesh, problem, make_options(specimen), profile) {}

  /// One increment of the adaptive loop (WHL19, Fig. 5), as in fracture::run_adaptive_loop but
  /// with one tolerance. Returns the solves.
  int advance(double load_factor) {
    int solves = 0;
    body.apply_load(load_factor);
    do {
      body.update_topology();
      do {
        body.solve(fracture::Accuracy::accepted);
        ++solves;
      } while (body.break_bonds() > 0);
    } while (body.flag_damaged_elements() > 0);
    return solves;
  }
};

}  // namespace perimorph::tests
