#pragma once

#include <string>

#include "perimorph/mesh/mesh.hpp"

namespace perimorph::mesh {

/// Reads a gmsh file (MSH 4.1 or 2.2, ASCII or binary) as a whole mesh, boundary included. Local; called on rank 0.
/// Named physical groups become blocks, node sets and side sets (Mesh says how); an unnamed one is called by its
/// dimension and number, "surface_1". Sides of a side set are found among the elements' boundary and inner sides (the
/// element with the lower id where two share it).
/// @throws UserError naming file, element or group: unknown version, truncated file, elements of a wrong kind
///         (other than Q4/T3 in 2D, H8/T4 in 3D; of second order), inverted or degenerate elements, nodes that no
///         element uses, elements in no physical group or in two of the mesh's dimension, counts that the file's size
///         cannot hold.
template <int dim>
Mesh<dim> read_gmsh(const std::string& file);

/// Runs gmsh (a separate process) on a .geo file and keeps the result as msh_file (MSH 4.1 binary). Local.
/// @throws UserError with gmsh's own last messages if it fails or gmsh is not installed.
void mesh_geometry(const std::string& geo_file, const std::string& msh_file, int dimension);

}  // namespace perimorph::mesh
