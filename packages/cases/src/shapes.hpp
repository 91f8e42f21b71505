#pragma once

#include <map>
#include <string>

#include "choices.hpp"

namespace perimorph::cases {

/// A parameter by which a shape is described.
template <class E>
struct ShapeParameter {
  E shape;
  const char* name;
  bool is_needed = true;
};

/// Each shape needs its own parameters and takes no others. Local.
/// @param what has the shape: "a seed"
/// @param shapes of type Choice
/// @param parameters of type ShapeParameter
template <class Choices, class Parameters>
void check_shape(const input::Values& section, const char* what, const Choices& shapes, const Parameters& parameters,
                 int dimension) {
  const std::string* word = section.text("Shape");
  if (word == nullptr) return;
  check_choice(section, "Shape", shapes, dimension);
  struct Use {
    bool is_allowed = false, is_needed = false;
  };
  std::map<std::string, Use> uses;
  for (const auto& [shape, name, is_needed] : parameters) {
    Use& use = uses[name];
    const bool is_its_own = shape == input::value_of(shapes, *word);
    use.is_allowed |= is_its_own;
    use.is_needed |= is_its_own && is_needed;
  }
  for (const auto& [name, use] : uses) {
    if (use.is_needed && !section.given(name)) {
      section.mistake(name, fmt::format("missing; {} with \"Shape\" \"{}\" needs it", what, *word));
    } else if (!use.is_allowed && section.given(name)) {
      section.mistake(name, fmt::format("found in {} with \"Shape\" \"{}\"; allowed is only what describes that shape",
                                        what, *word));
    }
  }
}

/// A point or vector has one number per dimension. Local.
void check_size(const input::Values& section, const std::string& name, int dimension);

/// So has a direction, and a length. Local.
void check_direction(const input::Values& section, const std::string& name, int dimension);

}  // namespace perimorph::cases
