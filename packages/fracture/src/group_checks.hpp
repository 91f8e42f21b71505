#pragma once

#include <Teuchos_ParameterList.hpp>
#include <map>
#include <string>

#include "mistakes.hpp"
#include "perimorph/mesh/mesh.hpp"
#include "resolve.hpp"

namespace perimorph::fracture {

/// That the groups which a case names exist in its mesh, and are of the right kind. Local.
/// @param lines where the case's parameters stand in its file
template <int dim>
void check_groups(const Teuchos::ParameterList& list, const std::map<std::string, int>& lines,
                  const mesh::Mesh<dim>& whole, Mistakes& mistakes);

/// The same of a case that has other mistakes, or that its mesh can be read at all; nothing if the mesh's name or
/// dimension is wrong itself. Local.
/// @param folder that the mesh's name is relative to
void check_groups(const Resolved& resolved, const std::string& folder, Mistakes& mistakes);

}  // namespace perimorph::fracture
