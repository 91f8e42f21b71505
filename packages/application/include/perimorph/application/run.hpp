#pragma once

#include <string>

#include "perimorph/base/log.hpp"
#include "perimorph/cases/case.hpp"

namespace perimorph::application {

/// What a run shows while it goes on: nothing, a line per increment, or also a progress bar (for a terminal).
enum class Verbosity { quiet, lines, progress };

/// Where a run begins: at the first increment, or after the newest checkpoint in its folder (if there is none, at the
/// first increment too).
enum class Start { at_the_first_increment, from_checkpoint };

/// Runs a case to the last increment; results go to the folder, which is made. Collective.
/// @throws base::UserError, base::ComputationError, base::Bug: the same on all ranks.
void run(const Teuchos::RCP<const base::Comm>& comm, const cases::Case& input, const std::string& folder,
         Verbosity verbosity, Start start = Start::at_the_first_increment);

/// Checks a case and its mesh and prints the resolved parameters, the material's derived constants and an estimate of
/// unknowns, bonds and memory. Collective. @throws as run.
/// @param preview folder for what pictures of the case are drawn from (src/preview.hpp); "": none
void check(const Teuchos::RCP<const base::Comm>& comm, const cases::Case& input, Verbosity verbosity,
           const std::string& preview = "");

}  // namespace perimorph::application
