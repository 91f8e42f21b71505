#include "perimorph/fracture/problem.hpp"

#include <limits>

#include "mesh_checks.hpp"
#include "perimorph/fracture/geometry.hpp"
#include "perimorph/mesh/distribute.hpp"

namespace perimorph::fracture {

namespace {

template <int dim>
discretization::Loads<dim> make_loads(const Case& input) {
  std::vector<discretization::SurfaceTraction<dim>> tractions;
  for (const auto& t : input.tractions) {
    tractions.push_back({t.group, {point<dim>(t.rate), point<dim>(t.constant)}});
  }
  return {std::move(tractions), {point<dim>(input.body_force_rate), point<dim>(input.body_force_constant)}};
}

bool is_proportional(const Case& input) {
  const auto is_zero = [](double value) { return value == 0.; };
  const auto all_zero = [&](const std::vector<double>& v) { return std::all_of(v.begin(), v.end(), is_zero); };
  return std::all_of(input.displacements.begin(), input.displacements.end(),
                     [&](const auto& d) { return is_zero(d.constant); }) &&
         std::all_of(input.tractions.begin(), input.tractions.end(),
                     [&](const auto& t) { return all_zero(t.constant); }) &&
         all_zero(input.body_force_constant);
}

}  // namespace

template <int dim>
Problem<dim> make_problem(const Case& input) {
  const auto c0 =
      materials::calibrate<dim>(input.elastic_model, input.youngs_modulus, input.characteristic_length, input.horizon);
  double critical_stretch = std::numeric_limits<double>::infinity();
  if (input.critical_stretch) critical_stretch = *input.critical_stretch;
  if (input.fracture_energy) critical_stretch = materials::critical_stretch<dim>(c0, *input.fracture_energy);

  Problem<dim> problem{
      materials::elasticity_tensor<dim>(input.elastic_model, input.youngs_modulus, input.poissons_ratio),
      c0,
      critical_stretch,
      materials::fracture_energy<dim>(c0, critical_stretch),
      {},
      {},
      {},
      make_loads<dim>(input),
      is_proportional(input)};
  for (const auto& seed : input.seeds) {
    if (seed.shape == SeedShape::automatic) {
      problem.automatic_seeds.push_back({seed.name, seed.inner_radius, seed.outer_radius, seed.share});
    } else {
      problem.seeds.push_back(zone_of<dim>(seed));
    }
  }
  problem.pre_cracks = facets_of<dim>(input.pre_cracks);
  for (const auto& d : input.displacements) {
    problem.displacements.push_back({d.name, d.group, d.component, {d.rate, d.constant}});
  }
  return problem;
}

template <int dim>
mesh::Mesh<dim> read_whole_mesh(const base::Comm& comm, const Case& input, const std::string& folder) {
  mesh::Mesh<dim> whole;
  base::on_all_ranks(comm, [&] {
    if (comm.getRank() != 0) return;
    whole = read_opened_mesh<dim>(input, folder);
    input::Mistakes mistakes(input.file);
    check_against_mesh(input, whole, mistakes);
    mistakes.report();
  });
  return whole;
}

template <int dim>
mesh::Mesh<dim> distribute_mesh(const base::Comm& comm, const mesh::Mesh<dim>& whole, const Problem<dim>& problem,
                                const std::vector<double>& costs) {
  const bool is_uncracked_and_classical = !problem.has_zones() && problem.pre_cracks.empty();
  return mesh::distribute(comm, whole, is_uncracked_and_classical ? 0. : problem.micromodulus.horizon, costs);
}

#define PERIMORPH_INSTANTIATE(dim)                                                                              \
  template Problem<dim> make_problem<dim>(const Case&);                                                         \
  template mesh::Mesh<dim> read_whole_mesh<dim>(const base::Comm&, const Case&, const std::string&);            \
  template mesh::Mesh<dim> distribute_mesh<dim>(const base::Comm&, const mesh::Mesh<dim>&, const Problem<dim>&, \
                                                const std::vector<double>&);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::fracture
