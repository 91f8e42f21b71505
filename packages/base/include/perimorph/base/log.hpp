#pragma once

#include <spdlog/logger.h>

#include <memory>
#include <string>

#include "perimorph/base/parallel.hpp"

namespace perimorph::base {

using Log = std::shared_ptr<spdlog::logger>;

/// Rank 0's messages to the terminal (unless quiet; errors always) and, if a file is named, all of them to that file,
/// anew or after what it holds. The other ranks' logger is silent. Local.
/// @param file a path, or "" for none
/// @param append whether messages follow what the file holds
/// @throws UserError if the file cannot be written (on rank 0).
Log make_log(const Comm& comm, bool quiet, const std::string& file = "", bool append = false);

/// A logger that says nothing, for tests and libraries.
Log silent_log();

}  // namespace perimorph::base
