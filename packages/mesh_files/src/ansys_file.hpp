#pragma once

#include "mesh_file.hpp"

namespace perimorph::mesh_files {

/// Parses an ANSYS archive in blocked form (CDWRITE): ET, NBLOCK, EBLOCK and CMBLOCK; other commands are skipped.
/// Elements are PLANE42/182 and SOLID45/185; a quadrangle with a repeated node is a triangle, a hexahedron collapsed to
/// a wedge, a pyramid or a tetrahedron is one. Components of nodes become node sets, and side sets by the boundary's
/// sides between their nodes. Components of elements become blocks if each element is in exactly one; otherwise each
/// material is a block, "material_1". Local.
/// @throws UserError if the file cannot be read, is truncated or damaged, or has other elements.
MeshFile read_ansys_file(const std::string& file);

}  // namespace perimorph::mesh_files
