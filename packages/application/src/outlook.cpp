#include "outlook.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "first_break.hpp"
#include "perimorph/base/errors.hpp"
#include "perimorph/cases/advice.hpp"
#include "perimorph/input/mistakes.hpp"
#include "perimorph/output/reactions.hpp"
#include "perimorph/solvers/parameter_checks.hpp"

namespace perimorph::application {

using base::GlobalId;

template <int dim>
std::string whose(const model::Problem<dim>& problem, std::size_t material) {
  return problem.materials.size() == 1 ? "" : problem.materials[material].name + ": ";
}

namespace {

/// The largest of the reactions that the run will record, if loads grow by a factor.
template <int dim>
std::string largest_reaction(const base::Comm& comm, const cases::Case& input, const fracture::Body<dim>& body,
                             double factor) {
  auto reactions = output::reactions_of<dim>(input.output.reactions, input.boundary_conditions.rigid_groups);
  output::measure(comm, 1, body, reactions);
  const auto* largest = output::largest_force(reactions);
  if (largest == nullptr) return "";
  return fmt::format(", reaction {} = {:.4g}", largest->column, factor * largest->force);
}

/// Smallest extent of the body, [length]. Collective.
template <int dim>
double depth(const base::Comm& comm, const mesh::Mesh<dim>& mesh) {
  double smallest = std::numeric_limits<double>::infinity();
  for (int c = 0; c < dim; ++c) {
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    for (const auto& x : mesh.coordinates) {
      lowest = std::min(lowest, x[c]);
      highest = std::max(highest, x[c]);
    }
    smallest = std::min(smallest, base::max(comm, highest) + base::max(comm, -lowest));
  }
  return smallest;
}

const char* what_decides(double brittleness) {
  constexpr double little = 0.1, much = 10.;
  if (brittleness < little) return "strength alone decides";
  return brittleness > much ? "it breaks like a brittle one, for which \"Brittle\" bonds suffice"
                            : "strength and fracture energy decide together";
}

/// Under which uniaxial compression bonds of a uniform body begin to break, or to soften.
template <int dim>
void describe_compression(const std::string& name, const materials::Material<dim>& material, const base::Log& log) {
  const auto& law = material.toughness.law;
  const double strength = material.compressive_strength.value_or(materials::compressive_strength_of_stretch(material));
  const double over_tensile = strength / (material.youngs_modulus * law.limit());
  if (std::isinf(strength)) {
    log->info("strength         {}no uniaxial compression breaks it: with nu = {:.4g} it stretches no bond", name,
              material.poissons_ratio);
  } else if (law.softens()) {
    log->info(
        "strength         {}in uniaxial compression bonds across it soften from {:.4g}, {:.3g} times what it takes in "
        "tension",
        name, strength, over_tensile);
  } else {
    log->info("strength         {}in uniaxial compression {:.4g}, {:.3g} times that in tension: {}", name, strength,
              over_tensile,
              material.compressive_strength ? "of the stretch across it only a part counts"
                                            : "bonds across it stretch by nu times its strain");
  }
}

/// E s_crit of each material; of one that softens by how much the body is larger than its own length.
template <int dim>
void describe_strengths(const cases::Case& input, const model::Problem<dim>& problem, double depth,
                        const base::Log& log) {
  for (std::size_t m = 0; m < problem.materials.size(); ++m) {
    const auto& toughness = problem.materials[m].toughness;
    if (!toughness.breaks()) continue;
    if (toughness.law.softens()) {
      const cases::Solid solid = cases::solids_of(input)[m];
      const double strength = *solid.tensile_strength;
      const double length = solid.youngs_modulus * toughness.fracture_energy / (strength * strength);
      log->info(
          "strength         {}f_t = {:.4g}, where bonds soften from {:.4g}; E G_f / f_t^2 = {:.4g}, the body {:.4g} "
          "deep: brittleness number {:.2g}, {}",
          whose(problem, m), strength, toughness.law.limit() * solid.youngs_modulus, length, depth, depth / length,
          what_decides(depth / length));
      log->info("length           {}l = {:.4g} is one of the material: keep it, and the horizon, on other meshes",
                whose(problem, m), problem.materials[m].micromodulus.characteristic_length);
      describe_compression(whose(problem, m), problem.materials[m], log);
      continue;
    }
    log->info("strength         {}E s_crit = {:.4g}: about the stress that breaks the material where there is no crack",
              whose(problem, m), problem.materials[m].youngs_modulus * toughness.critical_stretch());
    describe_compression(whose(problem, m), problem.materials[m], log);
  }
}

}  // namespace

void warn(const base::Log& log, const cases::Case& input, const std::vector<std::string>& lines) {
  for (const auto& line : lines) log->warn("warning: {}: {}", input.file, line);
}

void advise(const base::Log& log, const cases::Case& input, const std::vector<std::string>& lines,
            spdlog::level::level_enum level) {
  for (const auto& line : lines) log->log(level, "advice: {}: {}", input.file, line);
}

void check_solver_parameters(const cases::Case& input) {
  input::Mistakes mistakes(input.file);
  for (const auto& [path, what] : solvers::refused_parameters(input.numerical.solver)) {
    mistakes.add(input::line_of(input.lines, "/Solver/" + path), "/Solver/" + path, what);
  }
  mistakes.report();
}

template <int dim>
void warn_of_seeds_everywhere(const base::Comm& comm, const mesh::Mesh<dim>& mesh, const cases::Case& input,
                              const model::Problem<dim>& problem, const base::Log& log) {
  constexpr double nearly_all = 0.9;
  const auto is_automatic = [](const cases::Seed& seed) { return seed.shape == cases::SeedShape::automatic; };
  const auto& seeds = input.morphing.seeds;
  if (std::none_of(seeds.begin(), seeds.end(), is_automatic)) return;
  GlobalId n_covered = 0;
  for (int e = 0; e < mesh.n_owned_elements; ++e) {
    const auto center = mesh::centroid(mesh, e);
    n_covered += std::any_of(problem.seeds.begin(), problem.seeds.end(), [&](const auto& zone) {
      return zone.alpha(center, morphing::BlendingFunction::linear) == 1.;
    });
  }
  const double share = static_cast<double>(base::sum(comm, n_covered)) / static_cast<double>(mesh.n_global_elements);
  if (share < nearly_all) return;
  warn(log, input,
       {fmt::format(
           "/Morphing/Seeds: automatic seeds cover {:.0f} % of the elements: nearly all of the body is peridynamic. "
           "Make their radius (two horizons if not given) smaller, or take \"Everything\"",
           100. * share)});
}

template <int dim>
void check_that_bonds_can_break(const base::Comm& comm, const cases::Case& input, const model::Problem<dim>& problem,
                                const fracture::Body<dim>& body) {
  if (!problem.breaks() || input.morphing.seeds.empty()) return;
  const auto& classes = body.topology().classes();
  const auto n_own =
      std::count(classes.begin(), classes.begin() + body.mesh().n_owned_elements, morphing::ElementClass::pd);
  if (base::sum(comm, static_cast<GlobalId>(n_own)) > 0) return;
  throw base::UserError(fmt::format(
      "{}: /Morphing/Seeds: no element is peridynamic, so that nothing can ever break; allowed are zones in "
      "which the morphing function is 1 up to a horizon, {:.4g}, around some element",
      input.file, input.peridynamics.horizon));
}

/// The increment in which the load is this share of what it is at the body's solution, which need not be whole.
/// Collective.
template <int dim>
double increment_of(const model::Problem<dim>& problem, const fracture::Body<dim>& body, double share) {
  if (!problem.control) return share * body.load_factor();
  const auto& value = problem.control->value;
  return (share * body.measured() - value.constant) / value.rate;
}

template <int dim>
void describe_first_break(const base::Comm& comm, const cases::Case& input, const model::Problem<dim>& problem,
                          fracture::Body<dim>& body, const base::Log& log) {
  if (!problem.breaks() || input.morphing.seeds.empty()) return;
  describe_strengths(input, problem, depth(comm, body.mesh()), log);
  if (!problem.is_proportional || problem.common_amplitude != nullptr) return;  // one solution says nothing of others
  const double last = input.loading.increments;
  body.prescribe(problem.prescribed_in(input.loading.increments));
  try {
    body.solve(fracture::Accuracy::breaking);
  } catch (const base::ComputationError& error) {
    warn(log, input, {fmt::format("the elastic body cannot be solved: {}", error.what())});
    return;
  }
  for (const auto& fallback : body.solver_fallbacks()) warn(log, input, {"/Solver: " + fallback});
  const double load = load_of_first_break(comm, body);
  const double share = load / body.load_factor(), increment = increment_of(problem, body, share);
  if (std::isfinite(load)) {
    log->info("{}at load {:.4g}, in increment {:.0f} of {:.0f}{}",
              body.topology().bonds().softens() ? "first softening  " : "first break      ", load,
              std::max(1., std::ceil(increment)), last, largest_reaction(comm, input, body, share));
  }
  advise(log, input, cases::advice_on_load(input, increment), spdlog::level::warn);
}

#define PERIMORPH_INSTANTIATE(dim)                                                                            \
  template std::string whose(const model::Problem<dim>&, std::size_t);                                        \
  template void warn_of_seeds_everywhere(const base::Comm&, const mesh::Mesh<dim>&, const cases::Case&,       \
                                         const model::Problem<dim>&, const base::Log&);                       \
  template void check_that_bonds_can_break(const base::Comm&, const cases::Case&, const model::Problem<dim>&, \
                                           const fracture::Body<dim>&);                                       \
  template void describe_first_break(const base::Comm&, const cases::Case&, const model::Problem<dim>&,       \
                                     fracture::Body<dim>&, const base::Log&);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::application
