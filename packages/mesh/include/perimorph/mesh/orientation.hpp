#pragma once

#include "perimorph/mesh/mesh.hpp"

namespace perimorph::mesh {

/// Smallest over an element's corners of the volume (area in 2D) spanned there by its edges, relative to the product of
/// their lengths, in [-1, 1] [-]: 1 for a rectangle or a cuboid, 0 for a degenerate element, negative for an inverted
/// one. Local.
/// @param element local index
template <int dim>
double smallest_corner_volume(const Mesh<dim>& mesh, int element);

}  // namespace perimorph::mesh
