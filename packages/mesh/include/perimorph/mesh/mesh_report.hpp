#pragma once

#include <string>

#include "perimorph/mesh/mesh.hpp"

namespace perimorph::mesh {

/// What a whole mesh consists of, for people, some lines: elements by kind, groups with their sizes, bounding box, edge
/// lengths, and quality: the scaled Jacobian (at an element's worst corner the area or volume that its edges span
/// there, over the product of their lengths; 1 for a rectangle). Local.
/// @param whole a mesh of which all elements, at least one, are here
template <int dim>
std::string describe(const Mesh<dim>& whole);

}  // namespace perimorph::mesh
