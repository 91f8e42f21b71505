#pragma once

#include <array>
#include <string>
#include <vector>

#include "perimorph/base/parallel.hpp"
#include "perimorph/mesh/mesh.hpp"

namespace perimorph::mesh {

/// One flat piece of a pre-crack, without thickness: a segment in 2D, a triangle in 3D, [length].
template <int dim>
using CrackFacet = std::array<Point<dim>, dim>;

/// The segments of a line with these corners, two or more, (n), [length].
std::vector<CrackFacet<2>> polyline(const std::vector<Point<2>>& corners);

/// The triangles of a flat convex polygon with these corners in a row, three or more, (n), [length].
std::vector<CrackFacet<3>> polygon(const std::vector<Point<3>>& corners);

/// The triangles of the regular polygon of 64 sides around a disc: nodes on its rim are on it, and its area is 0.08 %
/// too large.
/// @param center (3), [length]
/// @param normal to the disc's plane, (3), of any length but 0
/// @param radius of the disc, > 0, [length]
std::vector<CrackFacet<3>> disc(const Point<3>& center, const Point<3>& normal, double radius);

/// Opens a mesh along a pre-crack: where the crack runs along sides of elements, the nodes strictly inside it (and on
/// the body's boundary) are doubled so that the two sides part; its tips stay closed. Node sets get the new nodes too,
/// the boundary the new sides. Sides count as on the crack if all corners lie on it within 1e-6 of their length. New
/// nodes have the same numbers whichever rank has what. Collective.
/// @param part a whole mesh on rank 0, or what distribute() has made of it; of that only the rank's own elements are
///        left, for distribute() to give it another halo
/// @param crack the pre-crack's facets, (n), [length]
/// @return how many sides were opened; 0 if the crack cuts through elements
template <int dim>
GlobalId open_along(const base::Comm& comm, Mesh<dim>& part, const std::vector<CrackFacet<dim>>& crack);

/// The same of a whole mesh. Local; called on rank 0.
template <int dim>
int open_along(Mesh<dim>& whole, const std::vector<CrackFacet<dim>>& crack);

}  // namespace perimorph::mesh
