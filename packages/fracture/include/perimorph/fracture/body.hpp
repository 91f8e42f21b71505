#pragma once

#include <optional>

#include "perimorph/base/errors.hpp"
#include "perimorph/discretization/saved_state.hpp"
#include "perimorph/model/numerical_options.hpp"
#include "perimorph/model/problem.hpp"
#include "perimorph/operators/coupled_system.hpp"
#include "perimorph/operators/crack_faces.hpp"
#include "perimorph/operators/external_work.hpp"
#include "perimorph/solvers/equilibrium.hpp"

namespace perimorph::fracture {

using model::NumericalOptions;
using model::Problem;

/// How well to solve: between breaks, or well enough to say that nothing breaks.
enum class Accuracy { breaking, accepted };

/// An increment cannot be finished. The body is as it was at the last equilibrium, but for the bonds that have broken
/// since.
struct UnfinishedIncrement : base::ComputationError {
  using base::ComputationError::ComputationError;
};

using discretization::Counts;
using discretization::Energies;

/// The deforming, breaking body: its state, and the topology and the system of equations that follow it. The adaptive
/// loop (WHL19, Fig. 5) calls its verbs in turn. All verbs are collective.
template <int dim>
class Body {
 public:
  /// The mesh and the problem must outlive this.
  Body(const Teuchos::RCP<const base::Comm>& comm, const mesh::Mesh<dim>& mesh, const Problem<dim>& problem,
       const NumericalOptions& options, base::Profile& profile);

  /// Sets the load; the displacement is scaled along when the loads are proportional.
  /// @param load_factor [-]
  void apply_load(double load_factor);

  /// Begins an increment, or goes on in one that has begun.
  /// @param value the load factor [-], or what is to be measured, [length] (model::Problem::prescribed_in)
  void prescribe(double value, bool has_begun = false);

  /// Lets alpha, bonds, classes and DGFE follow the flag points and the damage, and supports that end let go;
  /// renumbers.
  /// @throws UserError at the first call, if a pre-crack cuts through elements outside the peridynamic zone.
  void update_topology();

  /// Solves R(u; bonds, load) = 0 for the displacement; costs nothing if it is accurate enough already. Where a measure
  /// is prescribed, the load factor follows it: u is linear in it while no bond breaks.
  /// @throws UnfinishedIncrement if none is found, with the reason where a part of the body is free; ComputationError
  /// if the solver fails.
  void solve(Accuracy accuracy);

  /// Breaks the bonds that reached the critical stretch, or the worst of them (NumericalOptions::breaking_fraction),
  /// and softens those that are stretched further than ever; returns how many. Softening that would change the forces
  /// by less than a tolerance (NumericalOptions::softening_tolerance) waits for the next load.
  /// @param may_recover whether what has softened under this load may be taken back, where it went too far
  base::GlobalId break_bonds(bool may_recover = false);

  /// What has softened or slid under this load is not taken back any more.
  void accept_history();

  /// Makes the centroids of newly damaged elements flag points, around which alpha will grow [WHL19, section 3.3];
  /// returns how many.
  base::GlobalId flag_damaged_elements();

  /// What this rank has to remember. Local.
  discretization::SavedState<dim> save() const { return discretization::save(state_, topology_); }

  /// The state of a new body becomes this one, to the last bit if the number of ranks is the same.
  /// @param saved the displacement of all local elements, and at least the bonds of which this rank has the first
  /// element
  /// @throws UserError if bonds of the state do not exist in this body.
  void restore(const discretization::SavedState<dim>& saved);

  /// What comes depends on the state only, and not on what the solver has done before, nor on the order in which bonds
  /// have softened, or contacts opened and closed.
  void forget_solves();

  /// After a solve: nor does it depend on the order in which forces have been summed up.
  void renew_forces();

  /// Over all ranks and the thickness, [energy].
  Energies energies() const;

  /// Where crack faces have passed furthest through each other.
  operators::Overlap<dim> overlap() const;

  // All local.
  const discretization::State<dim>& state() const { return state_; }
  const discretization::Topology<dim>& topology() const { return topology_; }
  const operators::CoupledSystem<dim>& system() const { return system_; }
  operators::CoupledModel<dim> model() const { return system_.model(); }
  const Problem<dim>& problem() const { return problem_; }
  const mesh::Mesh<dim>& mesh() const { return topology_.mesh(); }
  const Counts& counts() const { return state_.counts; }
  double load_factor() const { return state_.load_factor; }
  const std::vector<std::string>& solver_fallbacks() const { return equilibrium_.linear_solver().fallbacks(); }
  /// What is measured for control, [length]; 0 without. Collective.
  double measured() const;

  /// On all local degrees of freedom, [length].
  base::ConstField displacement() const { return base::field(state_.displacement); }

  /// Force that supports exert on an owned node, over the thickness, (dim), [force].
  base::Point<dim> reaction(int node) const;

 private:
  Teuchos::RCP<const base::Comm> comm_;
  const Problem<dim>& problem_;
  NumericalOptions options_;
  base::Profile& profile_;

  discretization::State<dim> state_;
  discretization::Topology<dim> topology_;
  discretization::Dirichlet<dim> dirichlet_;
  operators::CoupledSystem<dim> system_;
  solvers::Equilibrium equilibrium_;
  operators::ExternalWork work_;
  std::optional<discretization::Measure<dim>> measure_;  ///< that the load factor follows
  double prescribed_ = 0.;                               ///< of it, [length]
  std::vector<operators::FacingSides> facing_sides_;     ///< that may be crack faces, in this topology

  bool grow();
  void rebuild(bool has_grown);
  void note_starts();
  void move_to_new_numbering();
  std::vector<int> owned_old_nodes() const;
  void assemble();
  void publish(const bonds::BondChange& change);
  void balance(Accuracy accuracy);
  void meet_measure(Accuracy accuracy);
  void follow_measure();
  void count(const solvers::Equilibrium::Outcome& outcome);
  std::vector<double> load_response();
  double power_of_supports() const;
  bool is_settled(const bonds::BondChange& change) const;
  double elastic_energy() const;
  std::optional<double> taken_up() const;
  std::string reason_for(const std::string& trouble) const;
};

}  // namespace perimorph::fracture
