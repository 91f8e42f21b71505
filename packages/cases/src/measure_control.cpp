#include "perimorph/cases/measure_control.hpp"

#include <algorithm>

#include "shapes.hpp"

namespace perimorph::cases {

namespace {

constexpr const char* names[] = {"Group", "Other Group", "Point", "Other Point", "Direction", "Rate", "Constant"};

void check_one_of(const input::Values& measure, const char* group, const char* point) {
  if (!measure.given(group) || !measure.given(point)) return;
  measure.mistake(point, fmt::format("found beside \"{}\"; allowed is one of the two", group));
}

void check_unused(const input::Values& measure) {
  for (const char* name : names) {
    if (!measure.given(name)) continue;
    measure.mistake(name, "found with \"Control\" = \"Load\", where it has no effect; allowed is it with \"Measure\"");
  }
}

}  // namespace

void declare(const input::Section& section, MeasureControl& measure) {
  using namespace input;
  const auto vector = numbers("{x, y} or {x, y, z}");
  section.optional("Group", measure.group, "mouth_right", text("the name of a group"),
                   "A physical group of the mesh, of whose nodes the mean displacement is measured.");
  section.optional("Point", measure.point, {10., 0.}, vector,
                   "Instead of a group: a point of the body [length], one number per dimension.");
  section.optional("Other Group", measure.other_group, "mouth_left", text("the name of a group"),
                   "If given, what is measured is how much further the first place moves than this one: with the two "
                   "lips of a notch the opening of its mouth.");
  section.optional("Other Point", measure.other_point, {-10., 0.}, vector, "Instead of another group: a point.");
  section.optional("Direction", measure.direction, {1., 0.}, vector,
                   "In which the displacement is measured, one number per dimension; its length does not matter. The "
                   "measure must grow with the load.");
  section.optional("Rate", measure.rate, 0.001, any_number(),
                   "[length per increment]: in increment k the measure is Rate * k + Constant.");
  section.optional("Constant", measure.constant, 0., any_number(),
                   "[length], what is measured before the first increment; 0 if it is not given.");
}

void check_measure_control(const input::Values& loading, int dimension) {
  const std::string* control = loading.text("Control");
  const auto measure = loading.sub("Measure");
  if (control == nullptr) return;
  if (*control == "Load") return check_unused(measure);
  check_one_of(measure, "Group", "Point");
  check_one_of(measure, "Other Group", "Other Point");
  if (!measure.given("Group") && !measure.given("Point")) {
    measure.mistake("Group", "missing; \"Control\" = \"Measure\" needs a group or a \"Point\" to measure at");
  }
  for (const char* needed : {"Direction", "Rate"}) {
    if (!measure.given(needed)) measure.mistake(needed, "missing; \"Control\" = \"Measure\" needs it");
  }
  for (const char* name : {"Point", "Other Point"}) check_size(measure, name, dimension);
  check_direction(measure, "Direction", dimension);
  const double* rate = measure.number("Rate");
  if (rate != nullptr && *rate == 0.) {
    measure.mistake("Rate", "found 0; allowed is any other number: nothing else loads the body");
  }
}

}  // namespace perimorph::cases
