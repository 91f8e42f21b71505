#pragma once

#include "perimorph/base/parallel.hpp"
#include "perimorph/cases/case.hpp"
#include "perimorph/input/mistakes.hpp"
#include "perimorph/mesh/mesh.hpp"

namespace perimorph::cases {

/// Opens a case's whole mesh along the pre-cracks, and finds what the two must agree on: pre-cracks and seeds are in
/// the body, groups exist and are of the right kind, no two displacements contradict each other on a node, every part
/// of the body is held against all rigid motions, probes are in it, and the horizon reaches beyond the elements inside
/// the seeds, but not beyond the body. Local.
/// @param input of a case with mistakes, what is sound; nothing is said of what depends on the rest
/// @param mistakes those of the case; to these are added
/// @return what can be computed, but is hardly meant so, a line each; nothing if there are mistakes
template <int dim>
std::vector<std::string> open_and_check(const Case& input, mesh::Mesh<dim>& whole, input::Mistakes& mistakes);

/// The same of a mesh in parts, without words: opens it if there is surely no mistake and nothing to be said. The
/// checks are made where the mesh is, and are on the safe side: what may be wrong between parts of the body, and
/// whatever is wrong, only a look at the whole can tell. Collective.
/// @param input of a case without mistakes
/// @param part what mesh::distribute() has made; on return, if it is sound, opened along the pre-cracks, otherwise of
/// no
///        use
template <int dim>
bool open_if_sound(const base::Comm& comm, const Case& input, mesh::Mesh<dim>& part);

}  // namespace perimorph::cases
