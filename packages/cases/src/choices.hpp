#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "perimorph/base/text.hpp"
#include "perimorph/input/mistakes.hpp"
#include "perimorph/input/section.hpp"
#include "perimorph/input/values.hpp"

namespace perimorph::cases {

/// A word of the case file for the value of an enumeration.
template <class E>
struct Choice {
  const char* word;
  E value;
  int dimension = 0;  ///< in which alone it is allowed; 0: in both
};

/// A word that only the other dimension allows is a mistake. Local.
/// @param choices of type Choice
template <class Choices>
void check_choice(const input::Values& section, const std::string& name, const Choices& choices, int dimension) {
  const std::string* word = section.text(name);
  std::vector<std::string> allowed;
  for (const auto& choice : choices) {
    if (choice.dimension == 0 || choice.dimension == dimension) allowed.emplace_back(choice.word);
  }
  if (word == nullptr || std::find(allowed.begin(), allowed.end(), *word) != allowed.end()) return;
  section.mistake(name, fmt::format("found {}; allowed is {} in {} dimensions (/Dimension)", input::in_quotes(*word),
                                    base::quoted_list(allowed, " or "), dimension == 2 ? "two" : "three"));
}

}  // namespace perimorph::cases
