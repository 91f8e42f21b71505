#pragma once

#include "perimorph/fracture/body.hpp"

namespace perimorph::application {

/// The load factor at which the first bond reaches the critical stretch or, if it softens, the limit, if displacements
/// grow with the load as up to the present one; infinite if no bond that may break is stretched. Collective.
/// @param body solved at a load factor other than 0, its loads proportional
template <int dim>
double load_of_first_break(const base::Comm& comm, const fracture::Body<dim>& body);

}  // namespace perimorph::application
