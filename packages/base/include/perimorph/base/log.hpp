#pragma once

#include <spdlog/logger.h>

#include <memory>
#include <string>

#include "perimorph/base/parallel.hpp"

namespace perimorph::base {

using Log = std::shared_ptr<spdlog::logger>;

/// Rank 0's messages to the terminal (unless quiet; errors always); the other ranks' logger is silent. Local.
Log make_log(const Comm& comm, bool quiet);

/// From now on all messages, the earlier ones included, also go to a file. Local, on rank 0.
/// @param log made by make_log
/// @param append to what the file holds; otherwise it is overwritten
/// @throws UserError if the file cannot be written.
void open_file(const Log& log, const std::string& file, bool append);

/// A logger that says nothing, for tests and libraries.
Log silent_log();

}  // namespace perimorph::base
