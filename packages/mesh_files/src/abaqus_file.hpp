#pragma once

#include "mesh_file.hpp"

namespace perimorph::mesh_files {

/// Reads the mesh of an input file of Abaqus up to its first step: nodes, elements of first or second order, node sets,
/// element sets, surfaces, with parts and instances or without, and files that it includes. Node sets become node sets,
/// and side sets by the boundary's sides between their nodes; surfaces become side sets. Sets of sections become blocks
/// if each element is in exactly one; otherwise those of *ELEMENT if each has one. Of several instances, sets are
/// called "instance.set". Local.
/// @throws UserError if the file cannot be read, is damaged, has other elements, or leaves making nodes or elements to
///         Abaqus (*NGEN and the like).
MeshFile read_abaqus_file(const std::string& file);

}  // namespace perimorph::mesh_files
