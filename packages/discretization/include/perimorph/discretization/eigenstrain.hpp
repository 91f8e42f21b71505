#pragma once

#include <optional>
#include <string>
#include <vector>

#include "perimorph/discretization/amplitude.hpp"
#include "perimorph/elements/material_points.hpp"

namespace perimorph::discretization {

/// How what acts in a body varies along a direction.
template <int dim>
struct Profile {
  base::Point<dim> direction;  ///< of length 1
  PiecewiseLinear factor;      ///< over x . direction, [length], what a value is multiplied by, [-]
};

/// A change of temperature in blocks of the mesh; changes in one block add up.
template <int dim>
struct TemperatureChange {
  Ramp<double> value;                        ///< [temperature]
  std::vector<std::string> blocks = {};      ///< none: the whole body
  std::optional<Profile<dim>> profile = {};  ///< none: 1 everywhere
};

/// The strain that carries no stress, alike in all directions: what the change of temperature, or of moisture, would do
/// to a point that nothing holds, alpha_T dT [-]. Stresses follow from what the strain is more than that.
template <int dim>
class Eigenstrain {
 public:
  Eigenstrain() = default;  ///< there is none

  /// Zero at first; none without changes. Local.
  /// @param expansion alpha_T of each local element's material, (n_elements), [1 / temperature]
  Eigenstrain(const mesh::Mesh<dim>& mesh, const elements::MaterialPoints<dim>& points,
              const std::vector<TemperatureChange<dim>>& changes, const std::vector<double>& expansion);

  // All local.
  bool exists() const { return !parts_.empty(); }
  /// @param load_factor that holds from now on, [-]
  void apply_load(double load_factor);
  /// At the present load factor, (n_points), [-]; empty if there is none.
  const std::vector<double>& at_points() const { return at_points_; }
  /// How fast it grows with the load factor in a step up to the present one, on average, (n_points), [-].
  /// @param step of the load factor, [-]
  std::vector<double> rates(double step) const;

 private:
  /// What one change does.
  struct Part {
    Ramp<double> value;              ///< [temperature]
    std::vector<double> per_degree;  ///< alpha_T times the profile, (n_points), [1 / temperature]
  };
  std::vector<Part> parts_;
  std::vector<double> at_points_;
  double load_factor_ = 0.;

  template <class Value>
  std::vector<double> sum(Value value) const;
};

}  // namespace perimorph::discretization
