#pragma once

#include "mesh_file.hpp"
#include "perimorph/base/parallel.hpp"

namespace perimorph::mesh_files {

/// Whether read_slice() can read a file: Exodus and MSH. Damaged ones, too, of which it says what is wrong. Of binary
/// MSH 4.1 and of Exodus a slice takes a part of the time of the whole; of other MSH each rank goes through all, and
/// keeps its slice. Local.
bool can_be_sliced(const std::string& file);

/// This rank's slice of a mesh file that can be sliced: about as many nodes, and elements of each dimension, as on any
/// other rank. One rank's nodes after the other's are those of the file in its order; so are elements of one dimension,
/// but for those that make up Exodus' sets: sides are with their element, members of node sets with their node.
/// Elements may have nodes that are in other slices. Names of groups, and what else is said of the whole file, are the
/// same on all ranks; notes are on rank 0 only; what counts or lists nodes or elements is of the slice. Memory is
/// proportional to the slice, but for names, the descriptions of blocks and, of MSH, entities. All ranks must see the
/// file. Collective.
/// @throws UserError, the same on all ranks, as the readers of whole files do; of several mistakes in a file it may
///         name another one.
MeshFile read_slice(const base::Comm& comm, const std::string& file);

}  // namespace perimorph::mesh_files
