#pragma once

#include <utility>
#include <vector>

#include "perimorph/base/parallel.hpp"
#include "perimorph/mesh/mesh.hpp"

// Which elements of a body hold together. They do by a side that they share. Those that share only a node, or in three
// dimensions an edge, can turn about it: a hinge. Those that only lie beside each other share nothing at all.

namespace perimorph::mesh {

/// A node at which the elements around it are in several groups, each connected by sides through the node.
struct Hinge {
  int node;
  std::vector<std::vector<int>> groups;  ///< local elements, ascending; two groups or more
};

/// The hinges of a whole mesh, by ascending node. Local.
template <int dim>
std::vector<Hinge> hinges(const Mesh<dim>& whole);

/// The part of the body that each element is in, (n_elements), from 0 by lowest element: elements that share a node are
/// of one part, unless that node is a hinge between them. Local.
/// @param hinges of this mesh, or none, for parts that hinges connect
template <int dim>
std::vector<int> parts_of_elements(const Mesh<dim>& mesh, const std::vector<Hinge>& hinges = {});

/// How a mesh holds together, whichever rank has what of it.
struct Connections {
  GlobalId n_parts;  ///< that share no nodes but hinges
  GlobalId n_hinges;
};

/// Collective. @param part what distribute() has made, or a whole mesh on rank 0
template <int dim>
Connections connections(const base::Comm& comm, const Mesh<dim>& part);

/// Nodes of the boundary of a whole mesh that lie at the same place, within 1e-6 of the element's radius, in pairs:
/// where a body is open although it looks closed. Ascending. Local.
template <int dim>
std::vector<std::pair<int, int>> coincident_nodes(const Mesh<dim>& whole);

}  // namespace perimorph::mesh
