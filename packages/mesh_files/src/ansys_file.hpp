#pragma once

#include "mesh_file.hpp"

namespace perimorph::mesh_files {

/// Parses an ANSYS archive in blocked form (CDWRITE, Workbench): ET, ETBLOCK, TYPE, NBLOCK, EBLOCK and CMBLOCK; other
/// commands are skipped. Elements are solid ones of first or second order; a quadrangle with a repeated node is a
/// triangle, a hexahedron collapsed to a wedge, a pyramid or a tetrahedron is one. Elements without a body (contact,
/// masses, springs, ...) are passed over. Components of nodes become node sets, and side sets by the boundary's
/// sides between their nodes. Components of elements become blocks if each element is in exactly one; otherwise each
/// material is a block, "material_1". Local.
/// @throws UserError if the file cannot be read, is truncated or damaged, or has other elements.
MeshFile read_ansys_file(const std::string& file);

}  // namespace perimorph::mesh_files
