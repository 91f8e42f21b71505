#pragma once

#include <map>
#include <string>
#include <vector>

#include "perimorph/mesh/mesh.hpp"

// A rank's part is put together from pieces, each of which another rank has cut out of its own part.

namespace perimorph::mesh {

/// Which rank is to own what of a part.
struct Owners {
  std::vector<int> elements;  ///< of the elements that the part owns
  std::vector<int> nodes;     ///< of all local nodes
};

using NodeSets = std::map<std::string, std::vector<int>>;  ///< as in Mesh

/// Some of the part's own elements with their nodes and what is known of them; hanging nodes apart, since parents may
/// come with another piece. Local.
/// @param node_sets in place of those of the part
/// @param elements local, ascending
template <int dim>
Mesh<dim> cut_out(const Mesh<dim>& part, const NodeSets& node_sets, const Owners& owners,
                  const std::vector<int>& elements);

/// The part of a rank, without hanging nodes and numbers of the whole. Local.
/// @param pieces that together have each of the rank's elements once
template <int dim>
Mesh<dim> join(const std::vector<Mesh<dim>>& pieces, int rank);

/// The part without its halo. All that is left belongs to this rank; nodes that others have, too, come as if they did.
/// Local.
template <int dim>
Mesh<dim> own_elements(const Mesh<dim>& part);

}  // namespace perimorph::mesh
