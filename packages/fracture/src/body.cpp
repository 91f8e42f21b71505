#include "perimorph/fracture/body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "perimorph/base/errors.hpp"
#include "perimorph/fracture/damage.hpp"
#include "perimorph/operators/free_parts.hpp"

namespace perimorph::fracture {

using base::GlobalId;
using base::Phase;

namespace {

template <int dim>
operators::MorphedStiffness<dim> elasticity(const mesh::Mesh<dim>& mesh, const Problem<dim>& problem,
                                            const NumericalOptions& options) {
  std::vector<operators::Elasticity<dim>> all;
  for (const auto& m : problem.materials) all.push_back({m.e0, dim * m.dilatational_ratio / (2 * (dim + 2))});
  return {std::move(all), model::materials_of_elements(mesh, problem), options.peridynamic_stiffness};
}

template <int dim>
discretization::TopologyOptions<dim> topology_options(const mesh::Mesh<dim>& mesh, const Problem<dim>& problem,
                                                      const NumericalOptions& options) {
  return {problem.seeds,
          problem.pre_cracks,
          model::bond_materials(mesh, problem),
          options.blending_function,
          options.discontinuous,
          options.growth_inner_radius,
          options.growth_outer_radius,
          options.points_per_direction,
          options.operator_form == operators::OperatorForm::on_the_fly ? bonds::StiffnessStorage::on_the_fly
                                                                       : bonds::StiffnessStorage::stored,
          problem.crack_faces};
}

/// Without windows where crack faces are in contact: they would save the first of several solutions in each search for
/// those that are closed (DECISIONS.md, 49).
template <int dim>
operators::SystemOptions system_options(const NumericalOptions& options, const Problem<dim>& problem) {
  const bool has_windows = problem.crack_faces == discretization::CrackFaces::free;
  return {options.operator_form, options.preconditioner_matrix, options.short_range_cut_off, problem.friction,
          has_windows ? options.window : operators::WindowOptions()};
}

}  // namespace

template <int dim>
Body<dim>::Body(const Teuchos::RCP<const base::Comm>& comm, const mesh::Mesh<dim>& mesh, const Problem<dim>& problem,
                const NumericalOptions& options, base::Profile& profile)
    : comm_(comm),
      problem_(problem),
      options_(options),
      profile_(profile),
      topology_(comm, mesh, topology_options(mesh, problem, options)),
      dirichlet_(*comm, mesh, problem.displacements, problem.rigid_groups),
      system_(*comm, topology_, dirichlet_, problem.loads,
              {elasticity(mesh, problem, options), model::eigenstrain(mesh, topology_.points(), problem)},
              system_options(options, problem), profile),
      equilibrium_(*comm, options.solver, profile) {
  PERIMORPH_ASSERT(options.tolerance > 0. && options.damage_tolerance >= options.tolerance, "tolerances {} and {}",
                   options.tolerance, options.damage_tolerance);
  if (problem.control) measure_.emplace(*comm, mesh, problem.control->measured);
}

template <int dim>
void Body<dim>::apply_load(double load_factor) {
  PERIMORPH_ASSERT(std::isfinite(load_factor), "load factor {}", load_factor);
  state_.counts.linear_solves = state_.counts.cg_iterations = 0;
  state_.load_step = load_factor - state_.load_factor;
  work_.load_changes(state_.load_step);
  // Everything is linear while no bond breaks: under proportional load the displacement scales.
  const double last = problem_.scale_at(state_.load_factor);
  if (problem_.is_proportional && last != 0.) {
    const double factor = problem_.scale_at(load_factor) / last;
    for (double& u : state_.displacement) u *= factor;
  }
  state_.load_factor = load_factor;
  system_.forget_forces();
}

template <int dim>
void Body<dim>::prescribe(double value, bool has_begun) {
  prescribed_ = value;
  if (has_begun) return;
  if (!measure_) return apply_load(value);
  if (!problem_.is_proportional) return apply_load(state_.load_factor);
  const double scale = value / measured();
  apply_load(std::isfinite(scale) ? scale * state_.load_factor : 1.);
}

template <int dim>
double Body<dim>::measured() const {
  return measure_ && topology_.is_built() ? measure_->of(*comm_, topology_.dofs(), displacement()) : 0.;
}

template <int dim>
void Body<dim>::update_topology() {
  rebuild(grow());
}

template <int dim>
bool Body<dim>::grow() {
  const auto timer = profile_.measure(Phase::search);
  return topology_.grow(state_.flag_points);
}

template <int dim>
void Body<dim>::rebuild(bool has_grown) {
  const bool has_other_supports = dirichlet_.apply_load(state_.load_factor);
  {
    const auto timer = profile_.measure(Phase::adapt);
    const auto change = topology_.update(has_grown);
    state_.counts.dgfe_elements = topology_.n_discontinuous();
    if (!change.models && !has_other_supports) return;
    state_.counts.topologies += change.models ? 1 : 0;
    system_.follow_morphing();
    if (change.numbering) move_to_new_numbering();
    if (dirichlet_.has_begun() && state_.load_step != 0.) note_starts();
  }
  if (has_other_supports) equilibrium_.forget();  // multigrid knows nothing of unknowns that were none
  assemble();
  for (auto flag = state_.flag_points.rbegin();
       flag != state_.flag_points.rend() && flag->growth == state_.flag_points.back().growth; ++flag) {
    system_.expect_breaks(Eigen::Map<const base::Point<dim>>(flag->centroid.data()));
  }
  if (measure_ && state_.counts.topologies > 1) renew_forces();  // from which the work goes on
  state_.break_calls_before_topology = state_.break_calls;
}

/// WindowSolver::set_operator().
template <int dim>
std::vector<int> Body<dim>::owned_old_nodes() const {
  auto nodes = topology_.old_nodes();
  nodes.resize(topology_.dofs().n_owned_nodes());
  return nodes;
}

/// Where the supports that have begun find their nodes.
template <int dim>
void Body<dim>::note_starts() {
  const auto& dofs = topology_.dofs();
  state_.starts.resize(state_.displacement.size(), 0.);
  for (int dof = 0; dof < dofs.n_real_nodes() * dim; ++dof) {
    if (dirichlet_.has_begun(dofs.reference_node(dof / dim), dof % dim)) state_.starts[dof] = state_.displacement[dof];
  }
}

template <int dim>
void Body<dim>::move_to_new_numbering() {
  state_.displacement = topology_.carried_over(state_.displacement);
  if (!state_.starts.empty()) state_.starts = topology_.carried_over(state_.starts);
  work_.go_on_from(system_.moved(displacement()));
  state_.counts.unknowns = topology_.dofs().n_global_nodes() * dim;
  facing_sides_ = operators::facing_sides(mesh(), topology_.discontinuous());
}

template <int dim>
void Body<dim>::assemble() {
  const auto timer = profile_.measure(Phase::assemble);
  auto source = system_.assemble(state_.starts);
  const auto& space = system_.space();
  const auto near_null_space = solvers::rigid_body_modes<dim>(*source.matrix, source.coordinates);
  space.turn(*near_null_space.modes);
  auto& solver = equilibrium_.linear_solver();
  equilibrium_.windows().set_operator(system_.tangent(), source.matrix, near_null_space, owned_old_nodes());
  solver.set_operator(system_.tangent(), source.matrix, near_null_space, source.basis, std::move(source.from_old),
                      [this] { return system_.whole_matrix(); });
  if (!space.groups().is_empty()) solver.set_groups({space.groups().owned_dofs(), space.groups().free_motions()});
  topology_.drop_old_dofs();
}

template <int dim>
void Body<dim>::solve(Accuracy accuracy) {
  PERIMORPH_ASSERT(topology_.is_built(), "there is no topology to solve on");
  balance(accuracy);
  if (measure_) meet_measure(accuracy);
  const auto now_taken_up = work_.is_load_new() ? taken_up() : std::nullopt;
  state_.energies.external_work +=
      base::sum(*comm_, work_.up_to(system_.moved(displacement()), system_.exerted(displacement()), system_.loads(),
                                    power_of_supports(), now_taken_up));
}

template <int dim>
void Body<dim>::balance(Accuracy accuracy) {
  const auto u = base::field(state_.displacement);
  const auto before = state_.displacement;
  if (!system_.has_forces()) {
    system_.apply_load(state_.load_factor);
    system_.space().expand(u, state_.load_factor);
    system_.evaluate(u);
  }
  const double tolerance = accuracy == Accuracy::breaking ? options_.damage_tolerance : options_.tolerance;
  const auto outcome = equilibrium_.find(
      system_, u, {tolerance, state_.force_scale, state_.counts.broken_bonds > 0, accuracy == Accuracy::breaking});
  count(outcome);
  if (!outcome.converged) {
    const auto reason = reason_for(outcome.trouble);
    state_.displacement = before;
    system_.evaluate(displacement());
    throw UnfinishedIncrement(reason);
  }
}

template <int dim>
void Body<dim>::count(const solvers::Equilibrium::Outcome& outcome) {
  state_.counts.linear_solves += outcome.linear_solves;
  state_.counts.cg_iterations += outcome.cg_iterations;
}

/// Where contact changes or faces slide, what is measured is not linear in the load factor, and one step misses it.
template <int dim>
void Body<dim>::meet_measure(Accuracy accuracy) {
  constexpr int most_steps = 10;
  const bool is_homogeneous = problem_.is_proportional && problem_.friction == 0.;
  const bool is_linear = is_homogeneous || problem_.crack_faces == discretization::CrackFaces::free;
  const double far_off = std::max(std::abs(measured() - prescribed_), std::abs(prescribed_));
  for (int step = 0; step < most_steps; ++step) {
    follow_measure();
    balance(accuracy);
    if (is_linear || std::abs(measured() - prescribed_) <= options_.damage_tolerance * far_off) return;
  }
  throw UnfinishedIncrement(
      fmt::format("contact changes with the load, and the measure is not met in {} steps", most_steps));
}

/// While nothing breaks, what is measured is linear in the load factor.
template <int dim>
void Body<dim>::follow_measure() {
  const auto response = load_response();
  const double rate = measure_->of(*comm_, topology_.dofs(), base::field(response));
  if (rate <= 0.) {
    throw UnfinishedIncrement(fmt::format(
        "no load gives the measure /Loading/Measure prescribes, {:.6g}: it is {:.6g}, and changes by {:.6g} "
        "with the load factor, where it would have to grow; {}",
        prescribed_, measured(), rate,
        state_.counts.broken_bonds == 0 ? "does its Direction point against the load?"
                                        : "the crack has left the place where it is measured"));
  }
  const double step = (prescribed_ - measured()) / rate;
  for (std::size_t dof = 0; dof < response.size(); ++dof) state_.displacement[dof] += step * response[dof];
  const double share = 1. + step / state_.load_factor;
  if (problem_.is_proportional && share > 0. && share < 1.) state_.force_scale *= share;
  state_.load_factor += step;
  state_.load_step += step;
  work_.load_changes(state_.load_step);
  system_.forget_forces();
}

/// How the displacement grows with the load factor, on all local degrees of freedom, [length].
template <int dim>
std::vector<double> Body<dim>::load_response() {
  auto response = state_.displacement;
  if (problem_.is_proportional && state_.load_factor != 0.) {
    for (double& u : response) u /= state_.load_factor;
    return response;
  }
  const auto outcome = equilibrium_.find_load_response(system_, base::field(response), options_.damage_tolerance);
  count(outcome);
  if (!outcome.converged) throw UnfinishedIncrement(reason_for(outcome.trouble));
  return response;
}

/// Of this rank's, and of what expands it: how fast they do work as the load factor grows, where bonds soften; 0
/// otherwise, [energy].
template <int dim>
double Body<dim>::power_of_supports() const {
  if (!topology_.bonds().softens()) return 0.;
  const auto rates = system_.space().prescribed_rates(state_.load_factor, state_.load_step);
  const auto force = system_.exerted(displacement());
  const auto with_eigenstrain = system_.moved(base::field(rates), system_.eigenstrain().rates(state_.load_step));
  return std::inner_product(force.begin(), force.end(), with_eigenstrain.begin(), 0.);
}

/// Where nothing holds a part against its loads, or nothing but bonds that would break, that is why.
template <int dim>
std::string Body<dim>::reason_for(const std::string& trouble) const {
  const auto& [u, stretch, contacts, eigenstrain] = system_.at_points();
  const bonds::PointStrains strains{eigenstrain, system_.dilatation()};
  const auto reason = operators::what_is_free(*comm_, model(), system_.space(), system_.loads(), contacts,
                                              topology_.bonds().overstretched(u, topology_.classes(), 1., strains));
  return reason.empty() ? trouble : reason;
}

template <int dim>
GlobalId Body<dim>::break_bonds(bool may_recover) {
  const auto timer = profile_.measure(Phase::bonds);
  if (!problem_.breaks()) return 0;
  PERIMORPH_ASSERT(system_.has_forces(), "nothing has been solved for load factor {}", state_.load_factor);
  auto [change, held_energy] = find_damage(*comm_, model(), system_.at_points(), system_.dilatation(),
                                           topology_.classes(), options_.breaking_fraction, may_recover);
  if (change.n_broken == 0 && change.n_softened > 0 && is_settled(change)) change = {};
  if (change.n_broken > 0 && system_.breaks_change_more()) {
    const double share = change.energy / held_energy, before = elastic_energy();
    auto softened = std::exchange(change.softened, {});
    publish(change);
    system_.evaluate(displacement());
    change.energy = share * (before - elastic_energy());  // part of it was not the bonds' own
    if (change.n_softened > 0) publish({{}, 0, 0., std::move(softened)});
  } else if (change.n_broken + change.n_softened > 0) {
    publish(change);
  }
  state_.take(change);
  return change.n_broken + change.n_softened;
}

template <int dim>
bool Body<dim>::is_settled(const bonds::BondChange& change) const {
  const auto norms = system_.imbalance_after(change);
  return norms.residual <= options_.softening_tolerance * std::max(norms.reaction, state_.force_scale);
}

template <int dim>
void Body<dim>::accept_history() {
  if (topology_.bonds().softens()) {
    state_.energies.dissipated += base::sum(*comm_, operators::dissipation_of_softening(model(), system_.at_points()));
    topology_.accept_softening();
  }
  if (problem_.crack_faces == discretization::CrackFaces::free) return;
  state_.energies.friction += base::sum(*comm_, topology_.accept_slips(system_.slips(displacement())));
  system_.follow_slips();
  renew_forces();
}

/// To all that is built from bonds.
template <int dim>
void Body<dim>::publish(const bonds::BondChange& change) {
  topology_.take(change);
  const auto changed = system_.take(change);
  if (!change.is_empty()) equilibrium_.note_change(changed);
}

template <int dim>
GlobalId Body<dim>::flag_damaged_elements() {
  const auto timer = profile_.measure(Phase::adapt);
  const GlobalId n_new = topology_.flag_damaged_elements(state_.flag_points);
  state_.counts.damaged_elements += n_new;
  return n_new;
}

/// The same zones in the same order and the same bonds broken at the same time, so that all is built up in the same
/// order as before, and rounded alike.
template <int dim>
void Body<dim>::restore(const discretization::SavedState<dim>& saved) {
  PERIMORPH_ASSERT(!topology_.is_built(), "the body has a topology already");
  state_.load_factor = saved.load_factor;
  state_.flag_points = saved.flag_points;
  topology_.note_flags(saved.flag_points);
  topology_.accept_slips(discretization::find_slips(saved, topology_));
  const bool has_grown = grow();
  state_.broken = discretization::find_broken(*comm_, saved, topology_);
  auto next = state_.broken.begin();
  for (; next != state_.broken.end() && next->first <= saved.break_calls_before_topology; ++next) {
    topology_.take({next->second});
  }
  rebuild(has_grown);
  for (; next != state_.broken.end(); ++next) publish({next->second});
  if (topology_.bonds().softens()) topology_.restore_softening(discretization::find_softened(*comm_, saved, topology_));

  static_cast<discretization::History<dim>&>(state_) = saved;
  state_.displacement = discretization::nodal_displacement(saved.displacement, topology_);
  if (base::max(*comm_, static_cast<GlobalId>(!saved.starts.empty())) > 0) {
    state_.starts = discretization::nodal_displacement(saved.starts, topology_);
    assemble();
  }
  forget_solves();
  renew_forces();
}

template <int dim>
void Body<dim>::forget_solves() {
  equilibrium_.forget();
  system_.forget_window();
  if (!topology_.bonds().softens() && problem_.crack_faces == discretization::CrackFaces::free) return;
  topology_.recount_damage();
  assemble();
  renew_forces();
}

template <int dim>
void Body<dim>::renew_forces() {
  system_.apply_load(state_.load_factor);
  system_.evaluate(displacement());
  work_.go_on_from(system_.moved(displacement()), system_.exerted(displacement()), power_of_supports(),
                   state_.load_step, taken_up());
}

/// By this rank's share of the body since the slips were last accepted, where the load is prescribed and contact may
/// change with it.
template <int dim>
std::optional<double> Body<dim>::taken_up() const {
  if (measure_ || problem_.crack_faces == discretization::CrackFaces::free) return std::nullopt;
  return system_.elastic_energy(displacement()) +
         bonds::work_of_friction(topology_.slips(), system_.slips(displacement()), mesh().n_owned_elements);
}

template <int dim>
double Body<dim>::elastic_energy() const {
  return base::sum(*comm_, system_.elastic_energy(displacement()));
}

template <int dim>
Energies Body<dim>::energies() const {
  const double t = problem_.thickness;
  const auto& spent = state_.energies;
  return {t * elastic_energy(), t * spent.dissipated, t * spent.external_work, t * spent.friction};
}

template <int dim>
operators::Overlap<dim> Body<dim>::overlap() const {
  return operators::largest_overlap(*comm_, model(), facing_sides_, displacement());
}

template <int dim>
base::Point<dim> Body<dim>::reaction(int node) const {
  PERIMORPH_ASSERT(node >= 0 && node < topology_.dofs().n_owned_nodes(), "node {} of {} owned ones", node,
                   topology_.dofs().n_owned_nodes());
  base::Point<dim> force;
  for (int c = 0; c < dim; ++c) {
    force[c] = problem_.thickness * (system_.internal_force()[node * dim + c] - system_.loads()[node * dim + c]);
  }
  return force;
}

template class Body<2>;
template class Body<3>;

}  // namespace perimorph::fracture
