#pragma once

#include <string>
#include <vector>

#include "perimorph/base/parallel.hpp"
#include "perimorph/mesh/mesh.hpp"
#include "perimorph/mesh/pre_crack.hpp"

namespace perimorph::mesh {

/// The plane of symmetry across an axis that a node set lies on. Collective. @param mesh whole or one rank's part
/// @throws UserError on all ranks if the nodes are not on such a plane, or the body is on both of its sides
template <int dim>
SymmetryPlane symmetry_plane(const base::Comm& comm, const Mesh<dim>& mesh, const std::string& node_set);

/// Makes the body go on as its mirror image beyond planes of symmetry: adds the images of elements near to them, also
/// across two or three of them. Each rank's images are those of its own local elements: a point is nearer to another
/// one than to that one's image, so what is in reach of an image is in the halo. Local.
/// @param mesh without images
/// @param planes across different axes
/// @param width how far beyond the planes to go, such as the horizon, [length]
template <int dim>
void add_images(Mesh<dim>& mesh, std::vector<SymmetryPlane> planes, double width);

/// Facets and what they become beyond the planes, the same facets first. Local.
template <int dim>
std::vector<CrackFacet<dim>> with_images(const std::vector<CrackFacet<dim>>& facets,
                                         const std::vector<SymmetryPlane>& planes);

}  // namespace perimorph::mesh
