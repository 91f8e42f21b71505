#pragma once

#include <spdlog/logger.h>

#include <memory>
#include <string>

#include "perimorph/base/parallel.hpp"

namespace perimorph::base {

using Log = std::shared_ptr<spdlog::logger>;

/// Rank 0's messages to the terminal (unless quiet; errors always); the other ranks' logger is silent. Local.
Log make_log(const Comm& comm, bool quiet);

/// All messages, those before as well, go to a file too, anew or after what it holds. Local, on rank 0.
/// @param log made by make_log
/// @throws UserError if the file cannot be written.
void open_file(const Log& log, const std::string& file, bool append);

/// A logger that says nothing, for tests and libraries.
Log silent_log();

}  // namespace perimorph::base
