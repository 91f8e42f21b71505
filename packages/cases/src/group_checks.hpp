#pragma once

#include <Teuchos_ParameterList.hpp>
#include <map>
#include <string>

#include "perimorph/input/mistakes.hpp"
#include "perimorph/mesh/mesh.hpp"

namespace perimorph::cases {

/// That the groups which a case names exist in its mesh, and are of the right kind. Local.
/// @param lines where the case's parameters stand in its file
template <int dim>
void check_groups(const Teuchos::ParameterList& list, const std::map<std::string, int>& lines,
                  const mesh::Mesh<dim>& whole, input::Mistakes& mistakes);

}  // namespace perimorph::cases
