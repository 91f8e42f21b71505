#pragma once

#include <vector>

#include "perimorph/base/field.hpp"
#include "perimorph/operators/coupled_model.hpp"

namespace perimorph::operators {

/// Displacement at every point of the elements that have bonds (zero elsewhere): B u.
/// @param u on all local degrees of freedom (copies too), [length]
template <int dim>
std::vector<base::Point<dim>> displacements_at_points(const CoupledModel<dim>& model, base::ConstField u);

/// Element averages for output, one entry per owned element.
template <int dim>
struct ElementFields {
  std::vector<double> energy;            ///< strain energy in the element: local + half of each of its bonds', [energy]
  std::vector<base::Voigt<dim>> stress;  ///< E(x) eps + 1/2 Sum k (xi . eta) xi (x) xi / w, [stress]
};

/// @param u on all local degrees of freedom; @param at_points B u (displacements_at_points). Local.
template <int dim>
ElementFields<dim> element_fields(const CoupledModel<dim>& model, base::ConstField u,
                                  const std::vector<base::Point<dim>>& at_points);

/// Stress at each material point of one owned element, (n_points), [stress]; element_fields' is their mean. Arguments
/// as there. Local.
template <int dim>
std::vector<base::Voigt<dim>> stress_at_points(const CoupledModel<dim>& model, int element, base::ConstField u,
                                               const std::vector<base::Point<dim>>& at_points);

/// The largest eigenvalue of the strain at any material point of an element [-]: the largest stretch of a bond, were
/// the strain around it uniform. Local.
template <int dim>
double largest_principal_strain(const CoupledModel<dim>& model, int element, base::ConstField u);

}  // namespace perimorph::operators
