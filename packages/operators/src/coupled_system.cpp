#include "perimorph/operators/coupled_system.hpp"

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "perimorph/base/errors.hpp"
#include "perimorph/operators/broken_bonds.hpp"
#include "perimorph/operators/fields.hpp"
#include "perimorph/operators/local_forces.hpp"

namespace perimorph::operators {

using base::Phase;
using base::Point;

template <int dim>
CoupledSystem<dim>::CoupledSystem(const base::Comm& comm, const discretization::Topology<dim>& topology,
                                  const discretization::Dirichlet<dim>& dirichlet,
                                  const discretization::Loads<dim>& loads, ElasticResponse<dim> response,
                                  SystemOptions options, base::Profile& profile)
    : comm_(comm),
      topology_(topology),
      dirichlet_(dirichlet),
      load_data_(loads),
      options_(options),
      profile_(profile),
      elasticity_(std::move(response.elasticity)),
      eigenstrain_(std::move(response.eigenstrain)),
      window_(options.window) {
  PERIMORPH_ASSERT(options.preconditioner_matrix == PreconditionerMatrix::coupled || options.short_range_cut_off > 0.,
                   "short-range bonds up to {}", options.short_range_cut_off);
  PERIMORPH_ASSERT(!elasticity_.has_dilatation() || options.operator_form != OperatorForm::crs,
                   "dilatation in the operator's form {}", static_cast<int>(options.operator_form));
}

template <int dim>
CoupledModel<dim> CoupledSystem<dim>::model() const {
  return {topology_.mesh(),
          topology_.points(),
          topology_.bonds(),
          topology_.alpha(),
          elasticity_,
          topology_.dofs(),
          eigenstrain_.exists() ? &eigenstrain_ : nullptr};
}

template <int dim>
void CoupledSystem<dim>::follow_morphing() {
  elasticity_.update(topology_.mesh(), topology_.points(), topology_.bonds(), topology_.alpha(), topology_.classes(),
                     topology_.discontinuous());
  if (elasticity_.has_several_materials()) topology_.element_exchange().update(elasticity_.zero_flags());
}

template <int dim>
void CoupledSystem<dim>::make_terms(const Supports<dim>& supports) {
  anchors_ = Teuchos::rcp(new Anchors<dim>(supports.anchors));
  bond_forces_ = Teuchos::rcp(new BondForces<dim>(model()));
  terms_ = {Teuchos::rcp(new LocalForces<dim>(model())), bond_forces_, anchors_};
  if (topology_.crack_faces() == discretization::CrackFaces::contact) {
    contact_ = Teuchos::rcp(new ContactForces<dim>(model(), topology_, options_.friction));
    terms_.push_back(contact_);
  }
  load_terms_ = {Teuchos::rcp(new LoadForces<dim>(model(), load_data_))};
}

template <int dim>
void CoupledSystem<dim>::make_matrices(const Supports<dim>& supports) {
  const bool is_short_range = options_.preconditioner_matrix == PreconditionerMatrix::short_range;
  const auto make_matrix = [&](const BondSelection& selection, const Teuchos::RCP<const PointBasis<dim>>& basis) {
    return std::make_unique<StiffnessMatrix<dim>>(model(), *space_, terms_, supports.constraints, selection, basis);
  };
  if (is_short_range) {
    const auto selection = operators::short_range(model(), comm_, options_.short_range_cut_off);
    basis_ = Teuchos::rcp(new PointBasis<dim>(model(), *space_, topology_.discontinuous()));
    short_range_ = make_matrix(selection, basis_);
  }
  if (options_.operator_form == OperatorForm::crs || !is_short_range) matrix_ = make_matrix(all_bonds, Teuchos::null);
}

template <int dim>
typename CoupledSystem<dim>::PreconditionerSource CoupledSystem<dim>::assemble(std::vector<double> starts) {
  const bool is_first = tangent_.is_null();
  const auto old_basis = basis_;
  has_forces_ = false;
  space_ = std::make_unique<discretization::Space<dim>>(topology_.dofs(), dirichlet_, std::move(starts));
  const Supports<dim> supports(model(), *space_, topology_.discontinuous());
  make_terms(supports);
  tangent_ = Teuchos::rcp(new MatrixFreeTangent<dim>(*space_, terms_, supports.constraints));
  make_matrices(supports);
  constraints_ = supports.constraints;
  window_.clear();

  PreconditionerSource source{(short_range_ ? short_range_ : matrix_)->matrix(), basis_, {}, std::nullopt};
  for (int n = 0; n < topology_.dofs().n_owned_nodes(); ++n) {
    source.coordinates.push_back(topology_.mesh().coordinates[topology_.dofs().reference_node(n)]);
  }
  if (!basis_.is_null()) basis_->move_to_points(source.coordinates);
  if (!is_first) {
    source.from_old = weights_of_old_unknowns(model(), basis_.get(), topology_.old_dofs(), old_basis.get());
  }
  return source;
}

template <int dim>
Teuchos::RCP<Tpetra::CrsMatrix<double>> CoupledSystem<dim>::whole_matrix() const {
  PERIMORPH_ASSERT(space_ != nullptr, "the matrix of {} elements before anything is assembled",
                   topology_.mesh().n_elements());
  const Supports<dim> supports(model(), *space_, topology_.discontinuous());
  return StiffnessMatrix<dim>(model(), *space_, terms_, supports.constraints, all_bonds, basis_).matrix();
}

template <int dim>
void CoupledSystem<dim>::apply_load(double load_factor) {
  PERIMORPH_ASSERT(space_ != nullptr, "load factor {} before anything is assembled", load_factor);
  load_factor_ = load_factor;
  for (const auto& terms : {terms_, load_terms_}) {
    for (const auto& term : terms) term->apply_load(load_factor);
  }
  if (!eigenstrain_.exists()) return;
  eigenstrain_.apply_load(load_factor);
  const std::vector<double> still(space_->n_local(), 0.);
  held_expansion_ = sum_of_forces(terms_, base::field(still));
}

template <int dim>
std::vector<int> CoupledSystem<dim>::take(const bonds::BondChange& change) {
  PERIMORPH_ASSERT(space_ != nullptr, "{} bonds break before anything is assembled", change.broken.size());
  for (const auto& term : terms_) term->take(change);
  std::vector<int> changed;
  if (matrix_) changed = matrix_->take(change);
  if (short_range_) changed = short_range_->take(change);
  window_.take(change, model());
  if (breaks_change_more()) has_forces_ = false;
  if (has_forces_) subtract_lost_forces(model(), change, at_points_, internal_);
  return changed;
}

template <int dim>
std::vector<double> CoupledSystem<dim>::sum_of_forces(const ForceTerms<dim>& terms, base::ConstField u) const {
  std::vector<double> forces(space_->n_local(), 0.);
  for (const auto& term : terms) term->add_force(u, base::field(forces));
  space_->hanging_nodes().gather(base::field(forces));
  forces.resize(space_->n_owned());
  return forces;
}

template <int dim>
bonds::Slips<dim> CoupledSystem<dim>::slips(base::ConstField u) const {
  return contact_.is_null() ? bonds::Slips<dim>() : contact_->slips(u);
}

template <int dim>
void CoupledSystem<dim>::follow_slips() {
  if (!contact_.is_null()) contact_->follow_slips();
}

/// 1/2 F . u, and the same of the eigenstrain, but for what faces have slid.
template <int dim>
double CoupledSystem<dim>::elastic_energy(base::ConstField u) const {
  double elastic = 0.;
  for (std::size_t i = 0; i < internal_.size(); ++i) {
    elastic = std::fma(0.5 * internal_[i], u[static_cast<base::ConstField::size_type>(i)], elastic);
  }
  for (const auto& contact : at_points_.contacts) {
    if (contact.bond.first_element < topology_.mesh().n_owned_elements) elastic -= contact.slid_energy;
  }
  const auto confinement = this->confinement(u);
  for (std::size_t p = 0; p < confinement.size(); ++p) elastic += 0.5 * confinement[p] * at_points_.eigenstrain[p];
  return elastic;
}

template <int dim>
std::vector<double> CoupledSystem<dim>::confinement(base::ConstField u) const {
  if (!eigenstrain_.exists()) return {};
  std::vector<double> at_points(topology_.points().size(), 0.);
  for (const auto& term : terms_) term->add_confinement(u, base::field(at_points));
  at_points.resize(topology_.points().first(topology_.mesh().n_owned_elements));
  return at_points;
}

template <int dim>
std::vector<double> CoupledSystem<dim>::moved(base::ConstField u, const std::vector<double>& eigenstrain) const {
  const std::ptrdiff_t n_owned = topology_.dofs().n_owned_nodes() * dim;
  std::vector<double> moved(u.begin(), u.begin() + n_owned);
  if (!eigenstrain_.exists()) return moved;
  const int n_points = topology_.points().first(topology_.mesh().n_owned_elements);
  moved.insert(moved.end(), eigenstrain.begin(), eigenstrain.begin() + n_points);
  return moved;
}

template <int dim>
std::vector<double> CoupledSystem<dim>::exerted(base::ConstField u) const {
  auto exerted = internal_;
  const auto confinement = this->confinement(u);
  exerted.insert(exerted.end(), confinement.begin(), confinement.end());
  return exerted;
}

template <int dim>
void CoupledSystem<dim>::evaluate(base::ConstField u) {
  PERIMORPH_ASSERT(static_cast<std::size_t>(u.size()) == space_->n_local(),
                   "{} displacements for {} degrees of freedom", u.size(), space_->n_local());
  const auto timer = profile_.measure(Phase::residual);
  internal_ = sum_of_forces(terms_, u);
  at_points_ = {
      displacements_at_points(model(), u), bond_forces_->dilatational_stretch(), {}, eigenstrain_.at_points()};
  if (!contact_.is_null()) at_points_.contacts = contact_->closed(u);
  loads_ = sum_of_forces(load_terms_, u);
  for (double& load : loads_) load = -load;
  has_forces_ = true;
}

template <int dim>
std::vector<double> CoupledSystem<dim>::dilatation() const {
  if (!topology_.bonds().materials().sees_compression()) return {};
  return dilatation_at_points(model(), at_points_, topology_.element_exchange());
}

template <int dim>
NonlinearSystem::Norms CoupledSystem<dim>::residual(Vector& residual) const {
  PERIMORPH_ASSERT(has_forces_ && residual.getLocalLength() == space_->n_owned(),
                   "residual of {} for {} degrees of freedom, evaluated: {}", residual.getLocalLength(),
                   space_->n_owned(), has_forces_);
  const auto values = residual.getLocalViewHost(Tpetra::Access::OverwriteAll);
  const base::Field unbalanced(values.data(), static_cast<base::Field::size_type>(space_->n_owned()));
  const auto difference = [&](int dof) { return loads_[dof] - internal_[dof]; };
  for (int dof = 0; dof < unbalanced.size(); ++dof) unbalanced[dof] = difference(dof);
  space_->restrict_forces(unbalanced);
  std::vector<double> squares = {0., 0.};
  for (int dof = 0; dof < unbalanced.size(); ++dof) {
    const double all = difference(dof), free = unbalanced[dof];
    squares[0] += free * free;
    squares[1] += loads_[dof] * loads_[dof] + (all == free ? 0. : all * all - free * free);  // the constraints take it
    if (!held_expansion_.empty()) squares[1] += held_expansion_[dof] * held_expansion_[dof];
  }
  base::sum(comm_, squares);
  return {std::sqrt(squares[0]), std::sqrt(std::max(0., squares[1]))};
}

template <int dim>
NonlinearSystem::Norms CoupledSystem<dim>::imbalance_after(const bonds::BondChange& change) const {
  Vector now(unknowns());
  const double reaction = residual(now).reaction;
  std::vector<double> lost(space_->n_owned(), 0.);
  subtract_lost_forces(model(), change, at_points_, lost);
  space_->restrict_forces(base::field(lost));
  const double squares = std::inner_product(lost.begin(), lost.end(), lost.begin(), 0.);
  return {std::sqrt(base::sum(comm_, squares)), reaction};
}

template <int dim>
void CoupledSystem<dim>::correct(base::Field u, const Vector& correction) {
  PERIMORPH_ASSERT(correction.getLocalLength() == space_->n_owned(), "correction of {} for {} degrees of freedom",
                   correction.getLocalLength(), space_->n_owned());
  const auto change = space_->expand_change(correction);
  for (int dof = 0; dof < static_cast<int>(space_->n_owned()); ++dof) u[dof] += change[dof];
  space_->expand(u, load_factor_);
  evaluate(u);
}

template <int dim>
std::vector<int> CoupledSystem<dim>::prepare_tangent(base::ConstField u) {
  PERIMORPH_ASSERT(static_cast<std::size_t>(u.size()) == space_->n_local(),
                   "{} displacements for {} degrees of freedom", u.size(), space_->n_local());
  for (const auto& term : terms_) term->prepare_tangent(u);
  std::vector<int> changed;
  if (matrix_) changed = matrix_->update_tangent();
  if (short_range_) changed = short_range_->update_tangent();
  if (!contact_.is_null()) window_.take(contact_->stiffened());
  return changed;
}

template <int dim>
Teuchos::RCP<NonlinearSystem::Operator> CoupledSystem<dim>::tangent() const {
  if (options_.operator_form == OperatorForm::crs) return matrix_->linear_operator();
  return tangent_;
}

template <int dim>
std::shared_ptr<Window> CoupledSystem<dim>::window() {
  const auto timer = profile_.measure(Phase::preconditioner);
  const auto model = this->model();
  return window_.find({model, *space_, topology_.element_exchange(), terms_, constraints_, basis_.get()});
}

template <int dim>
void CoupledSystem<dim>::load_derivative(Vector& derivative) const {
  PERIMORPH_ASSERT(derivative.getLocalLength() == space_->n_owned(), "derivative of {} for {} degrees of freedom",
                   derivative.getLocalLength(), space_->n_owned());
  std::vector<double> forces(space_->n_local(), 0.);
  const auto rates = space_->prescribed_rates(load_factor_, 0.);
  for (const auto& term : terms_) term->add_tangent_product(base::field(rates), base::field(forces));
  for (const auto& terms : {terms_, load_terms_}) {
    for (const auto& term : terms) term->add_load_derivative(base::field(forces));
  }
  space_->restrict_forces(base::field(forces));
  const auto values = derivative.getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (std::size_t dof = 0; dof < space_->n_owned(); ++dof) values(dof, 0) = -forces[dof];
}

template <int dim>
void CoupledSystem<dim>::expand_response(const Vector& x, base::Field response) const {
  PERIMORPH_ASSERT(static_cast<std::size_t>(response.size()) == space_->n_local(), "{} rates for {} degrees of freedom",
                   response.size(), space_->n_local());
  const auto rates = space_->prescribed_rates(load_factor_, 0.);
  const auto change = space_->expand_change(x);
  for (int dof = 0; dof < response.size(); ++dof) response[dof] = rates[dof] + change[dof];
}

template <int dim>
std::size_t CoupledSystem<dim>::bytes_of_operator() const {
  return options_.operator_form == OperatorForm::crs ? matrix_->bytes() : tangent_->bytes();
}

template class CoupledSystem<2>;
template class CoupledSystem<3>;

}  // namespace perimorph::operators
