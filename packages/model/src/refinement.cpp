#include "perimorph/model/refinement.hpp"

#include <algorithm>
#include <cmath>

#include "perimorph/base/errors.hpp"
#include "perimorph/base/point_tree.hpp"
#include "perimorph/elements/locator.hpp"
#include "perimorph/mesh/chord_error.hpp"
#include "perimorph/mesh/perturbation.hpp"
#include "perimorph/mesh/pre_crack.hpp"

namespace perimorph::model {

using base::GlobalId;
using base::Point;

namespace {

template <int dim>
Point<dim> place_of(const discretization::FlagPoint<dim>& flag) {
  return Eigen::Map<const Point<dim>>(flag.centroid.data());
}

template <int dim>
std::vector<Point<dim>> places_of(const std::vector<discretization::FlagPoint<dim>>& flags, std::size_t begin,
                                  std::size_t end) {
  std::vector<Point<dim>> places;
  for (std::size_t i = begin; i < end; ++i) places.push_back(place_of(flags[i]));
  return places;
}

/// Places on a line, at most so far from each other.
template <int dim>
std::vector<Point<dim>> places_along(const Point<dim>& begin, const Point<dim>& end, double spacing) {
  const auto n = std::max(1, static_cast<int>(std::ceil((end - begin).norm() / spacing)));
  std::vector<Point<dim>> places;
  for (int i = 0; i <= n; ++i) places.push_back(begin + (end - begin) * i / n);
  return places;
}

/// The same on a facet.
std::vector<Point<2>> spread_over(const mesh::CrackFacet<2>& facet, double spacing) {
  return places_along<2>(facet[0], facet[1], spacing);
}

std::vector<Point<3>> spread_over(const mesh::CrackFacet<3>& facet, double spacing) {
  const Point<3> a = facet[1] - facet[0], b = facet[2] - facet[0];
  const auto n = static_cast<int>(std::ceil(std::max({a.norm(), b.norm(), (b - a).norm()}) / spacing));
  std::vector<Point<3>> places;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n - i; ++j) places.emplace_back(facet[0] + a * i / n + b * j / n);
  }
  return places;
}

/// How far a place is from all that needs the finest elements, by what is there.
template <int dim>
struct Distances {
  const std::vector<morphing::Zone<dim>>& seeds;
  base::PointTree<dim> cracks, groups, flags, newest;
  double spacing, zone_radius;

  double of_zones(const Point<dim>& x) const {
    double smallest = std::min(cracks.distance(x) - spacing, flags.distance(x) - zone_radius);
    for (const auto& seed : seeds) smallest = std::min(smallest, seed.distance(x));
    return smallest;
  }
  double of_groups(const Point<dim>& x) const { return groups.distance(x) - spacing; }
  double of_newest(const Point<dim>& x) const { return newest.distance(x) - zone_radius; }
};

}  // namespace

template <int dim>
Refinement<dim>::Refinement(Teuchos::RCP<const base::Comm> comm, mesh::Mesh<dim> root, const Problem<dim>& problem,
                            const NumericalOptions& options)
    : comm_(std::move(comm)),
      root_(std::move(root)),
      problem_(problem),
      options_(options.refinement),
      zone_radius_(options.growth_outer_radius) {
  base::on_all_ranks(*comm_, [&] {
    if (comm_->getRank() != 0) return;
    if (!is_refined()) return perturb();
    spacing_ = std::ldexp(mesh::mean_edge(root_), -options_.levels);
    find_cracks();
    find_groups();
  });
  if (is_refined()) refine({});
}

template <int dim>
void Refinement<dim>::find_cracks() {
  if (problem_.pre_cracks.empty()) return;
  constexpr double inside = 1e-6;  // of all shape functions
  const elements::Locator<dim> locator(root_);
  for (const auto& facet : problem_.pre_cracks) {
    const auto places = spread_over(facet, spacing_);
    const bool cuts = std::any_of(places.begin(), places.end(), [&](const auto& x) {
      const auto found = locator.find(x);
      if (!found) return false;
      const double* shape = found->shape.data();
      return std::all_of(shape, shape + root_.n_corners(found->element), [](double value) { return value > inside; });
    });
    if (cuts) places_on_cracks_.insert(places_on_cracks_.end(), places.begin(), places.end());
  }
}

/// Their nodes, and what is between two of an element's edge.
template <int dim>
void Refinement<dim>::find_groups() {
  for (const auto& name : options_.groups) {
    const auto& nodes = root_.node_sets.at(name);
    const auto is_in = [&](int node) { return std::binary_search(nodes.begin(), nodes.end(), node); };
    for (const int node : nodes) places_of_groups_.push_back(root_.coordinates[node]);
    for (int e = 0; e < root_.n_elements(); ++e) {
      const int* corners = root_.corners_of(e);
      for (const auto& edge : mesh::edges(root_.types[e])) {
        if (!is_in(corners[edge[0]]) || !is_in(corners[edge[1]])) continue;
        const auto places =
            places_along<dim>(root_.coordinates[corners[edge[0]]], root_.coordinates[corners[edge[1]]], spacing_);
        places_of_groups_.insert(places_of_groups_.end(), places.begin(), places.end());
      }
    }
  }
}

template <int dim>
bool Refinement<dim>::serves(const FlagPoints& flag_points) {
  constexpr double diameter = 2.;  // of a finest element at a hanging node, which may lie beside it, in its radius
  if (!is_refined() || n_served_ >= flag_points.size()) return true;
  const base::PointTree<dim> tree(places_of(flag_points, n_served_, flag_points.size()));
  const double reach = zone_radius_ + problem_.horizon();
  const bool is_near = std::any_of(coarse_.begin(), coarse_.end(), [&](const CoarseElement& element) {
    return tree.distance(element.center) < reach + element.radius + diameter * element.finest_radius;
  });
  if (base::max(*comm_, static_cast<GlobalId>(is_near)) > 0) return false;
  n_served_ = flag_points.size();
  return true;
}

/// Those of the last growth before each refinement.
template <int dim>
std::vector<Point<dim>> Refinement<dim>::newest_at(const FlagPoints& flag_points) const {
  std::vector<Point<dim>> newest;
  for (const GlobalId n : calls_) {
    PERIMORPH_ASSERT(n > 0 && n <= static_cast<GlobalId>(flag_points.size()), "{} of {} flag points", n,
                     flag_points.size());
    for (auto i = static_cast<std::size_t>(n); i > 0 && flag_points[i - 1].growth == flag_points[n - 1].growth; --i) {
      newest.push_back(place_of(flag_points[i - 1]));
    }
  }
  return newest;
}

template <int dim>
void Refinement<dim>::refine(const FlagPoints& flag_points) {
  base::on_all_ranks(*comm_, [&] {
    if (comm_->getRank() != 0) return;
    const Distances<dim> distances{problem_.seeds,
                                   base::PointTree<dim>(places_on_cracks_),
                                   base::PointTree<dim>(places_of_groups_),
                                   base::PointTree<dim>(places_of(flag_points, 0, flag_points.size())),
                                   base::PointTree<dim>(newest_at(flag_points)),
                                   spacing_,
                                   zone_radius_};
    refined_ = mesh::refine<dim>(root_, [&](const Point<dim>& center, double radius, double root_edge) {
      const double finest = std::ldexp(root_edge, -options_.levels);
      const double of_bonds =
          std::min(distances.of_zones(center), distances.of_newest(center) - options_.look_ahead * finest) -
          problem_.horizon();
      const double distance = std::min(of_bonds, distances.of_groups(center)) - radius - options_.margin * finest;
      const double size = std::clamp(distance / (options_.grading * finest), 1., std::ldexp(1., options_.levels));
      return options_.levels - static_cast<int>(std::floor(std::log2(size)));
    });
    if (!problem_.pre_cracks.empty()) mesh::open_along<dim>(refined_.mesh, problem_.pre_cracks);
    perturb();
    coarse_.clear();
    for (int e = 0; e < refined_.mesh.n_elements(); ++e) {
      const auto& path = refined_.paths[e];
      if (path.level >= options_.levels) continue;
      const double radius = mesh::radius(refined_.mesh, e);
      coarse_.push_back({mesh::centroid(refined_.mesh, e), radius, std::ldexp(radius, path.level - options_.levels)});
    }
  });
  n_served_ = flag_points.size();
}

/// Without refinement all elements are finest ones. Nodes that opening has doubled stay, as all do on pre-cracks.
template <int dim>
void Refinement<dim>::perturb() {
  if (options_.perturbation == 0.) return;
  if (!is_refined()) {
    const std::vector<char> all(root_.n_elements(), 1);
    return mesh::perturb(root_, options_.perturbation, mesh::node_keys(root_.n_nodes()), all);
  }
  std::vector<char> are_finest;
  for (const auto& path : refined_.paths) are_finest.push_back(static_cast<char>(path.level == options_.levels));
  refined_.node_keys.resize(refined_.mesh.n_nodes());
  mesh::perturb(refined_.mesh, options_.perturbation, refined_.node_keys, are_finest);
}

template <int dim>
std::vector<mesh::Descent> Refinement<dim>::follow(const FlagPoints& flag_points) {
  PERIMORPH_ASSERT(is_refined() && !flag_points.empty(), "{} levels, {} flag points", options_.levels,
                   flag_points.size());
  const auto before = std::move(refined_);
  calls_.push_back(static_cast<GlobalId>(flag_points.size()));
  refine(flag_points);
  std::vector<mesh::Descent> descents;
  base::on_all_ranks(*comm_, [&] { descents = mesh::descents(before, refined_); });
  return descents;
}

template <int dim>
void Refinement<dim>::go_to(const FlagPoints& flag_points, std::vector<GlobalId> calls) {
  if (calls == calls_) return;
  calls_ = std::move(calls);
  const std::size_t n = calls_.empty() ? 0 : static_cast<std::size_t>(calls_.back());
  refine({flag_points.begin(), flag_points.begin() + static_cast<std::ptrdiff_t>(n)});
}

template <int dim>
std::string Refinement<dim>::description() const {
  const double all = root_.n_elements() * std::ldexp(1., dim * options_.levels);
  const auto n = refined_.mesh.n_elements();
  return fmt::format("{} elements become {}, with {} hanging nodes: {:.2g} of the {:.0f} that are as fine everywhere",
                     root_.n_elements(), n, refined_.mesh.hanging_nodes.size(), n / all, all);
}

template <int dim>
std::vector<std::string> Refinement<dim>::warnings() const {
  constexpr double tolerated = 0.2;  // of a finest element
  std::vector<int> levels(root_.n_elements(), 0);
  for (const auto& path : refined_.paths) levels[path.root] = std::max(levels[path.root], path.level);
  std::vector<std::string> lines;
  if (*std::max_element(levels.begin(), levels.end()) == 0) {
    lines.emplace_back(
        "/Mesh/Refinement/Levels: no element is divided: there is no seed, group or pre-crack around which it would "
        "be");
  }
  double largest = 0.;
  Point<dim> place = Point<dim>::Zero();
  for (const auto& error : mesh::chord_errors(root_)) {
    const double finest = std::ldexp(mesh::radius(root_, error.element), 1 - options_.levels) / std::sqrt(dim);
    if (levels[error.element] == 0 || error.distance <= largest * finest) continue;
    largest = error.distance / finest;
    place = error.place;
  }
  if (largest > tolerated) {
    lines.push_back(fmt::format(
        "/Mesh/Refinement: new nodes lie on straight sides of the mesh in the file; where its boundary is curved, as "
        "around ({:.6g}), they are about {:.2g} finest elements off. With smaller elements there they would be nearer",
        fmt::join(place.begin(), place.end(), ", "), largest));
  }
  return lines;
}

template class Refinement<2>;
template class Refinement<3>;

}  // namespace perimorph::model
