#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "perimorph/mesh/mesh.hpp"

namespace perimorph::mesh {

inline constexpr int max_levels = 12;

/// An element of a refined mesh, by the way down to it from an element of the root mesh.
struct ElementPath {
  int root;                ///< local element of the root mesh
  int level;               ///< how often it has been divided, 0 ... max_levels
  std::uint64_t children;  ///< which child at each level, four bits each, the first one highest
};

/// At least how often elements are to be divided at a place, given the element's centroid, (dim), its radius and the
/// mean edge of the root element that it is in, [length].
template <int dim>
using LevelRule = std::function<int(const Point<dim>& centroid, double radius, double root_edge)>;

/// A mesh that is finer in places than its root.
template <int dim>
struct RefinedMesh {
  Mesh<dim> mesh;                  ///< whole; elements are in the order of their paths, nodes of the root come first
  std::vector<ElementPath> paths;  ///< of its elements
  /// Of its nodes (perturbation.hpp), by where they are in the tree: the same in all meshes of one root that have them.
  std::vector<std::uint64_t> node_keys;
};

/// Divides triangles and quadrilaterals of a whole mesh into four, tetrahedra and hexahedra into eight, again and again
/// as a rule says, and where else it must be so that elements at a node differ by one level at most: no parent of a
/// hanging node hangs then. Groups and boundary follow: the nodes of a side set's sides are in the node set of its
/// name, and of other sets those between nodes that are. Pre-cracks along sides stay open. Local.
/// @param root without hanging nodes
/// @throws UserError if a wedge or a pyramid would have to be divided
template <int dim>
RefinedMesh<dim> refine(const Mesh<dim>& root, const LevelRule<dim>& level_at);

/// Where an element of a finer mesh lies in one of a coarser mesh of the same root.
struct Descent {
  int ancestor;                              ///< element of the coarser mesh; perhaps the same
  std::vector<std::vector<double>> weights;  ///< of its corners in each corner's place; empty if it is the same
};

/// For every element of the finer mesh, whose elements are all elements of the coarser one or in one of these. Local.
template <int dim>
std::vector<Descent> descents(const RefinedMesh<dim>& coarser, const RefinedMesh<dim>& finer);

}  // namespace perimorph::mesh
