#pragma once

#include <vector>

#include "perimorph/mesh/pre_crack.hpp"

namespace perimorph::mesh {

/// Whether a pre-crack can part anything: none of it may be in the body, or only on its surface; and it may be too
/// short, less than a quarter of each element that it is in.
enum class CrackPlace { outside, too_short, inside };

/// Local.
/// @param whole a mesh that is not opened along the crack yet
/// @param crack facets, (n), [length]
/// @param size of the elements that count, in that of the mesh's [-]: below 1 where it will be refined
template <int dim>
CrackPlace place_of(const Mesh<dim>& whole, const std::vector<CrackFacet<dim>>& crack, double size = 1.);

}  // namespace perimorph::mesh
