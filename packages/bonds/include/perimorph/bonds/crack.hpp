#pragma once

#include <array>
#include <vector>

#include "perimorph/bonds/bond_families.hpp"

namespace perimorph::bonds {

/// A side (edge in 2D, face in 3D) that two elements share, and across which more than half of the bonds between the
/// two are broken. Trivially copyable, so that it can travel.
template <int dim>
struct OpenSide {
  static constexpr int max_corners = 1 << (dim - 1);

  base::GlobalId first, second;                             ///< elements, by ascending id
  int n_corners;                                            ///< of the side
  std::array<std::array<double, dim>, max_corners> points;  ///< corners in the undeformed body, [length]

  bool operator<(const OpenSide& other) const {
    return first != other.first ? first < other.first : second < other.second;
  }
};

/// The open sides whose first element this rank owns, ascending: over all ranks each is there once. A pre-crack has
/// none, since no bond ever crossed it. Local.
/// @param bonds those between the points of this mesh
template <int dim>
std::vector<OpenSide<dim>> open_sides(const mesh::Mesh<dim>& mesh, const BondFamilies<dim>& bonds);

/// The surface of cracks for pictures: the open sides of owned elements, ascending. A crack between two elements shows
/// up once for either of them. Sides along pre-cracks are the body's boundary, and not among them. Local.
/// @param bonds those between the points of this mesh
template <int dim>
std::vector<mesh::Side> broken_surface(const mesh::Mesh<dim>& mesh, const BondFamilies<dim>& bonds);

/// Length (2D) or area (3D) of a side, [length^(dim-1)].
template <int dim>
double size(const OpenSide<dim>& side);

/// Length (2D) or area (3D) of the crack that open sides stand for. They follow the elements' sides, so a slanting
/// crack is a staircase of them. Each side is projected onto the crack's mean plane around it: the plane through the
/// corners of all open sides within a radius (least squares, weighted by size). Local.
/// @param sides of all ranks: a mean plane needs the neighbours, (n)
/// @param radius some elements, such as the horizon, >= 0, [length]
/// @return [length^(dim-1)]
template <int dim>
double crack_size(const std::vector<OpenSide<dim>>& sides, double radius);

}  // namespace perimorph::bonds
