#pragma once

#include "mesh_file.hpp"

namespace perimorph::mesh_files {

/// A kind of gmsh's elements: its shape, and how many nodes it has, the corners first.
struct GmshKind {
  Shape shape;
  int n_nodes;
};

/// By gmsh's number of the kind; nullptr if it is none that a mesh can have.
const GmshKind* find_kind(int number);

}  // namespace perimorph::mesh_files
