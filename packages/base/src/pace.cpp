#include "perimorph/base/pace.hpp"

#include <fmt/format.h>

#include <cmath>

#include "perimorph/base/errors.hpp"

namespace perimorph::base {

void Pace::add(double seconds) {
  PERIMORPH_ASSERT(seconds >= 0., "a step of {} s", seconds);
  constexpr double weight = 0.3;  // of the newest step
  seconds_per_step_ += (has_steps_ ? weight : 1.) * (seconds - seconds_per_step_);
  has_steps_ = true;
}

double Pace::left(int n_steps, double seconds_in_current) const {
  PERIMORPH_ASSERT(n_steps >= 1 && seconds_in_current >= 0., "{} steps, {} s in this one", n_steps, seconds_in_current);
  const double current = std::abs(seconds_per_step_ - seconds_in_current);
  return current + (n_steps - 1) * seconds_per_step_;
}

std::string duration(double seconds) {
  PERIMORPH_ASSERT(seconds >= 0., "a time of {} s", seconds);
  if (seconds < 59.5) return fmt::format("{:.0f} s", std::ceil(seconds));
  const auto minutes = static_cast<long>(std::lround(seconds / 60.));
  return minutes < 60 ? fmt::format("{} min", minutes) : fmt::format("{} h {} min", minutes / 60, minutes % 60);
}

}  // namespace perimorph::base
