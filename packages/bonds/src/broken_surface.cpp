#include "perimorph/bonds/broken_surface.hpp"

#include <algorithm>
#include <tuple>

namespace perimorph::bonds {

namespace {

/// The side of an element that another one shares; -1 if they share none.
template <int dim>
int common_side(const mesh::Mesh<dim>& mesh, int element, int other) {
  const int* corners = mesh.corners_of(other);
  const auto is_shared = [&](int corner) {
    const int* end = corners + mesh.n_corners(other);
    return std::find(corners, end, mesh.corners_of(element)[corner]) != end;
  };
  const auto& sides = mesh::sides(mesh.types[element]);
  const auto found = std::find_if(sides.begin(), sides.end(),
                                  [&](const auto& side) { return std::all_of(side.begin(), side.end(), is_shared); });
  return found == sides.end() ? -1 : static_cast<int>(found - sides.begin());
}

template <int dim>
bool is_mostly_broken(const BondFamilies<dim>& bonds, int pair) {
  const auto first = bonds.first_bond(pair), end = bonds.first_bond(pair + 1);
  std::size_t n_broken = 0;
  for (auto b = first; b < end; ++b) n_broken += bonds.broken(b);
  return 2 * n_broken >= end - first;
}

}  // namespace

template <int dim>
std::vector<mesh::Side> broken_surface(const mesh::Mesh<dim>& mesh, const BondFamilies<dim>& bonds) {
  std::vector<mesh::Side> surface;
  for (int p = 0; p < bonds.n_pairs(); ++p) {
    const auto [a, b] = bonds.pair(p);
    if (a == b || !bonds.is_damaged(a) || !bonds.is_damaged(b)) continue;
    const int side_of_a = common_side(mesh, a, b);
    if (side_of_a < 0 || !is_mostly_broken(bonds, p)) continue;
    if (a < mesh.n_owned_elements) surface.push_back({a, side_of_a});
    if (b < mesh.n_owned_elements) surface.push_back({b, common_side(mesh, b, a)});
  }
  std::sort(surface.begin(), surface.end(), [](const mesh::Side& x, const mesh::Side& y) {
    return std::tie(x.element, x.side) < std::tie(y.element, y.side);
  });
  return surface;
}

template std::vector<mesh::Side> broken_surface(const mesh::Mesh<2>&, const BondFamilies<2>&);
template std::vector<mesh::Side> broken_surface(const mesh::Mesh<3>&, const BondFamilies<3>&);

}  // namespace perimorph::bonds
