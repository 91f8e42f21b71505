#include "perimorph/cases/problem.hpp"

#include <cmath>
#include <limits>

#include "mesh_checks.hpp"
#include "perimorph/base/errors.hpp"
#include "perimorph/cases/geometry.hpp"

namespace perimorph::cases {

namespace {

template <int dim>
discretization::Loads<dim> make_loads(const BoundaryConditions& conditions) {
  std::vector<discretization::SurfaceTraction<dim>> tractions;
  for (const auto& t : conditions.tractions) {
    tractions.push_back({t.group, {point<dim>(t.rate), point<dim>(t.constant)}});
  }
  return {std::move(tractions), {point<dim>(conditions.body_force_rate), point<dim>(conditions.body_force_constant)}};
}

/// Extreme numbers, each allowed by itself, may give none together.
template <int dim>
void check_numbers(const Case& input, const model::Problem<dim>& problem) {
  const bool breaks = input.material.breaks();
  const auto is_valid = [](double value) { return std::isfinite(value) && value > 0.; };
  const double tau0 = problem.micromodulus.tau0, stretch = problem.critical_stretch, energy = problem.fracture_energy;
  if (is_valid(tau0) && (!breaks || (is_valid(stretch) && is_valid(energy)))) return;
  throw base::UserError(
      fmt::format("{}: /Material and /Peridynamics give tau0 = {:.4g}, s_crit = {:.4g}, G_c = {:.4g}, with E = {:.4g}, "
                  "horizon = {:.4g}, l = {:.4g}; allowed are numbers that give finite ones above 0",
                  input.file, tau0, stretch, energy, input.material.youngs_modulus, problem.micromodulus.horizon,
                  problem.micromodulus.characteristic_length));
}

}  // namespace

template <int dim>
model::Problem<dim> make_problem(const Case& input) {
  const Material& material = input.material;
  const double ratio = materials::dilatational_ratio(material.elastic_model, material.poissons_ratio);
  const auto c0 = materials::calibrate<dim>(material.elastic_model, material.youngs_modulus, material.poissons_ratio,
                                            input.peridynamics.characteristic_length, input.peridynamics.horizon);
  double critical_stretch = std::numeric_limits<double>::infinity();
  if (material.critical_stretch) critical_stretch = *material.critical_stretch;
  if (material.fracture_energy)
    critical_stretch = materials::critical_stretch<dim>(c0, *material.fracture_energy, ratio);

  model::Problem<dim> problem{
      materials::elasticity_tensor<dim>(material.elastic_model, material.youngs_modulus, material.poissons_ratio),
      ratio,
      c0,
      critical_stretch,
      materials::fracture_energy<dim>(c0, critical_stretch, ratio),
      {},
      facets_of<dim>(input.pre_cracks),
      input.boundary_conditions.displacements,
      make_loads<dim>(input.boundary_conditions),
      input.boundary_conditions.are_proportional()};
  problem.calibration = material.calibration;
  problem.is_stretch_given = material.critical_stretch.has_value();
  for (const auto& seed : input.morphing.seeds) {
    if (seed.shape == SeedShape::automatic) {
      problem.automatic_seeds.push_back({seed.name, seed.inner_radius, seed.outer_radius, seed.share});
    } else {
      problem.seeds.push_back(zone_of<dim>(seed));
    }
  }
  check_numbers(input, problem);
  return problem;
}

template <int dim>
CheckedMesh<dim> read_whole_mesh(const base::Comm& comm, const Case& input, const std::string& folder) {
  CheckedMesh<dim> result;
  base::on_all_ranks(comm, [&] {
    if (comm.getRank() != 0) return;
    result.whole = read_closed_mesh<dim>(input, folder);
    input::Mistakes mistakes(input.file);
    result.warnings = open_and_check(input, result.whole, mistakes);
    mistakes.report();
  });
  return result;
}

template model::Problem<2> make_problem<2>(const Case&);
template CheckedMesh<2> read_whole_mesh<2>(const base::Comm&, const Case&, const std::string&);

template model::Problem<3> make_problem<3>(const Case&);
template CheckedMesh<3> read_whole_mesh<3>(const base::Comm&, const Case&, const std::string&);

}  // namespace perimorph::cases
