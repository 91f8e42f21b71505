#pragma once

#include <vector>

#include "perimorph/fracture/body.hpp"
#include "perimorph/io/exodus.hpp"

namespace perimorph::output {

/// FE, MORPH, PD: a continuous element by its class; DGFE: a peridynamic one that has been split off; from 0. Local.
template <int dim>
int kind_of(const fracture::Body<dim>& body, int element);

/// The body in its present topology as a file has it, and how this rank's values get to their places there.
template <int dim>
struct FileLayout {
  io::ExodusModel<dim> model;  ///< the whole body, on rank 0; or what this rank owns
  std::vector<int> nodes;      ///< local nodes whose values this rank has to give, in this order
  /// On rank 0 the place of each element in the order of gathering; in spread files of each own element.
  std::vector<int> element_place;
};

/// For one file of the whole body. Collective.
/// @param broken_surface sides of local elements along cracks
template <int dim>
FileLayout<dim> gathered_layout(const base::Comm& comm, const fracture::Body<dim>& body,
                                const std::vector<mesh::Side>& broken_surface);

/// For a file of this rank's elements with all their nodes. Collective.
template <int dim>
FileLayout<dim> spread_layout(const base::Comm& comm, const fracture::Body<dim>& body,
                              const std::vector<mesh::Side>& broken_surface);

}  // namespace perimorph::output
