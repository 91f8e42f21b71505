#pragma once

#include <string>

#include "perimorph/base/parallel.hpp"
#include "perimorph/mesh/mesh.hpp"
#include "perimorph/mesh_files/gmsh.hpp"

namespace perimorph::mesh_files {

/// Reads a mesh file as a whole mesh, boundary included. Its content decides what it is, its ending only if that says
/// nothing: gmsh's MSH 2.0 to 4.1, ASCII or binary (.msh); Exodus (.e, .exo, .g and others); an ANSYS archive in
/// blocked form (.cdb); an input file of Abaqus (.inp). Local; called on rank 0. The file's groups become blocks, node
/// sets and side sets (Mesh says how). gmsh: named physical groups; an unnamed one is called by dimension and number,
/// "surface_1". Exodus: element blocks, node sets and side sets, "block_1", "nodes_2", "sides_3" if unnamed; the nodes
/// of a side set are a node set, too. ANSYS: components; of elements, if each element is in exactly one, otherwise its
/// material, "material_1"; one of nodes is also a side set of the boundary's sides between them. Abaqus: sets of
/// sections or elements, node sets (with sides as those of ANSYS) and surfaces. Sides of a side set are those of the
/// element with the lower id where two share it. Elements of second order are taken by their corners, reversed ones
/// turned, those without volume, nodes of no element and groups that do not fit left out: the mesh's notes list each.
/// @param scale factor on all coordinates, > 0, [-]: 1000 for a file in m and a case in mm
/// @throws UserError naming file, element or group: unknown format or version; unreadable or truncated file; counts
///         that the file cannot hold; elements of a wrong kind (other than triangles and quadrangles in 2D, tetrahedra,
///         pyramids, wedges and hexahedra in 3D) or degenerate; elements in no group or in two.
template <int dim>
mesh::Mesh<dim> read_mesh(const std::string& file, double scale = 1.);

/// The same, also of gmsh's geometry, .geo: it is meshed first, and the mesh kept in a folder. Messages name the
/// geometry. Local.
/// @param folder that exists, for the mesh of a geometry
/// @param scale as for read_mesh() [-]
/// @param limits of a geometry
template <int dim>
mesh::Mesh<dim> mesh_and_read(const std::string& file, const std::string& folder, double scale = 1.,
                              const MeshingLimits& limits = {});

/// The same in parts, as mesh::distribute() makes them without a halo's width, with the notes on rank 0. Of gmsh's and
/// Exodus' files each rank keeps its own slice only; those of other formats rank 0 reads as a whole. Collective.
/// @throws UserError, as above, on all ranks; of several mistakes in a file it may name another one.
/// @param folder that all ranks see
template <int dim>
mesh::Mesh<dim> mesh_and_read_parts(const base::Comm& comm, const std::string& file, const std::string& folder,
                                    double scale = 1., const MeshingLimits& limits = {});

}  // namespace perimorph::mesh_files
