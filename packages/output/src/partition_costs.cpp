#include "perimorph/output/partition_costs.hpp"

#include <cmath>
#include <numeric>

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

}  // namespace

template <int dim>
std::vector<double> expected_costs(const mesh::Mesh<dim>& whole, const model::Problem<dim>& problem,
                                   discretization::DiscontinuousElements discontinuous) {
  PERIMORPH_ASSERT(problem.seeds.empty() || problem.horizon() > 0., "seeds with a horizon of {}", problem.horizon());
  std::vector<double> costs(whole.n_elements(), 1.);
  for (int e = 0; e < whole.n_elements(); ++e) {
    const auto center = mesh::centroid(whole, e);
    const bool is_in_zone = std::any_of(problem.seeds.begin(), problem.seeds.end(), [&](const auto& seed) {
      return seed.alpha(center, morphing::BlendingFunction::linear) > 0.;
    });
    if (!is_in_zone) continue;
    double radius = 0.;  // of the element
    for (int k = 0; k < whole.n_corners(e); ++k) {
      radius = std::max(radius, (whole.coordinates[whole.corners_of(e)[k]] - center).norm());
    }
    const double n_points = whole.n_corners(e);  // as many as corners, about
    // A square or cube with this radius: the horizon's ball holds 1.6 or 2.7 times (horizon / radius)^dim of them.
    const double n_partners = (dim == 2 ? 1.6 : 2.7) * std::pow(problem.horizon() / radius, dim);
    costs[e] = cost<dim>(discontinuous == discretization::DiscontinuousElements::whole_zone, whole.n_corners(e),
                         0.5 * n_points * n_points * n_partners);
  }
  return costs;
}

template <int dim>
std::vector<double> partition_costs(const base::Comm& comm, const Body<dim>& body) {
  const auto first = body.mesh().element_ids.begin();
  const auto ids = base::gather_on_root(comm, std::vector<base::GlobalId>(first, first + body.mesh().n_owned_elements));
  const auto costs = base::gather_on_root(comm, own_costs(body));
  PERIMORPH_ASSERT(ids.size() == costs.size(), "{} elements with {} costs", ids.size(), costs.size());
  std::vector<double> by_id(costs.size());
  for (std::size_t i = 0; i < ids.size(); ++i) by_id[ids[i]] = costs[i];
  return by_id;
}

template <int dim>
WorkShare measure_work(const base::Comm& comm, const Body<dim>& body) {
  const auto costs = own_costs(body);
  const double own = std::accumulate(costs.begin(), costs.end(), 0.);
  const double total = base::sum(comm, own);
  PERIMORPH_ASSERT(total > 0., "all elements together cost {}", total);
  return {total, base::max(comm, own) * comm.getSize() / total};
}

#define PERIMORPH_INSTANTIATE(dim)                                                                \
  template std::vector<double> expected_costs(const mesh::Mesh<dim>&, const model::Problem<dim>&, \
                                              discretization::DiscontinuousElements);             \
  template std::vector<double> partition_costs(const base::Comm&, const Body<dim>&);              \
  template WorkShare measure_work(const base::Comm&, const Body<dim>&);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::output
