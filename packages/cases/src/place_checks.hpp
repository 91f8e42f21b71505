#pragma once

#include "perimorph/base/parallel.hpp"
#include "perimorph/cases/case.hpp"
#include "perimorph/input/mistakes.hpp"
#include "perimorph/mesh/mesh.hpp"

namespace perimorph::cases {

/// Pre-cracks part something, and seeds reach the body. Local.
/// @param whole not opened along the pre-cracks yet
template <int dim>
void check_places(const Case& input, const mesh::Mesh<dim>& whole, input::Mistakes& mistakes);

/// Whether they surely do; they may, too, where this does not say so. Collective.
/// @param part what mesh::distribute() has made of such a mesh
template <int dim>
bool are_surely_in_body(const base::Comm& comm, const Case& input, const mesh::Mesh<dim>& part);

}  // namespace perimorph::cases
