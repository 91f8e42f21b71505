#include "perimorph/application/automatic_seeds.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "perimorph/base/errors.hpp"
#include "perimorph/base/point_tree.hpp"
#include "perimorph/operators/fields.hpp"

namespace perimorph::application {

using base::Point;
using fracture::Body;
using model::NumericalOptions;
using model::Problem;

namespace {

template <int dim>
Point<dim> position(const StretchedPlace<dim>& place) {
  return Eigen::Map<const Point<dim>>(place.centroid.data());
}

/// Per node: whether a component of its displacement is prescribed.
template <int dim>
std::vector<char> held_nodes(const mesh::Mesh<dim>& mesh, const Problem<dim>& problem) {
  std::vector<char> held(mesh.n_nodes(), 0);
  const auto hold = [&](const auto& one) {
    for (const int node : mesh.node_sets.at(one.node_set)) held[node] = 1;
  };
  std::for_each(problem.displacements.begin(), problem.displacements.end(), hold);
  std::for_each(problem.rigid_groups.begin(), problem.rigid_groups.end(), hold);
  return held;
}

/// By how much of the tenderest material's strain each element's counts: it is nearer to breaking.
template <int dim>
std::function<double(int)> tenderness(const mesh::Mesh<dim>& mesh, const Problem<dim>& problem) {
  if (!problem.breaks()) return [](int) { return 1.; };
  return [of = model::bond_materials(mesh, problem)](int e) { return of.smallest_limit() / of.law(e, e).limit(); };
}

template <int dim>
std::vector<StretchedPlace<dim>> own_free_elements(const Body<dim>& body, const Problem<dim>& problem) {
  const auto& mesh = body.mesh();
  const auto held = held_nodes(mesh, problem);
  const auto weight = tenderness(mesh, problem);
  std::vector<StretchedPlace<dim>> own;
  for (int e = 0; e < mesh.n_owned_elements; ++e) {
    const int* corners = mesh.corners_of(e);
    if (std::any_of(corners, corners + mesh.n_corners(e), [&](int node) { return held[node] != 0; })) continue;
    StretchedPlace<dim> place{
        mesh.element_ids[e], {}, weight(e) * operators::largest_principal_strain(body.model(), e, body.displacement())};
    Eigen::Map<Point<dim>>(place.centroid.data()) = mesh::centroid(mesh, e);
    own.push_back(place);
  }
  return own;
}

/// Only their order counts from here on; rounding and the solver's tolerance must not decide it.
template <int dim>
void round_strains(std::vector<StretchedPlace<dim>>& places, double largest) {
  constexpr double steps = 1e4;
  for (auto& place : places) place.strain = largest * std::round(steps * place.strain / largest) / steps;
}

template <int dim>
bool comes_before(const StretchedPlace<dim>& a, const StretchedPlace<dim>& b) {
  return a.strain != b.strain ? a.strain > b.strain : a.element < b.element;
}

/// The increment in which the amplitudes of loads reach furthest; without any, the last.
template <int dim>
int most_loaded(const Problem<dim>& problem, int last_increment) {
  const auto reach = [&](int increment) {
    double largest = 0.;
    for (const auto& one : problem.amplitudes) largest = std::max(largest, std::abs(one->at(increment)));
    return largest;
  };
  int most = last_increment;
  for (int k = 1; k < last_increment; ++k) most = reach(k) > reach(most) ? k : most;
  return most;
}

}  // namespace

template <int dim>
std::vector<StretchedPlace<dim>> most_stretched(const base::Comm& comm, const Body<dim>& body,
                                                const Problem<dim>& problem, const model::AutomaticSeed& seed) {
  PERIMORPH_ASSERT(seed.share > 0. && seed.share <= 1. && seed.inner_radius > 0., "share {}, inner radius {}",
                   seed.share, seed.inner_radius);
  using Place = StretchedPlace<dim>;
  auto own = own_free_elements(body, problem);
  double largest = 0.;
  for (const auto& place : own) largest = std::max(largest, place.strain);
  largest = base::max(comm, largest);
  if (largest <= 0.) return {};
  round_strains(own, largest);
  own.erase(std::remove_if(own.begin(), own.end(), [&](const Place& p) { return p.strain < seed.share * largest; }),
            own.end());
  auto places = base::gather_on_all(comm, own);
  std::sort(places.begin(), places.end(), comes_before<dim>);

  std::vector<Point<dim>> centroids;
  for (const auto& place : places) centroids.push_back(position(place));
  const base::PointTree<dim> tree(centroids);
  std::vector<Place> chosen;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const bool is_exceeded = tree.within(centroids[i], seed.inner_radius).front() < static_cast<int>(i);
    const bool is_covered = std::any_of(problem.seeds.begin(), problem.seeds.end(), [&](const auto& zone) {
      return zone.alpha(centroids[i], morphing::BlendingFunction::linear) == 1.;
    });
    if (!is_exceeded && !is_covered) chosen.push_back(places[i]);
  }
  return chosen;
}

template <int dim>
void place_automatic_seeds(const Teuchos::RCP<const base::Comm>& comm, const mesh::Mesh<dim>& mesh,
                           const NumericalOptions& options, int last_increment, Problem<dim>& problem,
                           base::Profile& profile, const base::Log& log) {
  if (problem.automatic_seeds.empty()) return;
  Problem<dim> elastic = problem;
  for (auto& material : elastic.materials) material.toughness = {};
  elastic.interfaces.clear();
  NumericalOptions accurate = options;
  accurate.tolerance = std::min(options.tolerance, 1e-9);  // much finer than strains are told apart
  Body<dim> body(comm, mesh, elastic, accurate, profile);
  body.prescribe(problem.prescribed_in(most_loaded(problem, last_increment)));
  body.update_topology();
  body.solve(fracture::Accuracy::accepted);
  for (const auto& seed : problem.automatic_seeds) {
    const auto places = most_stretched(*comm, body, problem, seed);
    if (places.empty()) {
      log->warn("warning: /Morphing/Seeds/{} finds no place that is stretched and has no zone yet", seed.name);
    }
    for (const auto& place : places) {
      problem.seeds.push_back(morphing::Zone<dim>::ball(position(place), seed.inner_radius, seed.outer_radius));
      log->info("seed             {}: at ({:.6g}), where the principal strain of the elastic body is {:.4g} of load {}",
                seed.name, fmt::join(place.centroid, ", "), place.strain, body.load_factor());
    }
  }
  problem.automatic_seeds.clear();
}

template std::vector<StretchedPlace<2>> most_stretched<2>(const base::Comm&, const Body<2>&, const Problem<2>&,
                                                          const model::AutomaticSeed&);
template void place_automatic_seeds<2>(const Teuchos::RCP<const base::Comm>&, const mesh::Mesh<2>&,
                                       const NumericalOptions&, int, Problem<2>&, base::Profile&, const base::Log&);

template std::vector<StretchedPlace<3>> most_stretched<3>(const base::Comm&, const Body<3>&, const Problem<3>&,
                                                          const model::AutomaticSeed&);
template void place_automatic_seeds<3>(const Teuchos::RCP<const base::Comm>&, const mesh::Mesh<3>&,
                                       const NumericalOptions&, int, Problem<3>&, base::Profile&, const base::Log&);

}  // namespace perimorph::application
