#pragma once

#include <functional>
#include <string>

namespace perimorph::mesh_files {

/// Does, in a process of its own, work that may crash, take too much memory or never end: this one comes to no harm.
/// @param memory that it may take beyond what this process has, [bytes]; @param seconds of processor time
/// @returns "" if the work was finished, otherwise why it was not. Local. @throws UserError if the work did.
std::string on_trial(const std::function<void()>& work, std::size_t memory, unsigned seconds);

}  // namespace perimorph::mesh_files
