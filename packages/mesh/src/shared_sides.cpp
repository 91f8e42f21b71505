#include "perimorph/mesh/shared_sides.hpp"

#include <algorithm>
#include <array>
#include <map>

namespace perimorph::mesh {

namespace {

/// The places of a side's corners, ascending.
template <int dim>
using Places = std::vector<std::array<double, dim>>;

template <int dim>
Places<dim> places_of(const Mesh<dim>& mesh, const Side& side) {
  Places<dim> places;
  for (const auto& x : corner_points(mesh, side)) {
    std::array<double, dim> place;
    std::copy(x.begin(), x.end(), place.begin());
    places.push_back(place);
  }
  std::sort(places.begin(), places.end());
  return places;
}

}  // namespace

template <int dim>
int shared_side(const Mesh<dim>& mesh, int element, int other) {
  const int *nodes = mesh.corners_of(element), *others = mesh.corners_of(other);
  const auto is_others = [&](int corner) {
    return std::find(others, others + mesh.n_corners(other), nodes[corner]) != others + mesh.n_corners(other);
  };
  const auto& all = sides(mesh.types[element]);
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const auto& s) { return std::all_of(s.begin(), s.end(), is_others); });
  return found == all.end() ? -1 : static_cast<int>(found - all.begin());
}

template <int dim>
std::vector<std::pair<Side, Side>> coincident_sides(const Mesh<dim>& mesh, const std::vector<Side>& sides) {
  std::map<Places<dim>, Side> waiting;
  std::vector<std::pair<Side, Side>> pairs;
  for (const Side& side : sides) {
    const auto [other, is_first] = waiting.emplace(places_of(mesh, side), side);
    if (!is_first) pairs.emplace_back(other->second, side);
  }
  return pairs;
}

#define PERIMORPH_INSTANTIATE(dim)                      \
  template int shared_side(const Mesh<dim>&, int, int); \
  template std::vector<std::pair<Side, Side>> coincident_sides(const Mesh<dim>&, const std::vector<Side>&);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::mesh
