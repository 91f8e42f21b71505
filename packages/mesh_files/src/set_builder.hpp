#pragma once

#include <string>
#include <vector>

#include "file_groups.hpp"
#include "file_nodes.hpp"
#include "part_sides.hpp"

namespace perimorph::mesh_files {

/// Makes node sets and side sets of the groups of lower dimension that fit the mesh, for each rank's own nodes and
/// elements; a note says which do not. The names are the same on all ranks. Collective.
/// @param part  gets the sets
/// @param sides of the part
/// @return node sets of which side sets are still to be made: sides of the boundary with all their nodes in the set
/// @throws UserError if an element has a node that the file does not list, or a group no readable name
template <int dim>
std::vector<std::string> add_sets(const base::Comm& comm, const MeshFile& slice, const FileGroups& groups,
                                  const FileNodes<dim>& nodes, const PartSides<dim>& sides, mesh::Mesh<dim>& part,
                                  Remarks& remarks);

/// Makes side sets of node sets: of the sides of the part's boundary all whose nodes are in the set, if any rank has
/// one. Collective.
/// @param part has all of its boundary, and of each set all of its nodes that are in it
template <int dim>
void add_sides_between(const base::Comm& comm, const std::vector<std::string>& sets, mesh::Mesh<dim>& part);

}  // namespace perimorph::mesh_files
