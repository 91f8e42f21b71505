#include "perimorph/operators/crack_faces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "perimorph/mesh/shared_sides.hpp"

namespace perimorph::operators {

using base::Point;

namespace {

/// All sides of elements that touch a discontinuous one, and the boundary, where pre-cracks are.
template <int dim>
std::vector<mesh::Side> sides_that_may_part(const mesh::Mesh<dim>& mesh, const std::vector<char>& discontinuous) {
  std::vector<char> touched(mesh.n_nodes(), 0);
  for (int e = 0; e < mesh.n_elements(); ++e) {
    if (!discontinuous[e]) continue;
    for (int k = 0; k < mesh.n_corners(e); ++k) touched[mesh.corners_of(e)[k]] = 1;
  }
  std::vector<char> chosen(mesh.n_elements(), 0);
  std::vector<mesh::Side> sides;
  for (int e = 0; e < mesh.n_elements(); ++e) {
    const int* corners = mesh.corners_of(e);
    chosen[e] = std::any_of(corners, corners + mesh.n_corners(e), [&](int node) { return touched[node] != 0; });
    if (!chosen[e]) continue;
    for (int s = 0; s < static_cast<int>(mesh::sides(mesh.types[e]).size()); ++s) sides.push_back({e, s});
  }
  std::copy_if(mesh.boundary.begin(), mesh.boundary.end(), std::back_inserter(sides),
               [&](const mesh::Side& side) { return !chosen[side.element]; });
  return sides;
}

Point<2> outward_normal(const std::vector<Point<2>>& corners) {
  const Point<2> along = corners[1] - corners[0];
  return Point<2>(along[1], -along[0]).normalized();
}

Point<3> outward_normal(const std::vector<Point<3>>& corners) {
  return (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
}

template <int dim>
bool are_joined(const bonds::BondFamilies<dim>& bonds, int e, int f) {
  for (const int p : bonds.pairs_of(e)) {
    const auto [first, second] = bonds.pair(p);
    if ((first == e ? second : first) != f) continue;
    for (auto b = bonds.first_bond(p); b < bonds.first_bond(p + 1); ++b) {
      if (!bonds.broken(b)) return true;
    }
  }
  return false;
}

/// Displacement of an element's corner at a place.
template <int dim>
Point<dim> displacement_at(const CoupledModel<dim>& model, base::ConstField u, int element, const Point<dim>& place) {
  const int* reference = model.mesh.corners_of(element);
  int corner = 0;
  while (model.mesh.coordinates[reference[corner]] != place) ++corner;
  return base::at_node<dim>(u, model.dofs.nodes_of(element)[corner]);
}

}  // namespace

template <int dim>
std::vector<FacingSides> facing_sides(const mesh::Mesh<dim>& mesh, const std::vector<char>& discontinuous) {
  std::vector<FacingSides> facing;
  const auto id = [&](const mesh::Side& side) { return mesh.element_ids[side.element]; };
  for (auto [first, second] : mesh::coincident_sides(mesh, sides_that_may_part(mesh, discontinuous))) {
    if (id(second) < id(first)) std::swap(first, second);
    if (first.element < mesh.n_owned_elements) facing.push_back({first, second});
  }
  return facing;
}

namespace {

/// On this rank.
template <int dim>
Overlap<dim> own_overlap(const CoupledModel<dim>& model, const std::vector<FacingSides>& facing, base::ConstField u) {
  Overlap<dim> largest;
  for (const auto& [first, second] : facing) {
    if (are_joined(model.bonds, first.element, second.element)) continue;
    const auto corners = mesh::corner_points(model.mesh, first);
    const Point<dim> normal = outward_normal(corners);
    for (const Point<dim>& x : corners) {
      const Point<dim> jump =
          displacement_at(model, u, second.element, x) - displacement_at(model, u, first.element, x);
      if (-jump.dot(normal) > largest.depth) largest = {-jump.dot(normal), x};
    }
  }
  return largest;
}

}  // namespace

template <int dim>
Overlap<dim> largest_overlap(const base::Comm& comm, const CoupledModel<dim>& model,
                             const std::vector<FacingSides>& facing, base::ConstField u) {
  const auto own = own_overlap(model, facing, u);
  std::vector<double> numbers = {own.depth};
  numbers.insert(numbers.end(), own.place.begin(), own.place.end());
  const auto all = base::gather_on_all(comm, numbers);
  Overlap<dim> largest;
  for (auto one = all.begin(); one != all.end(); one += dim + 1) {
    if (*one > largest.depth) largest = {*one, Eigen::Map<const Point<dim>>(&one[1])};
  }
  return largest;
}

#define PERIMORPH_INSTANTIATE(dim)                                                                                    \
  template std::vector<FacingSides> facing_sides(const mesh::Mesh<dim>&, const std::vector<char>&);                   \
  template Overlap<dim> largest_overlap(const base::Comm&, const CoupledModel<dim>&, const std::vector<FacingSides>&, \
                                        base::ConstField);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::operators
