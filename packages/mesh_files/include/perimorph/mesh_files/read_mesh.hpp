#pragma once

#include <string>
#include <vector>

#include "perimorph/mesh/mesh.hpp"

namespace perimorph::mesh_files {

/// Endings of the files that read_mesh() knows: ".msh" (gmsh's MSH 4.1 or 2.2, ASCII or binary), ".e" and ".exo"
/// (Exodus), ".cdb" (ANSYS archive in blocked form).
const std::vector<std::string>& mesh_file_endings();

/// Reads a mesh file, its format chosen by its ending, as a whole mesh, boundary included. Local; called on rank 0.
/// The file's groups become blocks, node sets and side sets (Mesh says how). gmsh: named physical groups; an unnamed
/// one is called by dimension and number, "surface_1". Exodus: element blocks, node sets and side sets, "block_1",
/// "nodes_2", "sides_3" if unnamed; the nodes of a side set are a node set, too. ANSYS: components; of elements, if
/// each element is in exactly one, otherwise its material, "material_1"; one of nodes is also a side set of the
/// boundary's sides between them. Sides of a side set are those of the element with the lower id where two share it.
/// @param scale factor on all coordinates, > 0, [-]: 1000 for a file in m and a case in mm
/// @throws UserError naming file, element or group: unknown ending or version; unreadable or truncated file; counts
/// that
///         the file cannot hold; elements of a wrong kind (other than Q4/T3 in 2D, H8/W6/P5/T4 in 3D), of second order,
///         inverted or degenerate; nodes that no element uses; elements in no group or in two.
template <int dim>
mesh::Mesh<dim> read_mesh(const std::string& file, double scale = 1.);

/// The same, also of gmsh's geometry, .geo: it is meshed first, and the mesh kept in a folder. Local.
/// @param folder that exists, for the mesh of a geometry
template <int dim>
mesh::Mesh<dim> mesh_and_read(const std::string& file, const std::string& folder, double scale = 1.);

}  // namespace perimorph::mesh_files
