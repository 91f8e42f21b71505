#pragma once

#include <limits>
#include <vector>

#include "perimorph/base/errors.hpp"

namespace perimorph::discretization {

/// A number that is linear between given places, and constant before the first and after the last.
class PiecewiseLinear {
 public:
  struct Knot {
    double place, value;
    bool operator==(const Knot& other) const { return place == other.place && value == other.value; }
  };

  /// @param knots at least one, by ascending place
  explicit PiecewiseLinear(std::vector<Knot> knots);

  double at(double place) const;

  bool operator==(const PiecewiseLinear& other) const { return knots_ == other.knots_; }

 private:
  std::vector<Knot> knots_;
};

/// A number over the increments, [-].
using Amplitude = PiecewiseLinear;

/// A value that grows with the load factor [-]: rate * load factor + constant, both in the value's unit. With an
/// amplitude, rate * amplitude + constant, and the load factor is the increment.
template <class T>
struct Ramp {
  T rate, constant;
  const Amplitude* amplitude = nullptr;                     ///< must outlive this
  double end = std::numeric_limits<double>::infinity();     ///< load factor beyond which there is no value: 0
  double begin = -std::numeric_limits<double>::infinity();  ///< and up to which there is none yet

  bool holds_at(double load_factor) const { return load_factor > begin && load_factor <= end; }

  T at(double load_factor) const {
    if (!holds_at(load_factor)) return T(0. * rate);
    return rate * (amplitude == nullptr ? load_factor : amplitude->at(load_factor)) + constant;
  }

  /// How fast it grows in a step up to a load factor, on average.
  T rate_in(double load_factor, double step) const {
    if (amplitude == nullptr) return rate;
    return step == 0. ? T(0. * rate) : T((at(load_factor) - at(load_factor - step)) / step);
  }

  Ramp operator-() const { return {T(-rate), T(-constant), amplitude, end, begin}; }

  /// Whether both go by the same amplitude, or by the load factor.
  bool has_course_of(const Ramp& other) const {
    const bool are_both = amplitude != nullptr && other.amplitude != nullptr;
    return are_both ? *amplitude == *other.amplitude : amplitude == other.amplitude;
  }

  /// Whether both are the same while both hold.
  bool operator==(const Ramp& other) const {
    return rate == other.rate && constant == other.constant && has_course_of(other);
  }
};

}  // namespace perimorph::discretization
