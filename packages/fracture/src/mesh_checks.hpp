#pragma once

#include "perimorph/fracture/case.hpp"
#include "perimorph/mesh/mesh.hpp"
#include "perimorph/morphing/morphing_field.hpp"

namespace perimorph::fracture {

/// What a case and its whole mesh must agree on: the groups exist and are of the right kind, no two displacements
/// contradict each other on a node, every part of the body (elements connected by nodes) is held against all rigid
/// motions, and the horizon reaches beyond the elements inside the seeds. Local.
/// @param seeds the zones of input.seeds, in that order
/// @throws UserError that lists all mistakes, a line each.
template <int dim>
void check_against_mesh(const Case& input, const std::vector<morphing::Zone<dim>>& seeds, const mesh::Mesh<dim>& whole);

}  // namespace perimorph::fracture
