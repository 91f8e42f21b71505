#pragma once

#include <string>
#include <vector>

#include "perimorph/cases/case.hpp"
#include "perimorph/mesh/mesh.hpp"

namespace perimorph::cases {

/// Supports that look like planes of symmetry and lie in a peridynamic zone: the bonds to the other half are missing
/// there, which matters to cracks. A line each, with the parameter. Local.
/// @param whole opened along the pre-cracks
template <int dim>
std::vector<std::string> advice_on_supports(const Case& input, const mesh::Mesh<dim>& whole);

}  // namespace perimorph::cases
