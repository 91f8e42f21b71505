#include "perimorph/cases/problem.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "mesh_checks.hpp"
#include "perimorph/base/errors.hpp"
#include "perimorph/cases/geometry.hpp"
#include "perimorph/materials/softening.hpp"
#include "perimorph/mesh/distribute.hpp"

namespace perimorph::cases {

namespace {

/// Amplitudes of conditions by their names; they belong to the problem.
class Amplitudes {
 public:
  Amplitudes(const std::vector<Step>& steps, std::vector<std::shared_ptr<const discretization::Amplitude>>& all)
      : steps_(steps), all_(all) {}

  /// Of a condition's value; null without steps, or where there is nothing to multiply.
  template <class T>
  const discretization::Amplitude* of(const std::string& condition, const T& rate) {
    if (steps_.empty() || rate == T(0. * rate)) return nullptr;
    all_.push_back(amplitude_of(condition, steps_));
    return all_.back().get();
  }

  template <class T>
  discretization::Ramp<T> ramp(const std::string& condition, const T& rate, const T& constant) {
    return {rate, constant, of(condition, rate), end_of(condition, steps_), begin_of(condition, steps_)};
  }

  template <int dim>
  discretization::Ramp<base::Point<dim>> ramp(const std::string& condition, const std::vector<double>& rate,
                                              const std::vector<double>& constant) {
    return ramp(condition, point<dim>(rate), point<dim>(constant));
  }

 private:
  const std::vector<Step>& steps_;
  std::vector<std::shared_ptr<const discretization::Amplitude>>& all_;
};

template <int dim>
discretization::Loads<dim> make_loads(const Case& input, Amplitudes& amplitudes) {
  const BoundaryConditions& conditions = input.boundary_conditions;
  std::vector<discretization::SurfaceTraction<dim>> tractions;
  for (const auto& t : conditions.tractions) {
    tractions.push_back({t.group, amplitudes.ramp<dim>(t.name, t.rate, t.constant)});
  }
  discretization::SelfWeight<dim> weight{
      amplitudes.ramp<dim>("Self-Weight", conditions.self_weight_rate, conditions.self_weight_constant),
      {},
      input.material.density};
  for (const auto& solid : input.materials) {
    for (const auto& block : solid.blocks) weight.densities[block] = solid.density;
  }
  std::vector<discretization::SurfacePressure> pressures;
  for (const auto& p : conditions.pressures) {
    pressures.push_back({p.group, amplitudes.ramp(p.name, p.rate, p.constant)});
  }
  return {std::move(tractions),
          amplitudes.ramp<dim>("Body Force", conditions.body_force_rate, conditions.body_force_constant),
          std::move(weight), std::move(pressures)};
}

template <int dim>
std::vector<discretization::TemperatureChange<dim>> make_temperatures(const std::vector<Temperature>& temperatures,
                                                                      Amplitudes& amplitudes) {
  std::vector<discretization::TemperatureChange<dim>> changes;
  for (const auto& t : temperatures) {
    changes.push_back({amplitudes.ramp(t.name, t.rate, t.constant), t.blocks, std::nullopt});
    if (t.direction.empty()) continue;
    std::vector<discretization::PiecewiseLinear::Knot> knots;
    for (std::size_t i = 0; i < t.positions.size(); ++i) knots.push_back({t.positions[i], t.factors[i]});
    changes.back().profile = {point<dim>(t.direction).normalized(), discretization::PiecewiseLinear(std::move(knots))};
  }
  return changes;
}

template <int dim>
std::optional<model::MeasureControl<dim>> make_control(const Loading& loading) {
  if (loading.control == Control::load) return std::nullopt;
  const MeasureControl& m = loading.measure;
  const auto place = [](const std::string& group, const std::vector<double>& x) {
    discretization::MeasuredPlace<dim> measured{group};
    if (!x.empty()) measured.point = point<dim>(x);
    return measured;
  };
  discretization::MeasuredDisplacement<dim> measured{place(m.group, m.point), std::nullopt,
                                                     point<dim>(m.direction).normalized()};
  if (!m.other_group.empty() || !m.other_point.empty()) measured.other = place(m.other_group, m.other_point);
  return model::MeasureControl<dim>{std::move(measured), {m.rate, m.constant}};
}

/// Strength and fracture energy of bonds that soften must go together.
/// @param length the characteristic one, to which the least energy is proportional, [length]
void check_energy(const std::string& path, const Fracture& fracture, double least_energy, double length) {
  const double strength = *fracture.tensile_strength, energy = *fracture.fracture_energy;
  if (energy > least_energy) return;
  throw base::UserError(fmt::format(
      "{}/Fracture Energy: found {:.4g}; with \"Tensile Strength\" = {:.4g} and a characteristic length of "
      "{:.4g} allowed is above {:.4g}, or a length below {:.4g} with a horizon in proportion, or a strength "
      "below {:.4g}: bonds would have to be more brittle than brittle ones",
      path, energy, strength, length, least_energy, length * energy / least_energy,
      strength * std::sqrt(energy / least_energy)));
}

/// What is given, and what follows by integrals; of bonds between two materials, or within one.
/// @param path of the section, for mistakes
template <int dim>
materials::Toughness toughness_of(const std::string& path, const Fracture& fracture,
                                  const materials::Material<dim>& one, const materials::Material<dim>& other,
                                  double unit_energy) {
  if (fracture.softens()) {
    const double strength = *fracture.tensile_strength;
    check_energy(path, fracture, materials::least_fracture_energy(one, other, strength),
                 std::max(one.micromodulus.characteristic_length, other.micromodulus.characteristic_length));
    return materials::softening_toughness(one, other, fracture.bond_law, strength, *fracture.fracture_energy);
  }
  if (fracture.fracture_energy) {
    return {std::sqrt(*fracture.fracture_energy / unit_energy), *fracture.fracture_energy};
  }
  if (!fracture.critical_stretch) return {};
  return {*fracture.critical_stretch, *fracture.critical_stretch * *fracture.critical_stretch * unit_energy, true};
}

/// @param place among all materials
std::string path_of(const Solid& solid, std::size_t place) {
  return place == 0 ? "/Material" : "/Materials/" + solid.name;
}

template <int dim>
materials::Material<dim> make_material(const Case& input, const Solid& solid, const std::string& path) {
  const auto& peridynamics = input.peridynamics;
  auto material = materials::elastic_material<dim>(
      input.material.elastic_model, solid.youngs_modulus, solid.poissons_ratio,
      solid.characteristic_length.value_or(peridynamics.characteristic_length), peridynamics.horizon);
  material.name = solid.name;
  material.compressive_strength = solid.compressive_strength;
  material.thermal_expansion =
      solid.thermal_expansion * materials::expansion_factor(input.material.elastic_model, solid.poissons_ratio);
  material.toughness =
      toughness_of(input.file + ": " + path, solid, material, material,
                   materials::fracture_energy<dim>(material.micromodulus, 1., material.dilatational_ratio));
  return material;
}

/// Between any two materials: as the case says, or perfect.
template <int dim>
std::vector<materials::Interface> make_interfaces(const Case& input,
                                                  const std::vector<materials::Material<dim>>& materials) {
  std::vector<materials::Interface> interfaces;
  for (std::size_t m = 0; m < materials.size(); ++m) {
    for (std::size_t n = m + 1; n < materials.size(); ++n) {
      const auto &one = materials[m], &other = materials[n];
      interfaces.push_back({static_cast<int>(m), static_cast<int>(n), materials::perfect_interface(one, other)});
      const auto given = std::find_if(input.interfaces.begin(), input.interfaces.end(), [&](const Interface& i) {
        return std::set<std::string>(i.materials.begin(), i.materials.end()) == std::set{one.name, other.name};
      });
      if (given == input.interfaces.end()) continue;
      interfaces.back().toughness = toughness_of(input.file + ": /Interfaces/" + given->name, *given, one, other,
                                                 materials::fracture_energy(one, other, 1.));
    }
  }
  return interfaces;
}

/// Extreme numbers, each allowed by itself, may give none together.
template <int dim>
void check_numbers(const Case& input, const materials::Material<dim>& material, const Solid& solid) {
  const auto is_sound = [](double value) { return std::isfinite(value) && value > 0.; };
  const auto& [tau0, length, horizon] = material.micromodulus;
  const double stretch = material.toughness.critical_stretch(), energy = material.toughness.fracture_energy;
  if (is_sound(tau0) && (!solid.breaks() || (is_sound(stretch) && is_sound(energy)))) return;
  throw base::UserError(
      fmt::format("{}: /Material and /Peridynamics give tau0 = {:.4g}, s_crit = {:.4g}, G_c = {:.4g}, with E = {:.4g}, "
                  "horizon = {:.4g}, l = {:.4g}; allowed are numbers that give finite ones above 0",
                  input.file, tau0, stretch, energy, solid.youngs_modulus, horizon, length));
}

/// Of a whole mesh, on rank 0.
template <int dim>
std::vector<std::string> open_or_report(const Case& input, mesh::Mesh<dim>& whole) {
  input::Mistakes mistakes(input.file);
  auto warnings = open_and_check(input, whole, mistakes);
  mistakes.report();
  return warnings;
}

}  // namespace

template <int dim>
model::Problem<dim> make_problem(const Case& input) {
  std::vector<std::shared_ptr<const discretization::Amplitude>> all;
  Amplitudes amplitudes(input.loading.steps, all);
  model::Problem<dim> problem{{},
                              {},
                              facets_of<dim>(input.pre_cracks),
                              input.boundary_conditions.displacements,
                              make_loads<dim>(input, amplitudes),
                              input.loading.steps.empty() && input.boundary_conditions.are_proportional()};
  for (auto& one : problem.displacements) {
    one.value = amplitudes.ramp(one.name, one.value.rate, one.value.constant);
    one = normalized(std::move(one));
  }
  problem.temperature_changes = make_temperatures<dim>(input.boundary_conditions.temperatures, amplitudes);
  const auto is_common = [&](const auto& amplitude) { return *amplitude == *all.front(); };
  const auto& steps = input.loading.steps;
  const bool all_stay = std::all_of(steps.begin(), steps.end(),
                                    [](const Step& step) { return step.released.empty() && step.started.empty(); });
  if (input.boundary_conditions.are_proportional() && all_stay && !all.empty() &&
      std::all_of(all.begin(), all.end(), is_common)) {
    problem.is_proportional = true;
    problem.common_amplitude = all.front().get();
  }
  problem.amplitudes = std::move(all);
  for (const Solid& solid : solids_of(input)) {
    for (const auto& block : solid.blocks)
      problem.material_of_block[block] = static_cast<int>(problem.materials.size());
    problem.materials.push_back(make_material<dim>(input, solid, path_of(solid, problem.materials.size())));
    check_numbers(input, problem.materials.back(), solid);
  }
  problem.interfaces = make_interfaces(input, problem.materials);
  problem.control = make_control<dim>(input.loading);
  problem.calibration = input.material.calibration;
  problem.thickness = input.mesh.thickness.value_or(1.);
  problem.crack_faces = input.peridynamics.crack_faces;
  problem.friction = input.peridynamics.friction;
  problem.rigid_groups = input.boundary_conditions.rigid_groups;
  for (const auto& plane : input.boundary_conditions.symmetry_planes) problem.symmetry_planes.push_back(plane.group);
  for (const auto& seed : input.morphing.seeds) {
    if (seed.shape == SeedShape::automatic) {
      problem.automatic_seeds.push_back({seed.name, seed.inner_radius, seed.outer_radius, seed.share});
    } else {
      problem.seeds.push_back(zone_of<dim>(seed));
    }
  }
  return problem;
}

template <int dim>
void check_compressive_strengths(const Case& input, const model::Problem<dim>& problem) {
  const auto solids = solids_of(input);
  for (std::size_t m = 0; m < problem.materials.size(); ++m) {
    const auto& material = problem.materials[m];
    const double least = materials::compressive_strength_of_stretch(material);
    if (!material.compressive_strength || *material.compressive_strength >= least) continue;
    throw base::UserError(
        fmt::format("{}: {}/Compressive Strength: found {:.6g}; allowed is {:.6g} or more, which a solid whose bonds "
                    "break by their stretch alone bears (E s_crit / nu), or none",
                    input.file, path_of(solids[m], m), *material.compressive_strength, least));
  }
}

template <int dim>
CheckedMesh<dim> read_whole_mesh(const base::Comm& comm, const Case& input, const std::string& folder) {
  CheckedMesh<dim> result;
  base::on_all_ranks(comm, [&] {
    if (comm.getRank() != 0) return;
    result.mesh = read_closed_mesh<dim>(input, folder);
    result.warnings = open_or_report(input, result.mesh);
  });
  return result;
}

template <int dim>
CheckedMesh<dim> read_mesh(const base::Comm& comm, const Case& input, const std::string& folder) {
  const auto& refinement = input.numerical.refinement;
  if (comm.getSize() == 1 || refinement.levels > 0 || refinement.perturbation > 0.) {
    return read_whole_mesh<dim>(comm, input, folder);
  }
  const auto closed = read_closed_parts<dim>(comm, input, folder);
  CheckedMesh<dim> result{closed, {}};
  if (open_if_sound(comm, input, result.mesh)) return result;
  result.mesh = mesh::gather(comm, closed);
  base::on_all_ranks(comm, [&] {
    if (comm.getRank() == 0) result.warnings = open_or_report(input, result.mesh);
  });
  return result;
}

#define PERIMORPH_INSTANTIATE(dim)                                                                    \
  template model::Problem<dim> make_problem<dim>(const Case&);                                        \
  template void check_compressive_strengths<dim>(const Case&, const model::Problem<dim>&);            \
  template CheckedMesh<dim> read_whole_mesh<dim>(const base::Comm&, const Case&, const std::string&); \
  template CheckedMesh<dim> read_mesh<dim>(const base::Comm&, const Case&, const std::string&);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::cases
