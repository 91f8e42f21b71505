#include "perimorph/output/partition_costs.hpp"

#include <cmath>
#include <numeric>

#include "perimorph/base/directory.hpp"
#include "perimorph/base/errors.hpp"

namespace perimorph::output {

using fracture::Body;

namespace {

/// In classical elements: a discontinuous element has nodes of its own, which the preconditioner sees, and bonds.
template <int dim>
double cost(bool is_discontinuous, int n_corners, double n_bonds) {
  constexpr double bonds_per_element = dim == 2 ? 100. : 200.;
  return (is_discontinuous ? n_corners : 1) + n_bonds / bonds_per_element;
}

template <int dim>
std::vector<double> own_costs(const Body<dim>& body) {
  const auto model = body.model();
  std::vector<double> costs(body.mesh().n_owned_elements);
  for (int e = 0; e < body.mesh().n_owned_elements; ++e) {
    std::size_t n_bonds = 0;
    for (const int p : model.bonds.pairs_of(e)) n_bonds += model.bonds.first_bond(p + 1) - model.bonds.first_bond(p);
    // The other half is the other element's.
    costs[e] = cost<dim>(body.topology().discontinuous()[e] != 0, body.mesh().n_corners(e),
                         0.5 * static_cast<double>(n_bonds));
  }
  return costs;
}

/// Where costs of the elements that the part owns are told and asked. Collective.
template <int dim>
base::Directory directory_of(const base::Comm& comm, const mesh::Mesh<dim>& part) {
  const auto n = base::max(comm, part.n_global_elements);
  if (part.rank != comm.getRank()) return {comm, n, {}};
  return {comm, n, {part.element_ids.begin(), part.element_ids.begin() + part.n_owned_elements}};
}

}  // namespace

template <int dim>
std::vector<double> in_slices(const base::Comm& comm, const mesh::Mesh<dim>& part, const std::vector<double>& costs) {
  return directory_of(comm, part).collect(costs);
}

template <int dim>
std::vector<double> costs_of(const base::Comm& comm, const mesh::Mesh<dim>& part, const std::vector<double>& slice) {
  return directory_of(comm, part).answers(slice);
}

template <int dim>
std::vector<double> expected_costs(const base::Comm& comm, const mesh::Mesh<dim>& part,
                                   const model::Problem<dim>& problem,
                                   discretization::DiscontinuousElements discontinuous) {
  PERIMORPH_ASSERT(problem.seeds.empty() || problem.horizon() > 0., "seeds with a horizon of {}", problem.horizon());
  std::vector<double> costs(part.rank == comm.getRank() ? part.n_owned_elements : 0, 1.);
  for (int e = 0; e < static_cast<int>(costs.size()); ++e) {
    const auto center = mesh::centroid(part, e);
    const bool is_in_zone = std::any_of(problem.seeds.begin(), problem.seeds.end(), [&](const auto& seed) {
      return seed.alpha(center, morphing::BlendingFunction::linear) > 0.;
    });
    if (!is_in_zone) continue;
    const double radius = mesh::radius(part, e);
    const double n_points = part.n_corners(e);  // as many as corners, about
    // A square or cube with this radius: the horizon's ball holds 1.6 or 2.7 times (horizon / radius)^dim of them.
    const double n_partners = (dim == 2 ? 1.6 : 2.7) * std::pow(problem.horizon() / radius, dim);
    costs[e] = cost<dim>(discontinuous == discretization::DiscontinuousElements::whole_zone, part.n_corners(e),
                         0.5 * n_points * n_points * n_partners);
  }
  return in_slices(comm, part, costs);
}

template <int dim>
std::vector<double> partition_costs(const base::Comm& comm, const Body<dim>& body) {
  return in_slices(comm, body.mesh(), own_costs(body));
}

template <int dim>
WorkShare measure_work(const base::Comm& comm, const Body<dim>& body) {
  const auto costs = own_costs(body);
  const double own = std::accumulate(costs.begin(), costs.end(), 0.);
  const double total = base::sum(comm, own);
  PERIMORPH_ASSERT(total > 0., "all elements together cost {}", total);
  return {total, base::max(comm, own) * comm.getSize() / total};
}

#define PERIMORPH_INSTANTIATE(dim)                                                                                   \
  template std::vector<double> in_slices(const base::Comm&, const mesh::Mesh<dim>&, const std::vector<double>&);     \
  template std::vector<double> costs_of(const base::Comm&, const mesh::Mesh<dim>&, const std::vector<double>&);      \
  template std::vector<double> expected_costs(const base::Comm&, const mesh::Mesh<dim>&, const model::Problem<dim>&, \
                                              discretization::DiscontinuousElements);                                \
  template std::vector<double> partition_costs(const base::Comm&, const Body<dim>&);                                 \
  template WorkShare measure_work(const base::Comm&, const Body<dim>&);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::output
