#include "shapes.hpp"

#include <algorithm>

namespace perimorph::cases {

void check_size(const input::Values& section, const std::string& name, int dimension) {
  const auto* values = section.numbers(name);
  if (values == nullptr || values->size() == dimension) return;
  section.mistake(name,
                  fmt::format("found {}; allowed are {} numbers, one per dimension", section.shown(name), dimension));
}

void check_direction(const input::Values& section, const std::string& name, int dimension) {
  check_size(section, name, dimension);
  const auto* direction = section.numbers(name);
  if (direction == nullptr) return;
  if (std::any_of(direction->begin(), direction->end(), [](double value) { return value != 0.; })) return;
  section.mistake(name, fmt::format("found {}; allowed is a direction, which has a length", section.shown(name)));
}

}  // namespace perimorph::cases
