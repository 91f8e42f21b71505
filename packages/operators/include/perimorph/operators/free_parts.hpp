#pragma once

#include <string>
#include <vector>

#include "perimorph/discretization/space.hpp"
#include "perimorph/operators/coupled_model.hpp"

namespace perimorph::operators {

/// Why there may be no equilibrium: the first part of the body that loads act on and nothing holds, or nothing but
/// bonds that would break, in words; empty if there is none. Parts are what elements, unbroken bonds, closed
/// contacts and rigid groups hold together. That a part which is held may still turn is not looked at. The same on all
/// ranks. Collective.
/// @param loads on owned degrees of freedom, [force]
/// @param contacts that are closed
/// @param failing bonds beyond their critical stretch, by ascending number
template <int dim>
std::string what_is_free(const base::Comm& comm, const CoupledModel<dim>& model,
                         const discretization::Space<dim>& space, const std::vector<double>& loads,
                         const std::vector<ContactSpring<dim>>& contacts, const std::vector<bonds::BondId>& failing);

}  // namespace perimorph::operators
