#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "perimorph/base/errors.hpp"

namespace perimorph::operators {

/// The work of all outer forces from one solution to the next. While the load rises no bond breaks and forces change
/// linearly, or it is known what the body takes up, where contact changes; at a fixed load only prescribed forces do
/// work. What soft bonds give way by at a fixed load, they have given way by while it rose: the supports' work in its
/// last step is put right. What is moved are displacements on owned degrees of freedom, [length], and where the body
/// expands the eigenstrain at its points, [-]; forces are in the same order, [force] and [energy].
class ExternalWork {
 public:
  /// The load has changed since the last solution. @param step of the load factor [-]
  void load_changes(double step) {
    load_is_new_ = true;
    step_ = step;
  }

  bool is_load_new() const { return load_is_new_; }

  /// Goes on from a solution whose forces are known, or with another numbering, whose forces are not.
  /// @param power, taken_up as for up_to(); @param step the last one, [-]
  void go_on_from(std::vector<double> moved, std::vector<double> force, double power, double step,
                  std::optional<double> taken_up) {
    go_on_from(std::move(moved));
    last_force_ = std::move(force);
    last_power_ = power;
    step_ = step;
    last_taken_up_ = taken_up;
  }
  void go_on_from(std::vector<double> moved) {
    last_force_.assign(moved.size(), 0.);
    last_moved_ = std::move(moved);
  }

  /// This rank's share up to a new solution, [energy].
  /// @param force of supports and loads together, and of what the body expands by
  /// @param loads of the loads alone, on nodes
  /// @param power of the supports, and of the expansion, over the load factor where bonds soften, 0 otherwise, [energy]
  /// @param taken_up by the body, as energy and by friction, where forces do not change linearly with the load,
  /// [energy]
  double up_to(std::vector<double> moved, std::vector<double> force, const std::vector<double>& loads, double power,
               std::optional<double> taken_up) {
    PERIMORPH_ASSERT(force.size() == last_force_.size() && moved.size() == force.size() && loads.size() <= force.size(),
                     "{} forces, {} before, {} loads", force.size(), last_force_.size(), loads.size());
    double work = load_is_new_ ? 0. : 0.5 * (power - last_power_) * step_;
    for (std::size_t i = 0; i < force.size(); ++i) {
      const double at_fixed_load = i < loads.size() ? loads[i] : 0.;
      work += (moved[i] - last_moved_[i]) * (load_is_new_ ? 0.5 * (last_force_[i] + force[i]) : at_fixed_load);
    }
    if (load_is_new_ && taken_up && last_taken_up_) work = *taken_up - *last_taken_up_;
    load_is_new_ = false;
    go_on_from(std::move(moved), std::move(force), power, step_, taken_up);
    return work;
  }

 private:
  std::vector<double> last_moved_, last_force_;
  bool load_is_new_ = false;
  double last_power_ = 0., step_ = 0.;
  std::optional<double> last_taken_up_;
};

}  // namespace perimorph::operators
