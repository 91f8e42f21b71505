#pragma once

#include <utility>
#include <vector>

#include "perimorph/mesh/mesh.hpp"

// Two elements may have a side in common in two ways. By its nodes: the body is connected there, which it is not across
// a pre-crack, where open_along() doubled the nodes. By its place: the sides lie on each other, as the faces of a
// pre-crack do too.

namespace perimorph::mesh {

/// The side of an element all of whose nodes belong to another element as well; -1 if there is none. Local.
/// @param element,other local indices
template <int dim>
int shared_side(const Mesh<dim>& mesh, int element, int other);

/// Sides whose corners are at the same places, to the last bit, in pairs: each in the order of the list, and pairs in
/// the order of their second sides. Local.
/// @param sides to choose from, each given once
template <int dim>
std::vector<std::pair<Side, Side>> coincident_sides(const Mesh<dim>& mesh, const std::vector<Side>& sides);

}  // namespace perimorph::mesh
