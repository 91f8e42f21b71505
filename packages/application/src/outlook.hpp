#pragma once

#include <string>
#include <vector>

#include "perimorph/base/log.hpp"
#include "perimorph/cases/case.hpp"
#include "perimorph/fracture/body.hpp"

// What can be said of a case before its first increment.

namespace perimorph::application {

/// The name of one of several materials, to begin a line with; nothing if there is one only. Local.
/// @param material by its place in the problem's list
template <int dim>
std::string whose(const model::Problem<dim>& problem, std::size_t material);

/// What the user should know before believing results; what would be chosen better, which quiet runs do not say. Local.
void warn(const base::Log& log, const cases::Case& input, const std::vector<std::string>& lines);
void advise(const base::Log& log, const cases::Case& input, const std::vector<std::string>& lines,
            spdlog::level::level_enum level);

/// Belos and MueLu know the parameters that are for them. Local. @throws UserError
void check_solver_parameters(const cases::Case& input);

/// Automatic seeds are to find places in a body, not all of it. Collective.
template <int dim>
void warn_of_seeds_everywhere(const base::Comm& comm, const mesh::Mesh<dim>& mesh, const cases::Case& input,
                              const model::Problem<dim>& problem, const base::Log& log);

/// Where there are seeds and a critical stretch, bonds can break somewhere. Collective.
/// @param body with its first topology
/// @throws UserError on all ranks
template <int dim>
void check_that_bonds_can_break(const base::Comm& comm, const cases::Case& input, const model::Problem<dim>& problem,
                                const fracture::Body<dim>& body);

/// Reports strength and first break, by one elastic solution; nothing if nothing can break. Collective.
/// @param body with its first topology, nothing solved yet
template <int dim>
void describe_first_break(const base::Comm& comm, const cases::Case& input, const model::Problem<dim>& problem,
                          fracture::Body<dim>& body, const base::Log& log);

}  // namespace perimorph::application
