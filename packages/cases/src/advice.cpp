#include "perimorph/cases/advice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "perimorph/base/errors.hpp"
#include "perimorph/materials/micromodulus.hpp"
#include "perimorph/model/calibration.hpp"

namespace perimorph::cases {

namespace {

/// Below these, and what it costs: tests/verification/README.md has the measurements.
constexpr double least_length = 0.3;         // characteristic, in element sizes
constexpr double longest_element = 3.2;      // in characteristic lengths of bonds that soften
constexpr double least_horizon = 3.;         // in element sizes
constexpr double most_cut_off = 0.05;        // of the micromodulus, by the horizon
constexpr double least_rim = 1.;             // over which alpha falls, in horizons
constexpr double least_zone = 2.;            // inner radius, in horizons
constexpr double least_stiff_volume = 0.39;  // Poisson's ratio from which strains at a linear rim grow

// Of brittle solids s_crit is between some 1e-5 and some 1e-2.
constexpr double least_stretch = 1e-7, most_stretch = 0.2;
constexpr double least_first_break = 0.1, most_first_breaks = 100.;  // in increments; in all increments

class Advice {
 public:
  Advice(const Case& input, double element_size)
      : input_(input),
        breaks_(can_break(input)),
        horizon_(input.peridynamics.horizon),
        length_(input.peridynamics.characteristic_length),
        size_(element_size) {}

  std::vector<std::string> all() {
    check_density();
    check_expansion();
    check_faces();
    if (input_.morphing.seeds.empty()) return std::move(lines_);
    check_parting();
    check_length();
    check_horizon();
    check_cut_off();
    for (const Seed& seed : input_.morphing.seeds) check_seed(seed);
    check_growth();
    check_function();
    return std::move(lines_);
  }

 private:
  template <class... Values>
  void add(const std::string& path, fmt::format_string<Values...> what, Values&&... values) {
    lines_.push_back(path + ": " + fmt::format(what, std::forward<Values>(values)...));
  }

  void check_density() {
    const auto& conditions = input_.boundary_conditions;
    const auto is_some = [](double value) { return value != 0.; };
    for (const auto* weight : {&conditions.self_weight_rate, &conditions.self_weight_constant}) {
      if (std::any_of(weight->begin(), weight->end(), is_some)) return;
    }
    const auto solids = solids_of(input_);
    if (std::none_of(solids.begin(), solids.end(), [](const Solid& solid) { return solid.density > 0.; })) return;
    add("/Boundary Conditions/Self-Weight", "is zero; without it densities have no effect");
  }

  void check_expansion() {
    if (!input_.boundary_conditions.temperatures.empty()) return;
    const auto solids = solids_of(input_);
    if (std::none_of(solids.begin(), solids.end(), [](const Solid& s) { return s.thermal_expansion != 0.; })) return;
    add("/Boundary Conditions/Temperatures", "has none; without it thermal expansions have no effect");
  }

  void check_faces() {
    if (input_.peridynamics.crack_faces == discretization::CrackFaces::free || !input_.morphing.seeds.empty()) return;
    add("/Peridynamics/Crack Faces",
        "\"Contact\" has no effect without a seed: only peridynamic faces press on each other");
  }

  void check_parting() {
    if (!breaks_ || input_.numerical.discontinuous != discretization::DiscontinuousElements::never) return;
    add("/Morphing/Discontinuous Elements",
        "\"Never\": broken elements hold together. With a characteristic length of half an element cracks run at 1.1 "
        "times the load of fracture mechanics, with a third at 1.3 times, with a fifth hardly at all");
  }

  void check_length() {
    const auto solids = solids_of(input_);
    if (std::any_of(solids.begin(), solids.end(), [](const Solid& solid) { return solid.softens(); })) {
      return check_length_of_material();
    }
    const double length = length_ / size_;
    if (!breaks_ || length >= least_length || input_.dimension != 2) return;  // in three dimensions little is held up
    const auto& numerical = input_.numerical;
    if (numerical.discontinuous == discretization::DiscontinuousElements::never) return;  // check_parting() has said it
    const auto& material = input_.material;
    const double resistance =
        model::lattice_resistance(numerical.discontinuous, numerical.peridynamic_stiffness, length,
                                  materials::dilatational_ratio(material.elastic_model, material.poissons_ratio));
    const bool is_calibrated = model::is_calibrated_to_mesh(input_.material.calibration, input_.dimension, numerical);
    add("/Peridynamics/Characteristic Length",
        "{:.4g} is {:.2f} of an element; the mesh then holds cracks up, to {:.2f} of the load of fracture mechanics{}. "
        "Better is a third of an element, {:.3g}, with a horizon of four",
        length_, length, resistance,
        is_calibrated ? " (for which the critical stretch makes up), and they move in jumps" : "", size_ / 3.);
  }

  void check_length_of_material() {
    if (size_ <= longest_element * length_) return;
    add("/Peridynamics/Characteristic Length",
        "{:.4g} is {:.2f} of an element; of bonds that soften it is a length of the material, and stays as it is on "
        "other meshes. With elements of more than three times this length, forces depend on the mesh by some percent; "
        "better are elements of {:.3g}",
        length_, length_ / size_, 3. * length_);
  }

  void check_horizon() {
    const double horizon = horizon_ / size_;
    if (horizon < least_horizon) {
      add("/Peridynamics/Horizon", "{:.4g} is {:.1f} elements; with fewer than three, cracks follow the mesh", horizon_,
          horizon);
    }
  }

  void check_cut_off() {
    const double whole = materials::kernel_moment(5, length_, 40. * length_);
    const double cut_off = 1. - materials::kernel_moment(5, length_, horizon_) / whole;
    if (cut_off <= most_cut_off) return;
    add("/Peridynamics/Horizon",
        "{:.4g} is {:.1f} characteristic lengths and cuts off {:.0f} % of the micromodulus; below eleven, results "
        "depend on it",
        horizon_, horizon_ / length_, 100. * cut_off);
  }

  void check_seed(const Seed& seed) {
    const std::string path = "/Morphing/Seeds/" + seed.name;
    if (seed.shape == SeedShape::ball) {
      check_rim(path + "/Outer Radius", seed.outer_radius - seed.inner_radius);
      if (breaks_) check_zone(path + "/Inner Radius", seed.inner_radius);
    } else if (seed.shape == SeedShape::box) {
      check_rim(path + "/Rim", seed.rim);
      double narrowest = seed.upper_corner[0] - seed.lower_corner[0];
      for (std::size_t i = 1; i < seed.upper_corner.size(); ++i) {
        narrowest = std::min(narrowest, seed.upper_corner[i] - seed.lower_corner[i]);
      }
      if (breaks_) check_zone(path + "/Upper Corner", 0.5 * narrowest);
    }
  }

  void check_growth() {
    if (!breaks_) return;
    check_rim("/Morphing/Growth Outer Radius",
              input_.numerical.growth_outer_radius - input_.numerical.growth_inner_radius);
    check_zone("/Morphing/Growth Inner Radius", input_.numerical.growth_inner_radius);
  }

  void check_function() {
    if (input_.material.elastic_model == materials::ElasticModel::plane_stress ||
        input_.numerical.blending_function == morphing::BlendingFunction::cubic) {
      return;
    }
    double largest = 0.;
    for (const Solid& solid : solids_of(input_)) largest = std::max(largest, solid.poissons_ratio);
    if (largest < least_stiff_volume) return;
    add("/Morphing/Function",
        "where alpha begins and ends to fall linearly, strains are wrong by 4 to 6 % with a Poisson's ratio of {:.3g}; "
        "with \"Cubic\" by 1 to 2 %",
        largest);
  }

  void check_rim(const std::string& path, double rim) {
    if (rim >= least_rim * horizon_) return;
    add(path,
        "alpha falls over {:.4g}, {:.2f} horizons; where the models meet, strains are then wrong by 3.5 % at half a "
        "horizon and 7.6 % at a quarter, against 2.5 % from one horizon on",
        rim, rim / horizon_);
  }

  void check_zone(const std::string& path, double radius) {
    if (radius >= least_zone * horizon_) return;
    add(path,
        "the zone reaches {:.4g}, {:.2f} horizons, from its centre; bonds break only where it is one horizon deeper. "
        "Better are two horizons or more",
        radius, radius / horizon_);
  }

  const Case& input_;
  bool breaks_;
  double horizon_, length_, size_;  ///< horizon, characteristic length and elements, [length]
  std::vector<std::string> lines_;
};

}  // namespace

std::vector<std::string> advice(const Case& input, double element_size) { return Advice(input, element_size).all(); }

std::vector<std::string> advice_on_stretches(const Case& input, const std::vector<double>& critical_stretches) {
  if (input.morphing.seeds.empty()) return {};
  const auto solids = solids_of(input);
  PERIMORPH_ASSERT(solids.size() == critical_stretches.size(), "{} stretches for {} materials",
                   critical_stretches.size(), solids.size());
  std::vector<std::string> lines;
  for (std::size_t m = 0; m < solids.size(); ++m) {
    const double stretch = critical_stretches[m];
    if (std::isinf(stretch) || (stretch >= least_stretch && stretch <= most_stretch)) continue;
    lines.push_back(fmt::format(
        "{}/{}: bonds break at a stretch of {:.4g}, where E s_crit = {:.4g}: that looks like a mistake of units. {}",
        m == 0 ? "/Material" : "/Materials/" + solids[m].name,
        solids[m].critical_stretch ? "Critical Stretch" : "Fracture Energy", stretch,
        solids[m].youngs_modulus * stretch,
        stretch > most_stretch
            ? "The model is one of small strains. With mm and MPa, G_c is in N/mm, that is kJ/m2; it is not K_c"
            : "Brittle solids break at 1e-5 to 1e-2. With m and Pa, G_c is in J/m2; with mm and MPa in N/mm"));
  }
  return lines;
}

std::vector<std::string> advice_on_load(const Case& input, double first_break) {
  const int n = input.loading.increments;
  if (first_break > n) {
    const bool is_far = first_break > most_first_breaks * n;
    return {
        fmt::format("/Loading/Increments: nothing breaks in {} increments: no bond reaches the critical stretch{}{}", n,
                    std::isinf(first_break) ? "" : fmt::format(" before increment {:.4g}", std::ceil(first_break)),
                    is_far ? ". Are loads in the units of material and mesh?" : "")};
  }
  if (first_break >= least_first_break) return {};
  return {fmt::format(
      "{}: the first increment is already {:.4g} times the load at which the first bond "
      "breaks: loads should grow in smaller steps. Are they in the units of material and mesh?",
      input.loading.control == Control::load ? "/Boundary Conditions" : "/Loading/Measure/Rate", 1. / first_break)};
}

}  // namespace perimorph::cases
