#pragma once

#include "mesh_file.hpp"
#include "perimorph/base/parallel.hpp"

namespace perimorph::mesh_files {

/// Reads the mesh of an Exodus file (netCDF, classic or HDF5) with its blocks, node sets and side sets. A node set with
/// the name and nodes of a side set is the same group. What has no name is called by its number: "block_1", "nodes_2",
/// "sides_3". Local.
/// @throws UserError if the file cannot be read, is truncated or damaged, announces more than it can hold, or has
///         elements of an unknown type; bars, spheres and the like are passed over with a note.
MeshFile read_exodus_file(const std::string& file);

/// The same, of which each rank reads its share of the nodes and of the elements of each dimension, in the file's
/// order; members of node sets come where the node is, sides where their element is. The groups are all there on every
/// rank, the notes on rank 0. Collective.
MeshFile read_exodus_file(const base::Comm& comm, const std::string& file);

}  // namespace perimorph::mesh_files
