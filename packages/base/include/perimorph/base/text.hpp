#pragma once

#include <string>
#include <vector>

namespace perimorph::base {

/// " - did you mean "..."?" with the candidate nearest to the name, or "" if none is near (Levenshtein distance
/// up to the larger of 2 and a third of the length, ignoring case).
std::string did_you_mean(const std::string& name, const std::vector<std::string>& candidates);

/// The texts joined by a separator, each in double quotes.
std::string quoted_list(const std::vector<std::string>& texts, const std::string& separator = ", ");

/// "1 node", "2 nodes".
std::string counted(std::size_t n, const std::string& what);

/// Whether a character controls the terminal; the end of a line counts as one.
bool is_control(char c);

/// Whether a name or message has such characters.
bool has_control_characters(const std::string& text);

/// The text with hexadecimal codes in place of control characters; ends of lines and tabs stay.
std::string printable(const std::string& text);

}  // namespace perimorph::base
