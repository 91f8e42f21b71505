#include "shapes.hpp"

namespace perimorph::cases {

void check_size(const input::Values& section, const std::string& name, int dimension) {
  const auto* values = section.numbers(name);
  if (values == nullptr || values->size() == dimension) return;
  section.mistake(name,
                  fmt::format("found {}; allowed are {} numbers, one per dimension", section.shown(name), dimension));
}

}  // namespace perimorph::cases
