#pragma once

#include <vector>

#include "perimorph/discretization/space.hpp"
#include "perimorph/operators/coupled_model.hpp"

namespace perimorph::operators {

/// A part of the body that loads act on and nothing holds.
template <int dim>
struct FreePart {
  base::GlobalId n_nodes;   ///< of the present numbering
  base::Point<dim> center;  ///< mean of its nodes in the reference mesh, [length]
  base::Point<dim> load;    ///< resultant, in the directions in which no node is held, [force]
};

/// Those among the parts that elements and unbroken bonds hold together, by ascending number of their first node. That
/// a part which is held may still turn is not looked at. The same on all ranks. Collective.
/// @param loads on owned degrees of freedom, [force]
/// @param failing bonds that hold nothing though they have not broken, by ascending number
template <int dim>
std::vector<FreePart<dim>> free_parts(const base::Comm& comm, const CoupledModel<dim>& model,
                                      const discretization::Space<dim>& space, const std::vector<double>& loads,
                                      const std::vector<bonds::BondId>& failing = {});

}  // namespace perimorph::operators
