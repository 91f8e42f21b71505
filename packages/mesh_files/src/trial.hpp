#pragma once

#include <functional>
#include <string>

namespace perimorph::mesh_files {

/// Does work in a process of its own that may crash, take too much memory or never end without harm to this one.
/// @param memory that it may take beyond what this process has, [bytes]; @param seconds of processor time
/// @returns "" if it came to its end, and else why not. Local. @throws UserError if the work did.
std::string on_trial(const std::function<void()>& work, std::size_t memory, unsigned seconds);

}  // namespace perimorph::mesh_files
