#pragma once

#include <string>

namespace perimorph::input {

/// All that is in a file. Local.
/// @param what is needed, for messages, such as "a case file (.xml)"
/// @throws UserError if it is no regular file (a pipe or a device could wait, or deliver, forever), cannot be read or
///         has more bytes than allowed.
std::string text_of_file(const std::string& file, const std::string& what, std::size_t most_bytes);

}  // namespace perimorph::input
