#include "perimorph/discretization/topology.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "perimorph/base/errors.hpp"
#include "perimorph/mesh/distribute.hpp"
#include "perimorph/mesh/images.hpp"

namespace perimorph::discretization {

using base::GlobalId;
using base::Point;
using morphing::ElementClass;

namespace {

/// Elements that a pre-crack cuts through: it passes between two of their points.
template <int dim>
std::vector<char> find_cut_elements(const mesh::Mesh<dim>& mesh, const elements::MaterialPoints<dim>& points,
                                    const std::vector<mesh::CrackFacet<dim>>& pre_cracks) {
  std::vector<char> cut(mesh.n_elements(), 0);
  if (pre_cracks.empty()) return cut;
  for (int e = 0; e < mesh.n_elements(); ++e) {
    std::vector<Point<dim>> own;
    for (int i = points.first(e); i < points.first(e + 1); ++i) own.push_back(points.position(i));
    const auto through = bonds::Visibility<dim>::among(pre_cracks, own);
    if (through.empty()) continue;
    for (int i = points.first(e); i < points.first(e + 1); ++i) {
      for (int j = i + 1; j < points.first(e + 1) && !cut[e]; ++j) {
        cut[e] = bonds::Visibility<dim>::blocks(through, points.position(i), points.position(j));
      }
    }
  }
  return cut;
}

template <int dim>
TopologyOptions<dim> with_images(const mesh::Mesh<dim>& mesh, TopologyOptions<dim> options) {
  options.pre_cracks = mesh::with_images<dim>(options.pre_cracks, mesh.symmetry_planes);
  return options;
}

}  // namespace

template <int dim>
Topology<dim>::Topology(const Teuchos::RCP<const base::Comm>& comm, const mesh::Mesh<dim>& mesh,
                        TopologyOptions<dim> options)
    : comm_(comm),
      mesh_(mesh),
      options_(with_images(mesh, std::move(options))),
      points_(mesh, options_.points_per_direction),
      alpha_(mesh, points_, options_.blending_function),
      bonds_(mesh, points_, mesh::active_elements(mesh), options_.materials, options_.pre_cracks, options_.stiffness),
      element_exchange_(discretization::element_exchange(*comm, mesh)),
      corner_exchange_(corner_exchange(*comm, mesh)),
      cut_by_pre_crack_(find_cut_elements<dim>(mesh, points_, options_.pre_cracks)),
      classes_(mesh.n_elements(), ElementClass::fe),
      discontinuous_(mesh.n_elements(), 0),
      flagged_(mesh.n_owned_elements, 0) {
  if (options_.crack_faces == CrackFaces::contact) {
    bonds_across_faces_ = bonds::bonds_across_faces<dim>(mesh, points_, mesh::active_elements(mesh),
                                                         options_.materials.horizon(), options_.pre_cracks);
  }
  PERIMORPH_ASSERT(options_.growth_inner_radius > 0. && options_.growth_outer_radius > options_.growth_inner_radius,
                   "zones grow to {} and fall to zero at {}", options_.growth_inner_radius,
                   options_.growth_outer_radius);
}

template <int dim>
bool Topology<dim>::grow(const std::vector<FlagPoint<dim>>& flag_points) {
  PERIMORPH_ASSERT(n_grown_ <= flag_points.size(), "{} of {} flag points are followed", n_grown_, flag_points.size());
  const bool has_grown = !has_seeds_ || n_grown_ < flag_points.size();
  if (!std::exchange(has_seeds_, true)) bonds_.extend(alpha_.add(options_.seeds));
  while (n_grown_ < flag_points.size()) {
    const GlobalId growth = flag_points[n_grown_].growth;
    std::vector<morphing::Zone<dim>> zones;
    for (; n_grown_ < flag_points.size() && flag_points[n_grown_].growth == growth; ++n_grown_) {
      zones.push_back(morphing::Zone<dim>::ball(Eigen::Map<const Point<dim>>(flag_points[n_grown_].centroid.data()),
                                                options_.growth_inner_radius, options_.growth_outer_radius));
    }
    bonds_.extend(alpha_.add(zones));
  }
  return has_grown;
}

template <int dim>
typename Topology<dim>::Change Topology<dim>::update(bool has_grown) {
  PERIMORPH_ASSERT(has_seeds_, "the zones have never grown");
  const bool is_first = !is_built();
  if (has_grown) classify();
  const bool split = find_discontinuous();
  if (is_first) check_pre_cracks();
  const Change change{split || has_grown, split || is_first};
  if (change.numbering) {
    auto dofs = std::make_unique<DofMap<dim>>(comm_, mesh_, corner_exchange_, discontinuous_);
    old_dofs_ = std::exchange(dofs_, std::move(dofs));
  }
  return change;
}

template <int dim>
void Topology<dim>::classify() {
  const auto extremes = bonds_.neighbourhood_extremes(alpha_);
  for (int e = 0; e < mesh_.n_owned_elements; ++e) {
    const auto begin = points_.first(e), end = points_.first(e + 1);
    const double smallest = *std::min_element(extremes.smallest.begin() + begin, extremes.smallest.begin() + end);
    const double largest = *std::max_element(extremes.largest.begin() + begin, extremes.largest.begin() + end);
    classes_[e] = smallest >= 1. ? ElementClass::pd : largest > 0. ? ElementClass::morph : ElementClass::fe;
  }
  element_exchange_.update(classes_);
}

/// Returns whether any rank has new ones.
template <int dim>
bool Topology<dim>::find_discontinuous() {
  GlobalId split = 0, n_own = 0;
  for (int e = 0; e < mesh_.n_owned_elements; ++e) {
    const bool by_itself = options_.discontinuous == DiscontinuousElements::whole_zone ||
                           (options_.discontinuous == DiscontinuousElements::on_damage && bonds_.is_damaged(e));
    const bool is_split = classes_[e] == ElementClass::pd && (by_itself || cut_by_pre_crack_[e]);
    if (is_split && !discontinuous_[e]) split = 1;
    discontinuous_[e] = is_split;
    n_own += is_split;
  }
  element_exchange_.update(discontinuous_);
  n_discontinuous_ = base::sum(*comm_, n_own);
  return base::max(*comm_, split) > 0;
}

template <int dim>
void Topology<dim>::check_pre_cracks() const {
  base::on_all_ranks(*comm_, [&] {
    for (int e = 0; e < mesh_.n_owned_elements; ++e) {
      if (!cut_by_pre_crack_[e] || classes_[e] == ElementClass::pd) continue;
      const auto c = mesh::centroid(mesh_, e);
      throw base::UserError(fmt::format(
          "/Pre-Cracks: a pre-crack cuts through the element at ({:.6g}), which is not peridynamic and so cannot part; "
          "let the crack run along sides of elements, or put a seed there that is wider by a horizon",
          fmt::join(c.begin(), c.end(), ", ")));
    }
  });
}

template <int dim>
GlobalId Topology<dim>::flag_damaged_elements(std::vector<FlagPoint<dim>>& flag_points) {
  const GlobalId growth = flag_points.empty() ? 1 : flag_points.back().growth + 1;
  std::vector<FlagPoint<dim>> own;
  bonds_.note_softening();
  for (int e = 0; e < mesh_.n_owned_elements; ++e) {
    if (flagged_[e] || !bonds_.is_damaged(e)) continue;
    flagged_[e] = 1;
    own.push_back({mesh_.element_ids[e], growth, {}});
    Eigen::Map<Point<dim>>(own.back().centroid.data()) = mesh::centroid(mesh_, e);
  }
  auto all = base::gather_on_all(*comm_, own);
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.element < b.element; });
  flag_points.insert(flag_points.end(), all.begin(), all.end());
  return static_cast<GlobalId>(all.size());
}

template <int dim>
void Topology<dim>::note_flags(const std::vector<FlagPoint<dim>>& flag_points) {
  std::set<GlobalId> elements;
  for (const auto& flag : flag_points) elements.insert(flag.element);
  for (int e = 0; e < mesh_.n_elements(); ++e) {
    if (elements.count(mesh_.element_ids[e]) == 0) continue;
    if (e < mesh_.n_owned_elements) flagged_[e] = 1;
    bonds_.note_damage(e);
  }
}

template <int dim>
std::vector<int> Topology<dim>::old_nodes() const {
  std::vector<int> old_nodes(dofs_->n_nodes(), 0);
  for (int e = 0; e < mesh_.n_elements(); ++e) {
    for (int k = 0; k < mesh_.n_corners(e); ++k) old_nodes[dofs_->nodes_of(e)[k]] = old_dofs().nodes_of(e)[k];
  }
  return old_nodes;
}

template <int dim>
std::vector<double> Topology<dim>::carried_over(const std::vector<double>& displacement) const {
  std::vector<double> carried(static_cast<std::size_t>(dofs_->n_nodes()) * dim, 0.);
  if (displacement.empty()) return carried;
  PERIMORPH_ASSERT(displacement.size() == static_cast<std::size_t>(old_dofs().n_nodes()) * dim,
                   "{} displacements of {} nodes", displacement.size(), old_dofs().n_nodes());
  const auto old_nodes = this->old_nodes();
  for (std::size_t node = 0; node < old_nodes.size(); ++node) {
    std::copy_n(displacement.begin() + static_cast<std::ptrdiff_t>(old_nodes[node]) * dim, dim,
                carried.begin() + static_cast<std::ptrdiff_t>(node) * dim);
  }
  return carried;
}

template class Topology<2>;
template class Topology<3>;

}  // namespace perimorph::discretization
