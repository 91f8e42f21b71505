#pragma once

#include <vector>

#include "perimorph/base/field.hpp"
#include "perimorph/operators/coupled_model.hpp"

namespace perimorph::operators {

/// Sides of two elements that lie on each other in the reference mesh but may part.
struct FacingSides {
  mesh::Side first, second;
};

/// Those between an element that is discontinuous and its neighbours, and those along pre-cracks; each on the rank that
/// owns the first element. Local.
/// @param discontinuous per local element, right in the halo too
template <int dim>
std::vector<FacingSides> facing_sides(const mesh::Mesh<dim>& mesh, const std::vector<char>& discontinuous);

/// How far two crack faces have passed through each other.
template <int dim>
struct Overlap {
  double depth = 0.;                                  ///< along the normal, [length]; 0 where none do
  base::Point<dim> place = base::Point<dim>::Zero();  ///< in the reference mesh, (dim), [length]
};

/// The largest one of all ranks: -(u2 - u1) . n at the corners of sides whose elements no unbroken bond joins, with the
/// normal n of the reference mesh, as strains are small. Collective.
/// @param facing what facing_sides() returned for the present topology
/// @param u on all local degrees of freedom (copies too), [length]
template <int dim>
Overlap<dim> largest_overlap(const base::Comm& comm, const CoupledModel<dim>& model,
                             const std::vector<FacingSides>& facing, base::ConstField u);

}  // namespace perimorph::operators
