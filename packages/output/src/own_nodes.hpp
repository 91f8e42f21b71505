#pragma once

#include <algorithm>
#include <vector>

#include "perimorph/fracture/body.hpp"

namespace perimorph::output {

/// This rank's own nodes of the present numbering that come from some of the reference mesh.
/// @param reference_nodes ascending
template <int dim>
std::vector<int> own_nodes_in(const fracture::Body<dim>& body, const std::vector<int>& reference_nodes) {
  const auto& dofs = body.topology().dofs();
  std::vector<int> found;
  for (int n = 0; n < dofs.n_owned_nodes(); ++n) {
    if (std::binary_search(reference_nodes.begin(), reference_nodes.end(), dofs.reference_node(n))) found.push_back(n);
  }
  return found;
}

}  // namespace perimorph::output
