#pragma once

#include <string>
#include <vector>

#include "perimorph/base/parallel.hpp"
#include "perimorph/cases/case.hpp"
#include "perimorph/input/mistakes.hpp"
#include "perimorph/mesh/mesh.hpp"

namespace perimorph::cases {

inline constexpr const char* displacements_path = "/Boundary Conditions/Displacements";
inline constexpr const char* rigid_groups_path = "/Boundary Conditions/Rigid Groups";
inline constexpr const char* symmetry_planes_path = "/Boundary Conditions/Symmetry Planes";

/// Every part of the body is held against all rigid motions, also where parts hang on each other by hinges only. Local.
/// @param whole opened along the pre-cracks; all groups of the displacements are in it
/// @param planes of symmetry, which hold it too
template <int dim>
void check_free_motions(const Case& input, const mesh::Mesh<dim>& whole, const std::vector<mesh::SymmetryPlane>& planes,
                        input::Mistakes& mistakes);

/// Whether supports hold a body of one part against all rigid motions; they may, too, where this does not say so.
/// Collective.
/// @param part what each rank has of the body, as above
template <int dim>
bool is_surely_held(const base::Comm& comm, const Case& input, const mesh::Mesh<dim>& part,
                    const std::vector<mesh::SymmetryPlane>& planes);

/// Where a mesh does not hold together although it looks so: parts that touch or overlap and share no nodes, sides that
/// lie on each other, hinges. A line each. Local.
/// @param whole not opened along the pre-cracks yet
template <int dim>
std::vector<std::string> loose_connections(const mesh::Mesh<dim>& whole);

}  // namespace perimorph::cases
