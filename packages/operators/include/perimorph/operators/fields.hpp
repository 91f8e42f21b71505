#pragma once

#include <vector>

#include "perimorph/base/field.hpp"
#include "perimorph/discretization/halo_exchange.hpp"
#include "perimorph/operators/coupled_model.hpp"

namespace perimorph::operators {

/// Displacement at every point of the elements that have bonds (zero elsewhere): B u, (n_points), [length]. Local.
/// @param u on all local degrees of freedom (copies too), [length]
template <int dim>
std::vector<base::Point<dim>> displacements_at_points(const CoupledModel<dim>& model, base::ConstField u);

/// Dilatation of the material points, by their bonds as they are left: theta = dim Sum c |xi|^2 (xi . eta) / Sum c
/// |xi|^4 (Silling et al. 2007), (n_points), [-]; 0 at points without bonds, at those of other ranks as it is there.
/// Collective.
/// @param at_points displacement, and eigenstrain, beyond which eta counts
/// @param elements brings what belongs to elements from their owners
template <int dim>
std::vector<double> dilatation_at_points(const CoupledModel<dim>& model, const PointFields<dim>& at_points,
                                         const discretization::HaloExchange& elements);

/// Element averages for output, (n_owned_elements); sources: [WHL19, eq. 13, 20, 21].
template <int dim>
struct ElementFields {
  std::vector<double> energy;            ///< strain energy in the element: local + half of each of its bonds', [energy]
  std::vector<base::Voigt<dim>> stress;  ///< E(x) eps + 1/2 Sum tension xi (x) xi / w, [stress]
};

/// Energy and stress of all owned elements. Local.
/// @param u on all local degrees of freedom, [length]
/// @param at_points of it (CoupledSystem::at_points)
template <int dim>
ElementFields<dim> element_fields(const CoupledModel<dim>& model, base::ConstField u,
                                  const PointFields<dim>& at_points);

/// Stress at each material point of one owned element, (n_points), [stress]; element_fields' is their mean. Arguments
/// as there. Local.
template <int dim>
std::vector<base::Voigt<dim>> stress_at_points(const CoupledModel<dim>& model, int element, base::ConstField u,
                                               const PointFields<dim>& at_points);

/// The largest eigenvalue of the strain at any material point of an element [-]: the largest stretch of a bond, were
/// the strain around it uniform. Local.
/// @param element local index
/// @param u on all local degrees of freedom, [length]
template <int dim>
double largest_principal_strain(const CoupledModel<dim>& model, int element, base::ConstField u);

}  // namespace perimorph::operators
