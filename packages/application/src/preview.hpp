#pragma once

#include <string>

#include "perimorph/cases/case.hpp"
#include "perimorph/fracture/body.hpp"

// What a case looks like before its first increment, for pictures.

namespace perimorph::application {

/// Makes a folder for a preview. Collective.
/// @throws UserError, on all ranks, if it cannot be made, or holds anything else.
void make_preview_folder(const base::Comm& comm, const std::string& folder);

/// Writes preview.e, the body at increment 0 with alpha, classes and groups, and preview.xml: the case with all its
/// parameters, and what follows from it: materials by block, zones, facets of pre-cracks, stages and the value of each
/// condition at their ends. Collective.
/// @param problem with its automatic seeds placed, calibrated
/// @param body with its first topology, nothing solved yet
/// @param element_size where cracks start, [length]
/// @throws UserError, on all ranks, if they cannot be written.
template <int dim>
void write_preview(const Teuchos::RCP<const base::Comm>& comm, const cases::Case& input,
                   const model::Problem<dim>& problem, fracture::Body<dim>& body, double element_size,
                   const std::string& folder);

}  // namespace perimorph::application
