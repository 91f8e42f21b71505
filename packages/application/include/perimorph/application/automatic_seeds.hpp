#pragma once

#include "perimorph/base/log.hpp"
#include "perimorph/fracture/body.hpp"

namespace perimorph::application {

/// An element of the elastic body that is stretched more than others. Trivially copyable, so that it can travel.
template <int dim>
struct StretchedPlace {
  base::GlobalId element;
  std::array<double, dim> centroid;  ///< [length]
  double strain;                     ///< the largest principal strain at the element's points [-]
};

/// The places where a body in its present state is stretched most, from the most stretched one on: elements that no
/// other within the inner radius exceeds, that reach the share of the largest strain, and that are not peridynamic
/// already. Strains that differ by less than 1e-4 of the largest count as equal, and then the lower id goes first, so
/// that all numbers of ranks choose alike. Elements with prescribed displacements are left out: under a point support
/// strains only show how fine the mesh is. Collective.
template <int dim>
std::vector<StretchedPlace<dim>> most_stretched(const base::Comm& comm, const fracture::Body<dim>& body,
                                                const model::Problem<dim>& problem, const model::AutomaticSeed& seed);

/// Replaces the automatic seeds of a problem by zones: solves it once, at the largest of its loads and without
/// breaking anything, and takes the most stretched places [WHL19, section 3.1]; the log lists them. Does nothing if
/// there are no automatic seeds. Collective. @throws as Body does.
template <int dim>
void place_automatic_seeds(const Teuchos::RCP<const base::Comm>& comm, const mesh::Mesh<dim>& mesh,
                           const model::NumericalOptions& options, int last_increment, model::Problem<dim>& problem,
                           base::Profile& profile, const base::Log& log);

}  // namespace perimorph::application
