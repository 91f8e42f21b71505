#include "perimorph/cases/temperature.hpp"

#include <algorithm>
#include <set>

#include "perimorph/base/errors.hpp"
#include "shapes.hpp"

namespace perimorph::cases {

namespace {

using input::Values;

constexpr const char* profile_names[] = {"Direction", "Positions", "Factors"};

/// All of its parameters or none.
bool has_profile(const Values& temperature) {
  std::vector<const char*> missing;
  for (const char* name : profile_names) {
    if (!temperature.given(name)) missing.push_back(name);
  }
  if (missing.size() == std::size(profile_names)) return false;
  for (const char* name : missing) {
    temperature.mistake(name, "missing; a profile needs \"Direction\", \"Positions\" and \"Factors\" together");
  }
  return missing.empty();
}

void check_profile(const Values& temperature, int dimension) {
  if (!has_profile(temperature)) return;
  check_direction(temperature, "Direction", dimension);
  const auto *positions = temperature.numbers("Positions"), *factors = temperature.numbers("Factors");
  if (positions == nullptr || factors == nullptr) return;
  const auto is_not_above = [](double one, double next) { return next <= one; };
  if (positions->size() < 2 ||
      std::adjacent_find(positions->begin(), positions->end(), is_not_above) != positions->end()) {
    temperature.mistake("Positions", fmt::format("found {}; allowed are two or more, each greater than the one before",
                                                 temperature.shown("Positions")));
  }
  if (positions->size() == factors->size()) return;
  temperature.mistake("Factors", fmt::format("found {} for {} of \"Positions\"; allowed is one for each",
                                             factors->size(), positions->size()));
}

bool expands(const Values& solid) {
  const double* expansion = solid.number("Thermal Expansion");
  return expansion != nullptr && *expansion != 0.;
}

/// Of a material in Materials; the blocks that no other fills are those of Material.
std::vector<std::string> blocks_of(const Values& solid) {
  const auto* blocks = solid.texts("Blocks");
  return blocks == nullptr ? std::vector<std::string>() : blocks->toVector();
}

/// Whether any material does that the temperature changes in.
bool has_effect(const Values& temperature, const Values& root) {
  const auto* heated = temperature.texts("Blocks");
  const auto is_heated = [&](const std::string& block) {
    return heated == nullptr || std::find(heated->begin(), heated->end(), block) != heated->end();
  };
  std::set<std::string> of_others;
  for (const auto& solid : root.subs("Materials")) {
    const auto blocks = blocks_of(solid);
    if (expands(solid) && std::any_of(blocks.begin(), blocks.end(), is_heated)) return true;
    of_others.insert(blocks.begin(), blocks.end());
  }
  if (!expands(root.sub("Material"))) return false;
  return heated == nullptr ||
         std::any_of(heated->begin(), heated->end(), [&](const auto& block) { return of_others.count(block) == 0; });
}

}  // namespace

void declare(const input::Section& section, Temperature& temperature) {
  using namespace input;
  section.optional("Blocks", temperature.blocks, {"particle"}, names("a list of blocks such as {particle}"),
                   "The blocks of the mesh in which it changes: physical groups of elements. If not given, the whole "
                   "body.");
  section.parameter("Rate", temperature.rate, any_number(),
                    "[temperature per increment]: what is positive heats, what is negative cools.");
  section.parameter("Constant", temperature.constant, any_number(),
                    "[temperature], there from the first increment on.");
  section.optional("Direction", temperature.direction, {0., 1.}, numbers("{x, y} or {x, y, z}"),
                   "If it is not the same everywhere: along which direction it varies. Its length does not count.");
  section.optional("Positions", temperature.positions, {0., 10.}, numbers("two numbers or more"),
                   "[length] Places along Direction, from the origin of coordinates, ascending.");
  section.optional("Factors", temperature.factors, {1., 0.}, numbers("one number for each of Positions"),
                   "[-] What Rate and Constant are multiplied by at each of them; linear between them and constant "
                   "beyond.");
}

void check_temperatures(const Values& root, int dimension) {
  for (const auto& one : root.sub("Boundary Conditions").subs("Temperatures")) {
    check_profile(one, dimension);
    const auto* blocks = one.texts("Blocks");
    if (blocks != nullptr && blocks->empty()) {
      one.mistake("Blocks", "found none; allowed are the names of one block or more, or no list for the whole body");
    } else if (!has_effect(one, root)) {
      root.sub("Material")
          .mistake("Thermal Expansion",
                   fmt::format("found 0 in all materials in which {} changes the temperature; it needs one "
                               "that is not 0 in at least one of them",
                               one.path()));
    }
  }
}

}  // namespace perimorph::cases
