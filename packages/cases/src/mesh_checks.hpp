#pragma once

#include "perimorph/cases/case.hpp"
#include "perimorph/input/mistakes.hpp"
#include "perimorph/mesh/mesh.hpp"

namespace perimorph::cases {

/// What a case and its whole mesh must agree on: the groups exist and are of the right kind, no two displacements
/// contradict each other on a node, every part of the body (elements connected by nodes) is held against all rigid
/// motions, probes are in it, and the horizon reaches beyond the elements inside the seeds. Local.
/// @param input of a case with mistakes, what is sound; nothing is said of what depends on the rest
/// @param mistakes those of the case; to these are added
template <int dim>
void check_against_mesh(const Case& input, const mesh::Mesh<dim>& whole, input::Mistakes& mistakes);

}  // namespace perimorph::cases
