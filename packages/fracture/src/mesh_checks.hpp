#pragma once

#include "perimorph/fracture/case.hpp"
#include "perimorph/mesh/mesh.hpp"

namespace perimorph::fracture {

/// What a case and its whole mesh must agree on: the groups exist and are of the right kind, no two displacements
/// contradict each other on a node, and every part of the body (elements connected by nodes) is held against all rigid
/// motions. Local.
/// @throws UserError that lists all mistakes, a line each.
template <int dim>
void check_against_mesh(const Case& input, const mesh::Mesh<dim>& whole);

}  // namespace perimorph::fracture
