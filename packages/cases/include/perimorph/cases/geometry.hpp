#pragma once

#include <string>
#include <vector>

#include "perimorph/base/errors.hpp"
#include "perimorph/base/parallel.hpp"
#include "perimorph/cases/case.hpp"
#include "perimorph/mesh/mesh.hpp"
#include "perimorph/mesh/pre_crack.hpp"
#include "perimorph/morphing/morphing_field.hpp"

namespace perimorph::cases {

/// Numbers of a case as a point, from the offset on, (dim), [length]. Local.
template <int dim>
base::Point<dim> point(const std::vector<double>& values, std::size_t offset = 0) {
  PERIMORPH_ASSERT(offset + dim <= values.size(), "a point from number {} of {}", offset, values.size());
  return Eigen::Map<const base::Point<dim>>(values.data() + offset);
}

/// Of a seed that is not automatic: these have no place yet. Local.
template <int dim>
morphing::Zone<dim> zone_of(const Seed& seed);

/// Of all pre-cracks, in a row. Local.
template <int dim>
std::vector<mesh::CrackFacet<dim>> facets_of(const std::vector<PreCrack>& cracks);

/// Where a probe measures: the given points and those that divide the segments between them, in order,
/// [length]. Local.
template <int dim>
std::vector<base::Point<dim>> places_of(const Probe& probe);

/// The case's mesh, not opened along its pre-cracks yet. A .geo file is meshed by gmsh first, and the mesh kept in the
/// folder. Local.
/// @throws UserError if it cannot be read.
template <int dim>
mesh::Mesh<dim> read_closed_mesh(const Case& input, const std::string& folder);

/// The same in parts, as mesh::distribute() makes them, without a halo's width. Collective. @throws UserError, as
/// above, on all ranks.
template <int dim>
mesh::Mesh<dim> read_closed_parts(const base::Comm& comm, const Case& input, const std::string& folder);

}  // namespace perimorph::cases
