#pragma once

#include "perimorph/cases/case.hpp"
#include "perimorph/input/mistakes.hpp"
#include "perimorph/mesh/mesh.hpp"

namespace perimorph::cases {

/// Pre-cracks part something, and seeds reach the body. Local.
/// @param whole not opened along the pre-cracks yet
template <int dim>
void check_places(const Case& input, const mesh::Mesh<dim>& whole, input::Mistakes& mistakes);

}  // namespace perimorph::cases
