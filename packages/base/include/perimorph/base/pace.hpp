#pragma once

#include <string>

namespace perimorph::base {

/// How fast a run goes, and what is left of it at that pace. Steps without a break take no time and steps with a
/// running crack take long, so recent steps count most: a forecast of the next minutes, not of the whole run.
class Pace {
 public:
  /// A step is done that took so long, >= 0, [s].
  void add(double seconds);

  /// How long it will still take, [s]. A step that lasts longer than usual is taken to go on for as long as it is late.
  /// @param n_steps that are left, the current one included, >= 1
  /// @param seconds_in_current what the current one has taken already, >= 0, [s]
  double left(int n_steps, double seconds_in_current) const;

 private:
  double seconds_per_step_ = 0.;
  bool has_steps_ = false;
};

/// For people: "40 s", "3 min", "2 h 5 min". @param seconds >= 0, [s]
std::string duration(double seconds);

}  // namespace perimorph::base
