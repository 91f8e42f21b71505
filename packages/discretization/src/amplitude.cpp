#include "perimorph/discretization/amplitude.hpp"

#include <algorithm>
#include <cmath>

namespace perimorph::discretization {

PiecewiseLinear::PiecewiseLinear(std::vector<Knot> knots) : knots_(std::move(knots)) {
  PERIMORPH_ASSERT(!knots_.empty(), "a course of {} knots", knots_.size());
  for (std::size_t i = 0; i < knots_.size(); ++i) {
    PERIMORPH_ASSERT(std::isfinite(knots_[i].value) && (i == 0 || knots_[i].place > knots_[i - 1].place),
                     "value {} at {}", knots_[i].value, knots_[i].place);
  }
}

double PiecewiseLinear::at(double place) const {
  const auto is_before = [](double x, const Knot& knot) { return x < knot.place; };
  const auto after = std::upper_bound(knots_.begin(), knots_.end(), place, is_before);
  if (after == knots_.begin()) return knots_.front().value;
  const Knot& before = *(after - 1);
  if (after == knots_.end() || before.value == after->value) return before.value;
  const double share = (place - before.place) / (after->place - before.place);
  return before.value + share * (after->value - before.value);
}

}  // namespace perimorph::discretization
