#pragma once

#include <vector>

#include "perimorph/operators/coupled_model.hpp"

namespace perimorph::operators {

/// Displacement at every point of the elements that have bonds (zero elsewhere): B u.
/// @param u on all local degrees of freedom (copies too), [length]
template <int dim>
std::vector<base::Point<dim>> displacements_at_points(const CoupledModel<dim>& model, const double* u);

/// Element averages for output, one entry per owned element.
template <int dim>
struct ElementFields {
  std::vector<double> energy;            ///< strain energy in the element: local + half of each of its bonds', [energy]
  std::vector<base::Voigt<dim>> stress;  ///< E(x) eps + 1/2 Sum k (xi . eta) xi (x) xi / w, [stress]
};

/// @param u on all local degrees of freedom; @param at_points B u (displacements_at_points). Local.
template <int dim>
ElementFields<dim> element_fields(const CoupledModel<dim>& model, const double* u,
                                  const std::vector<base::Point<dim>>& at_points);

}  // namespace perimorph::operators
