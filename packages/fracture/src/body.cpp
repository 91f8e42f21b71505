#include "perimorph/fracture/body.hpp"

#include <Tpetra_Import.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "perimorph/base/errors.hpp"
#include "perimorph/mesh/distribute.hpp"
#include "perimorph/operators/broken_bonds.hpp"
#include "perimorph/operators/fields.hpp"

namespace perimorph::fracture {

using base::GlobalId;
using base::Phase;
using base::Point;
using morphing::ElementClass;

namespace {

/// Elements that a pre-crack cuts through: it passes between two of their points.
template <int dim>
std::vector<char> find_cut_elements(const mesh::Mesh<dim>& mesh, const elements::MaterialPoints<dim>& points,
                                    const std::vector<mesh::CrackFacet<dim>>& pre_cracks) {
  std::vector<char> cut(mesh.n_elements(), 0);
  if (pre_cracks.empty()) return cut;
  for (int e = 0; e < mesh.n_elements(); ++e) {
    std::vector<Point<dim>> own;
    for (int i = points.first(e); i < points.first(e + 1); ++i) own.push_back(points.position(i));
    const auto through = bonds::Visibility<dim>::among(pre_cracks, own);
    if (through.empty()) continue;
    for (int i = points.first(e); i < points.first(e + 1); ++i) {
      for (int j = i + 1; j < points.first(e + 1) && !cut[e]; ++j) {
        cut[e] = bonds::Visibility<dim>::blocks(through, points.position(i), points.position(j));
      }
    }
  }
  return cut;
}

}  // namespace

template <int dim>
Body<dim>::Body(const Teuchos::RCP<const base::Comm>& comm, const mesh::Mesh<dim>& mesh, const Problem<dim>& problem,
                BodyOptions options, base::Profile& profile)
    : comm_(comm),
      mesh_(mesh),
      problem_(problem),
      options_(std::move(options)),
      profile_(profile),
      points_(mesh, options_.points_per_direction),
      alpha_(mesh, points_, options_.blending_function),
      bonds_(mesh, points_, mesh::active_elements(mesh), problem.micromodulus, problem.pre_cracks,
             options.operator_form == OperatorForm::on_the_fly ? bonds::StiffnessStorage::on_the_fly
                                                               : bonds::StiffnessStorage::stored),
      elasticity_(problem.e0, options_.peridynamic_stiffness),
      dirichlet_(*comm, mesh, problem.displacements),
      element_exchange_(discretization::element_exchange(*comm, mesh)),
      corner_exchange_(discretization::corner_exchange(*comm, mesh)),
      solver_(options_.solver, profile),
      pending_zones_(problem.seeds),
      cut_by_pre_crack_(find_cut_elements<dim>(mesh, points_, problem.pre_cracks)),
      classes_(mesh.n_elements(), ElementClass::fe),
      discontinuous_(mesh.n_elements(), 0),
      flagged_(mesh.n_owned_elements, 0) {}

template <int dim>
Body<dim>::~Body() = default;

template <int dim>
void Body<dim>::apply_load(double load_factor) {
  counts_.linear_solves = counts_.cg_iterations = 0;
  load_is_new_ = true;
  // Everything is linear while no bond breaks: under proportional load the displacement scales.
  if (problem_.is_proportional && load_factor_ != 0. && !all_u_.is_null()) {
    owned_u_->scale(load_factor / load_factor_);
    all_u_->scale(load_factor / load_factor_);
  }
  load_factor_ = load_factor;
  forces_are_current_ = false;
}

template <int dim>
void Body<dim>::update_topology() {
  const bool is_first = dofs_ == nullptr;
  const bool alpha_changed = !pending_zones_.empty() || is_first;
  if (alpha_changed) grow();
  {
    const auto timer = profile_.measure(Phase::adapt);
    if (alpha_changed) classify();
    const bool split = find_discontinuous();
    if (is_first) check_pre_cracks();
    if (!split && !alpha_changed) return;
    elasticity_.update(mesh_, points_, bonds_, alpha_, classes_, discontinuous_);
    if (split || is_first) renumber();
  }
  assemble();
  forces_are_current_ = false;
  break_calls_before_topology_ = break_calls_;
  ++counts_.topologies;
}

template <int dim>
void Body<dim>::grow() {
  const auto timer = profile_.measure(Phase::search);
  bonds_.extend(alpha_.add(pending_zones_));
  pending_zones_.clear();
}

template <int dim>
void Body<dim>::assemble() {
  using Matrix = operators::CoupledStiffness<dim>;
  const auto timer = profile_.measure(Phase::assemble);
  const operators::Supports<dim> supports(model(), dirichlet_, discontinuous_);
  stiffness_ = Teuchos::rcp(new operators::MatrixFreeStiffness<dim>(model(), supports));
  const bool is_short_range = options_.preconditioner_matrix == PreconditionerMatrix::short_range;
  const bool is_crs = options_.operator_form == OperatorForm::crs;
  const auto old_basis = basis_;
  if (is_short_range) {
    const auto selection = operators::short_range(model(), *comm_, options_.short_range_cut_off);
    basis_ = Teuchos::rcp(new operators::PointBasis<dim>(model(), supports, discontinuous_));
    short_range_ = std::make_unique<Matrix>(model(), supports, selection, basis_);
  }
  if (is_crs || !is_short_range) matrix_ = std::make_unique<Matrix>(model(), supports);

  std::vector<Point<dim>> coordinates;
  for (int n = 0; n < dofs_->n_owned_nodes(); ++n) coordinates.push_back(mesh_.coordinates[dofs_->reference_node(n)]);
  if (!basis_.is_null()) basis_->move_to_points(coordinates);
  std::optional<base::NodeWeights> from_old;
  if (counts_.topologies > 0) {
    from_old =
        operators::weights_of_old_unknowns(model(), basis_.get(), old_dofs_ ? *old_dofs_ : *dofs_, old_basis.get());
  }
  old_dofs_.reset();
  const auto preconditioner_matrix = (is_short_range ? short_range_ : matrix_)->matrix();
  Teuchos::RCP<solvers::Operator> linear_operator = stiffness_;
  if (is_crs) linear_operator = matrix_->linear_operator();
  solver_.set_operator(linear_operator, preconditioner_matrix,
                       solvers::rigid_body_modes<dim>(*preconditioner_matrix, coordinates), basis_,
                       std::move(from_old));
}

template <int dim>
std::size_t Body<dim>::bytes_of_operator() const {
  return options_.operator_form == OperatorForm::crs ? matrix_->bytes() : stiffness_->bytes();
}

template <int dim>
void Body<dim>::classify() {
  const auto extremes = bonds_.neighbourhood_extremes(alpha_);
  for (int e = 0; e < mesh_.n_owned_elements; ++e) {
    const auto begin = points_.first(e), end = points_.first(e + 1);
    const double smallest = *std::min_element(extremes.smallest.begin() + begin, extremes.smallest.begin() + end);
    const double largest = *std::max_element(extremes.largest.begin() + begin, extremes.largest.begin() + end);
    classes_[e] = smallest >= 1. ? ElementClass::pd : largest > 0. ? ElementClass::morph : ElementClass::fe;
  }
  element_exchange_.update(classes_);
}

template <int dim>
bool Body<dim>::find_discontinuous() {
  GlobalId split = 0;
  GlobalId n_discontinuous = 0;
  for (int e = 0; e < mesh_.n_owned_elements; ++e) {
    const bool whole_zone = options_.discontinuous == DiscontinuousElements::whole_zone;
    const bool is_split =
        classes_[e] == ElementClass::pd && (whole_zone || bonds_.is_damaged(e) || cut_by_pre_crack_[e]);
    if (is_split && !discontinuous_[e]) split = 1;
    discontinuous_[e] = is_split;
    n_discontinuous += is_split;
  }
  element_exchange_.update(discontinuous_);
  counts_.dgfe_elements = base::sum(*comm_, n_discontinuous);
  return base::max(*comm_, split) > 0;
}

template <int dim>
void Body<dim>::check_pre_cracks() const {
  base::on_all_ranks(*comm_, [&] {
    for (int e = 0; e < mesh_.n_owned_elements; ++e) {
      if (!cut_by_pre_crack_[e] || classes_[e] == ElementClass::pd) continue;
      const auto c = mesh::centroid(mesh_, e);
      throw base::UserError(fmt::format(
          "/Pre-Cracks: a pre-crack cuts through the element at ({:.6g}), which is not peridynamic and so cannot part; "
          "let the crack run along sides of elements, or put a seed there that is wider by a horizon",
          fmt::join(c.begin(), c.end(), ", ")));
    }
  });
}

/// New degrees of freedom; the nodes of an element that has just been split start from the displacement of the node
/// that they part from.
template <int dim>
void Body<dim>::renumber() {
  auto dofs = std::make_unique<discretization::DofMap<dim>>(comm_, mesh_, corner_exchange_, discontinuous_);
  const auto all_u = Teuchos::rcp(new Vector(dofs->all_dofs()));
  if (dofs_ != nullptr) {
    const auto old_values = all_u_->getLocalViewHost(Tpetra::Access::ReadOnly);
    const auto new_values = all_u->getLocalViewHost(Tpetra::Access::ReadWrite);
    for (int e = 0; e < mesh_.n_elements(); ++e) {
      for (int k = 0; k < mesh_.n_corners(e); ++k) {
        for (int c = 0; c < dim; ++c) {
          new_values(dofs->nodes_of(e)[k] * dim + c, 0) = old_values(dofs_->nodes_of(e)[k] * dim + c, 0);
        }
      }
    }
  }
  old_dofs_ = std::exchange(dofs_, std::move(dofs));
  all_u_ = all_u;
  owned_u_ = Teuchos::rcp(new Vector(dofs_->owned_dofs()));
  Tpetra::deep_copy(*owned_u_, *all_u_->offsetView(dofs_->owned_dofs(), 0));
  residual_ = Teuchos::rcp(new Vector(dofs_->owned_dofs()));
  correction_ = Teuchos::rcp(new Vector(dofs_->owned_dofs()));
  last_u_.assign(displacement(), displacement() + owned_u_->getLocalLength());
  last_force_.assign(last_u_.size(), 0.);
  counts_.unknowns = dofs_->n_global_nodes() * dim;
  facing_sides_ = operators::facing_sides(mesh_, discontinuous_);
}

template <int dim>
void Body<dim>::solve(Accuracy accuracy) {
  constexpr int max_passes = 10;
  // A severed body has no reactions left that its residual could relate to: then these shares of the largest reaction
  // so far count, and of the largest that a first guess took, which moves the supports alone.
  constexpr double of_solution = 0.1, of_first_guess = 1e-4;
  // A piece that hangs on bonds weaker than its anchors moves by little in each pass: then the anchors give way, by
  // powers of two, so that they come back to the bit. A body with all its bonds hardly needs them, and a large one
  // would feel them.
  constexpr double slow = 0.5, loosening = 0x1p-10, loosest = 0x1p-30;
  double anchors = 1., last_residual = std::numeric_limits<double>::infinity();
  const auto loosen_anchors = [&] {
    stiffness_->scale_anchors(loosening);
    anchors *= loosening;
  };
  const double tolerance = accuracy == Accuracy::breaking ? options_.damage_tolerance : options_.tolerance;

  if (!forces_are_current_) {  // a new load or topology: loads_ too
    loads_ = problem_.loads.forces(mesh_, points_, *dofs_, load_factor_);
    prescribe_displacements();
    update_forces();
  }
  for (int pass = 0;; ++pass) {
    const Balance balance = this->balance();
    if (pass == 0) force_scale_ = std::max(force_scale_, of_first_guess * balance.reaction);
    const double target = tolerance * std::max(balance.reaction, force_scale_);
    if (balance.residual <= target) {
      force_scale_ = std::max(force_scale_, of_solution * balance.reaction);
      break;
    }
    if (counts_.broken_bonds == 0 && anchors == 1.) loosen_anchors();
    if (balance.residual > slow * last_residual && anchors > loosest) loosen_anchors();
    last_residual = balance.residual;
    if (pass == max_passes) {
      throw base::ComputationError(
          fmt::format("the forces do not balance: residual {:.3e}, reactions {:.3e} after {} solves", balance.residual,
                      balance.reaction, max_passes));
    }
    counts_.cg_iterations += solver_.solve(*residual_, *correction_, 0.5 * target);
    ++counts_.linear_solves;
    owned_u_->update(1., *correction_, 1.);
    all_u_->doImport(*owned_u_, *dofs_->import(), Tpetra::INSERT);
    prescribe_displacements();  // exactly: corrections are zero there only up to rounding
    update_forces();
  }
  if (anchors != 1.) stiffness_->scale_anchors(1. / anchors);
  record_work();
}

template <int dim>
void Body<dim>::prescribe_displacements() {
  const auto all = all_u_->getLocalViewHost(Tpetra::Access::ReadWrite);
  const auto owned = owned_u_->getLocalViewHost(Tpetra::Access::ReadWrite);
  for (int n = 0; n < dofs_->n_nodes(); ++n) {
    for (int c = 0; c < dim; ++c) {
      if (!is_prescribed(n, c)) continue;
      all(n * dim + c, 0) = dirichlet_.value(dofs_->reference_node(n), c, load_factor_);
      if (n < dofs_->n_owned_nodes()) owned(n * dim + c, 0) = all(n * dim + c, 0);
    }
  }
}

template <int dim>
void Body<dim>::update_forces() {
  const auto timer = profile_.measure(Phase::residual);
  at_points_ = operators::displacements_at_points(model(), displacement());
  force_ = stiffness_->internal_force(displacement());
  forces_are_current_ = true;
}

/// Fills the residual (loads - internal forces where nothing is prescribed); reactions are the rest, and the loads.
template <int dim>
typename Body<dim>::Balance Body<dim>::balance() {
  const auto residual = residual_->getLocalViewHost(Tpetra::Access::OverwriteAll);
  std::vector<double> squares = {0., 0.};
  for (int n = 0; n < dofs_->n_owned_nodes(); ++n) {
    for (int c = 0; c < dim; ++c) {
      const int dof = n * dim + c;
      const double difference = loads_[dof] - force_[dof];
      residual(dof, 0) = is_prescribed(n, c) ? 0. : difference;
      squares[0] += residual(dof, 0) * residual(dof, 0);
      squares[1] += loads_[dof] * loads_[dof] + (is_prescribed(n, c) ? difference * difference : 0.);
    }
  }
  base::sum(*comm_, squares);
  return {std::sqrt(squares[0]), std::sqrt(squares[1])};
}

/// Work of all outer forces since the last solution. While the load rises no bond breaks and forces change linearly; at
/// a fixed load only prescribed forces do work.
template <int dim>
void Body<dim>::record_work() {
  const std::vector<double> u(displacement(), displacement() + force_.size());
  double work = 0.;
  for (std::size_t i = 0; i < u.size(); ++i) {
    work += (u[i] - last_u_[i]) * (load_is_new_ ? 0.5 * (last_force_[i] + force_[i]) : loads_[i]);
  }
  external_work_ += base::sum(*comm_, work);
  load_is_new_ = false;
  last_u_ = u;
  last_force_ = force_;
}

template <int dim>
GlobalId Body<dim>::break_bonds() {
  const auto timer = profile_.measure(Phase::bonds);
  if (std::isinf(problem_.critical_stretch)) return 0;
  const auto broken = bonds_.break_overstretched(at_points_, breaking_stretch(), classes_);
  take_out(broken);
  ++break_calls_;
  if (!broken.empty()) broken_by_call_[break_calls_] = broken;
  operators::subtract_bond_forces(model(), broken, at_points_, force_);
  dissipated_ += base::sum(*comm_, operators::bond_energy(model(), broken, at_points_));
  const auto is_counted_here = [&](std::size_t b) {
    return bonds_.pair(bonds_.pair_of(b)).first < mesh_.n_owned_elements;
  };
  const GlobalId n_broken =
      base::sum(*comm_, static_cast<GlobalId>(std::count_if(broken.begin(), broken.end(), is_counted_here)));
  counts_.broken_bonds += n_broken;
  return n_broken;
}

/// The stretch from which bonds break now: the critical one, or that of the last bond among the worst. Those that
/// stretch as far up to rounding, such as mirror images, go together.
template <int dim>
double Body<dim>::breaking_stretch() const {
  constexpr double rounding = 1e-12;
  if (options_.breaking_fraction >= 1.) return problem_.critical_stretch;
  auto all = base::gather_on_all(*comm_, bonds_.overstretches(at_points_, problem_.critical_stretch, classes_));
  if (all.empty()) return problem_.critical_stretch;
  const auto n_worst = static_cast<long>(std::ceil(options_.breaking_fraction * static_cast<double>(all.size())));
  std::nth_element(all.begin(), all.begin() + (n_worst - 1), all.end(), std::greater<>());
  return std::max(problem_.critical_stretch, all[static_cast<std::size_t>(n_worst - 1)] - rounding);
}

template <int dim>
void Body<dim>::take_out(const std::vector<std::size_t>& broken) {
  stiffness_->subtract(broken);
  std::vector<int> changed;  // in the preconditioner's matrix
  if (matrix_) changed = matrix_->subtract(broken);
  if (short_range_) changed = short_range_->subtract(broken);
  if (!broken.empty()) solver_.note_change(changed);
}

template <int dim>
GlobalId Body<dim>::flag_damaged_elements() {
  const auto timer = profile_.measure(Phase::adapt);
  const GlobalId growth = flag_points_.empty() ? 1 : flag_points_.back().growth + 1;
  std::vector<FlagPoint<dim>> own;
  for (int e = 0; e < mesh_.n_owned_elements; ++e) {
    if (flagged_[e] || !bonds_.is_damaged(e)) continue;
    flagged_[e] = 1;
    own.push_back({mesh_.element_ids[e], growth, {}});
    Eigen::Map<Point<dim>>(own.back().centroid.data()) = mesh::centroid(mesh_, e);
  }
  auto flag_points = base::gather_on_all(*comm_, own);
  std::sort(flag_points.begin(), flag_points.end(), [](const auto& a, const auto& b) { return a.element < b.element; });
  for (const auto& flag : flag_points) add_zone(flag);
  counts_.damaged_elements += static_cast<GlobalId>(flag_points.size());
  return static_cast<GlobalId>(flag_points.size());
}

template <int dim>
void Body<dim>::add_zone(const FlagPoint<dim>& flag) {
  flag_points_.push_back(flag);
  pending_zones_.push_back(morphing::Zone<dim>::ball(Eigen::Map<const Point<dim>>(flag.centroid.data()),
                                                     options_.growth_inner_radius, options_.growth_outer_radius));
}

template <int dim>
BodyState<dim> Body<dim>::state() const {
  BodyState<dim> state{load_factor_, force_scale_, {0., dissipated_, external_work_},
                       counts_,      break_calls_, break_calls_before_topology_,
                       flag_points_, {},           {}};
  for (const auto& [call, broken] : broken_by_call_) {
    for (const auto bond : broken) {
      const auto [first, second] = bonds_.pair(bonds_.pair_of(bond));
      if (first >= mesh_.n_owned_elements) continue;
      state.broken.push_back(
          {points_.global_id(first, bonds_.first_end(bond)), points_.global_id(second, bonds_.second_end(bond)), call});
    }
  }
  constexpr int stride = BodyState<dim>::values_per_element;
  const double* u = displacement();
  state.displacement.assign(static_cast<std::size_t>(mesh_.n_owned_elements) * stride, 0.);
  for (int e = 0; e < mesh_.n_owned_elements; ++e) {
    double* values = state.displacement.data() + static_cast<std::size_t>(e) * stride;
    for (int k = 0; k < mesh_.n_corners(e); ++k) std::copy_n(u + dofs_->nodes_of(e)[k] * dim, dim, values + k * dim);
  }
  return state;
}

/// The same zones in the same order and the same bonds broken at the same time, so that all is built up in the same
/// order as before, and rounded alike.
template <int dim>
void Body<dim>::restore(const BodyState<dim>& state) {
  PERIMORPH_ASSERT(dofs_ == nullptr, "the body has a topology already");
  grow_again(state);
  broken_by_call_ = find_broken(state);
  const auto break_again = [&](const std::vector<std::size_t>& broken) {
    for (const auto bond : broken) bonds_.set_broken(bond);
  };
  auto next = broken_by_call_.begin();
  for (; next != broken_by_call_.end() && next->first <= state.break_calls_before_topology; ++next) {
    break_again(next->second);
  }
  update_topology();
  for (; next != broken_by_call_.end(); ++next) {
    break_again(next->second);
    take_out(next->second);
  }
  move_to(state.displacement);

  load_factor_ = state.load_factor;
  force_scale_ = state.force_scale;
  dissipated_ = state.energies.dissipated;
  external_work_ = state.energies.external_work;
  counts_ = state.counts;
  break_calls_ = state.break_calls;
  break_calls_before_topology_ = state.break_calls_before_topology;
  loads_ = problem_.loads.forces(mesh_, points_, *dofs_, load_factor_);
  update_forces();
  last_force_ = force_;
}

/// Zones are added growth by growth: the order of the bonds depends on it.
template <int dim>
void Body<dim>::grow_again(const BodyState<dim>& state) {
  std::map<GlobalId, int> place_of;
  for (int e = 0; e < mesh_.n_owned_elements; ++e) place_of[mesh_.element_ids[e]] = e;
  for (const auto& flag : state.flag_points) {
    if (!pending_zones_.empty() && (flag_points_.empty() || flag_points_.back().growth != flag.growth)) grow();
    add_zone(flag);
    if (const auto found = place_of.find(flag.element); found != place_of.end()) flagged_[found->second] = 1;
  }
  grow();
}

template <int dim>
typename Body<dim>::BrokenByCall Body<dim>::find_broken(const BodyState<dim>& state) const {
  constexpr int n = elements::max_points;
  std::map<GlobalId, int> place_of;
  for (int e = 0; e < mesh_.n_elements(); ++e) place_of[mesh_.element_ids[e]] = e;
  BrokenByCall found;
  GlobalId n_own = 0;
  for (const auto& broken : state.broken) {
    const auto first = place_of.find(broken.first / n), second = place_of.find(broken.second / n);
    if (first == place_of.end() || second == place_of.end()) continue;
    const auto bond = bonds_.find(first->second, static_cast<int>(broken.first % n), second->second,
                                  static_cast<int>(broken.second % n));
    if (bond == bonds_.n_bonds()) continue;
    found[broken.call].push_back(bond);
    n_own += first->second < mesh_.n_owned_elements;
  }
  for (auto& [call, bonds] : found) std::sort(bonds.begin(), bonds.end());
  const GlobalId n_found = base::sum(*comm_, n_own);
  if (n_found == state.counts.broken_bonds) return found;
  throw base::UserError(
      fmt::format("of {} broken bonds only {} are bonds of this body", state.counts.broken_bonds, n_found));
}

template <int dim>
void Body<dim>::move_to(const std::vector<double>& displacement) {
  {
    const auto all = all_u_->getLocalViewHost(Tpetra::Access::ReadWrite);
    for (int e = 0; e < mesh_.n_elements(); ++e) {
      const double* values = displacement.data() + static_cast<std::size_t>(e) * BodyState<dim>::values_per_element;
      for (int k = 0; k < mesh_.n_corners(e); ++k) {
        for (int c = 0; c < dim; ++c) all(dofs_->nodes_of(e)[k] * dim + c, 0) = values[k * dim + c];
      }
    }
  }
  Tpetra::deep_copy(*owned_u_, *all_u_->offsetView(dofs_->owned_dofs(), 0));
  last_u_.assign(this->displacement(), this->displacement() + last_u_.size());
}

template <int dim>
Energies Body<dim>::energies() const {
  double elastic = 0.;
  for (std::size_t i = 0; i < force_.size(); ++i) elastic += 0.5 * force_[i] * displacement()[i];
  return {base::sum(*comm_, elastic), dissipated_, external_work_};
}

template <int dim>
operators::Overlap<dim> Body<dim>::overlap() const {
  const auto own = operators::largest_overlap(model(), facing_sides_, displacement());
  std::vector<double> numbers = {own.depth};
  numbers.insert(numbers.end(), own.place.begin(), own.place.end());
  const auto all = base::gather_on_all(*comm_, numbers);
  operators::Overlap<dim> largest;
  for (auto one = all.begin(); one != all.end(); one += dim + 1) {
    if (*one > largest.depth) largest = {*one, Eigen::Map<const Point<dim>>(&one[1])};
  }
  return largest;
}

template <int dim>
operators::CoupledModel<dim> Body<dim>::model() const {
  return {mesh_, points_, bonds_, alpha_, elasticity_, *dofs_};
}

template <int dim>
const double* Body<dim>::displacement() const {
  return all_u_->getLocalViewHost(Tpetra::Access::ReadOnly).data();
}

template <int dim>
Point<dim> Body<dim>::reaction(int node) const {
  Point<dim> force;
  for (int c = 0; c < dim; ++c) force[c] = force_[node * dim + c] - loads_[node * dim + c];
  return force;
}

BodyOptions body_options(const Case& input) {
  BodyOptions options;
  options.blending_function = input.blending_function;
  options.discontinuous = input.discontinuous;
  options.peridynamic_stiffness = input.peridynamic_stiffness;
  options.growth_inner_radius = input.growth_inner_radius;
  options.growth_outer_radius = input.growth_outer_radius;
  options.tolerance = input.tolerance;
  options.breaking_fraction = input.breaking_fraction;
  options.damage_tolerance = std::max(input.damage_tolerance, input.tolerance);
  options.operator_form = input.operator_form;
  options.preconditioner_matrix = input.preconditioner_matrix;
  options.short_range_cut_off = input.short_range_cut_off;
  options.solver = {input.max_cg_iterations, input.renewal_cost, input.belos, input.muelu};
  options.points_per_direction = input.points_per_direction;
  return options;
}

template class Body<2>;
template class Body<3>;

}  // namespace perimorph::fracture
