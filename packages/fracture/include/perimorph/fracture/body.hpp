#pragma once

#include <Tpetra_Vector_fwd.hpp>
#include <array>
#include <map>
#include <memory>

#include "perimorph/base/profile.hpp"
#include "perimorph/fracture/problem.hpp"
#include "perimorph/operators/coupled_stiffness.hpp"
#include "perimorph/operators/crack_faces.hpp"
#include "perimorph/operators/matrix_free_stiffness.hpp"
#include "perimorph/solvers/linear_solver.hpp"

namespace perimorph::fracture {

/// How a body is discretized, and how well its equations are solved.
struct BodyOptions {
  morphing::BlendingFunction blending_function;
  DiscontinuousElements discontinuous;
  operators::PeridynamicStiffness peridynamic_stiffness;
  double growth_inner_radius, growth_outer_radius;  ///< r_i, r_o, [length]
  double tolerance;                                 ///< residual over reaction forces in accepted solutions
  double damage_tolerance;                          ///< the same while bonds break
  double breaking_fraction = 1.;                    ///< share of the overstretched bonds that break between two solves
  OperatorForm operator_form = OperatorForm::matrix_free;
  PreconditionerMatrix preconditioner_matrix = PreconditionerMatrix::coupled;
  double short_range_cut_off = 0.;  ///< [length]
  solvers::SolverParameters solver;
  int points_per_direction = 2;  ///< material points of an element
};
BodyOptions body_options(const Case& input);

/// How well to solve: between breaks, or well enough to say that nothing breaks.
enum class Accuracy { breaking, accepted };

/// What has happened to a body, over all ranks.
struct Counts {
  base::GlobalId broken_bonds = 0, damaged_elements = 0, dgfe_elements = 0, unknowns = 0;
  base::GlobalId linear_solves = 0, cg_iterations = 0;  ///< since the load was last changed
  base::GlobalId topologies = 0;                        ///< built since the beginning
};

/// Energies of a body, [energy]. What the loads' work exceeds elastic + dissipated energy was lost in brittle jumps.
struct Energies {
  double elastic = 0., dissipated = 0., external_work = 0.;
};

/// A broken bond by the global ids of its points, and the call of break_bonds() in which it broke, from 1.
struct BrokenBond {
  base::GlobalId first, second, call;
};

/// Around it the zone has grown, since a bond of the element broke. Growths are counted from 1.
template <int dim>
struct FlagPoint {
  base::GlobalId element, growth;
  std::array<double, dim> centroid;  ///< [length]
};

/// One rank's share of all that makes a body what it has become, taken between increments. From the shares of any
/// number of ranks, any other number of ranks can go on. Zones, alpha, the bonds there are, classes and discontinuous
/// elements follow from mesh, problem, flag points and broken bonds.
template <int dim>
struct BodyState {
  static constexpr int values_per_element = dim << dim;  ///< as many corners as an element can have, dim values each

  double load_factor = 0., force_scale = 0.;
  Energies energies;
  Counts counts;
  base::GlobalId break_calls = 0, break_calls_before_topology = 0;  ///< of break_bonds(), also before the last topology
  std::vector<FlagPoint<dim>> flag_points;                          ///< of all ranks, as they came
  std::vector<BrokenBond> broken;    ///< bonds of which this rank owns the first element, as they broke
  std::vector<double> displacement;  ///< of owned elements, (n_owned_elements, values_per_element), [length]
};

/// The deforming, breaking body: its peridynamic zone, bonds, topology and displacement. The adaptive loop (WHL19,
/// Fig. 5) calls its verbs in turn. All verbs are collective.
template <int dim>
class Body {
 public:
  /// The mesh and the problem must outlive this.
  Body(const Teuchos::RCP<const base::Comm>& comm, const mesh::Mesh<dim>& mesh, const Problem<dim>& problem,
       BodyOptions options, base::Profile& profile);
  ~Body();

  /// Sets the load; the displacement is scaled along when the loads are proportional.
  void apply_load(double load_factor);

  /// Lets alpha, bonds, classes and DGFE follow the flag points and the damage, and renumbers; only if they changed.
  /// @throws UserError at the first call, if a pre-crack cuts through elements outside the peridynamic zone.
  void update_topology();

  /// Solves R(u; bonds, load) = 0 for the displacement; costs nothing if it is accurate enough already.
  /// @throws ComputationError if the solver fails.
  void solve(Accuracy accuracy);

  /// Breaks bonds whose stretch reached the critical one, or the worst of them (BodyOptions::breaking_fraction);
  /// returns how many.
  base::GlobalId break_bonds();

  /// Makes the centroids of newly damaged elements flag points, around which alpha will grow; returns how many.
  base::GlobalId flag_damaged_elements();

  /// What this rank has to remember. Local.
  BodyState<dim> state() const;

  /// The state of a new body becomes this one, to the last bit if the number of ranks is the same. Collective.
  /// @param state the displacement of all local elements, and all broken bonds of the body
  /// @throws UserError if bonds of the state do not exist in this body.
  void restore(const BodyState<dim>& state);

  /// What comes depends on the state only, and not on what the solver has done before. Local.
  void forget_solves() { solver_.forget(); }

  const Counts& counts() const { return counts_; }
  Energies energies() const;
  double load_factor() const { return load_factor_; }

  /// Where crack faces have passed furthest through each other, since there is no contact.
  operators::Overlap<dim> overlap() const;

  // For results; local.
  operators::CoupledModel<dim> model() const;
  const mesh::Mesh<dim>& mesh() const { return mesh_; }
  const std::vector<morphing::ElementClass>& classes() const { return classes_; }
  bool is_discontinuous(int element) const { return discontinuous_[element]; }
  std::size_t bytes_of_operator() const;  ///< of memory, in the form that conjugate gradients apply
  const double* displacement() const;     ///< all local degrees of freedom
  const std::vector<base::Point<dim>>& displacement_at_points() const { return at_points_; }
  /// Force that supports exert on an owned node, [force].
  base::Point<dim> reaction(int node) const;

 private:
  Teuchos::RCP<const base::Comm> comm_;
  const mesh::Mesh<dim>& mesh_;
  const Problem<dim>& problem_;
  BodyOptions options_;
  base::Profile& profile_;

  elements::MaterialPoints<dim> points_;
  morphing::MorphingField<dim> alpha_;
  bonds::BondFamilies<dim> bonds_;
  operators::MorphedStiffness<dim> elasticity_;
  discretization::Dirichlet<dim> dirichlet_;
  discretization::HaloExchange element_exchange_, corner_exchange_;
  solvers::LinearSolver solver_;

  std::vector<morphing::Zone<dim>> pending_zones_;
  std::vector<FlagPoint<dim>> flag_points_;  ///< of all ranks
  std::vector<char> cut_by_pre_crack_;       ///< per local element
  std::vector<morphing::ElementClass> classes_;
  std::vector<char> discontinuous_, flagged_;
  std::unique_ptr<discretization::DofMap<dim>> dofs_;
  std::unique_ptr<discretization::DofMap<dim>> old_dofs_;  ///< of the topology before, until this one is assembled
  std::vector<operators::FacingSides> facing_sides_;       ///< that may be crack faces, in this topology
  Teuchos::RCP<operators::MatrixFreeStiffness<dim>> stiffness_;
  // The same as a matrix, and the short-range matrix; null if neither operator nor preconditioner needs them.
  std::unique_ptr<operators::CoupledStiffness<dim>> matrix_, short_range_;
  Teuchos::RCP<const operators::PointBasis<dim>> basis_;  ///< of the short-range matrix

  using Vector = Tpetra::Vector<double>;
  Teuchos::RCP<Vector> owned_u_, all_u_, residual_, correction_;
  std::vector<base::Point<dim>> at_points_;
  std::vector<double> force_;  ///< internal, owned degrees of freedom
  std::vector<double> loads_;  ///< external, owned degrees of freedom

  std::vector<double> last_u_, last_force_;  ///< owned, at the last solution; zero force after the topology changed

  double load_factor_ = 0.;
  double force_scale_ = 0.;  ///< below which reactions say nothing of the load
  bool load_is_new_ = false;
  bool forces_are_current_ = false;  ///< at_points_ and force_ belong to the displacement, bonds and topology
  Counts counts_;
  double dissipated_ = 0., external_work_ = 0.;

  using BrokenByCall =
      std::map<base::GlobalId, std::vector<std::size_t>>;  ///< bonds, ascending, by call of break_bonds()
  BrokenByCall broken_by_call_;                            ///< all that this rank holds
  base::GlobalId break_calls_ = 0, break_calls_before_topology_ = 0;

  void grow();
  void add_zone(const FlagPoint<dim>& flag);
  void grow_again(const BodyState<dim>& state);
  BrokenByCall find_broken(const BodyState<dim>& state) const;
  void move_to(const std::vector<double>& displacement);
  double breaking_stretch() const;
  void take_out(const std::vector<std::size_t>& broken);
  void classify();
  bool find_discontinuous();
  void check_pre_cracks() const;
  void renumber();
  void assemble();
  void prescribe_displacements();
  void update_forces();
  bool is_prescribed(int node, int component) const {
    return dirichlet_.prescribes(dofs_->reference_node(node), component);
  }
  struct Balance {
    double residual, reaction;  ///< 2-norms
  };
  Balance balance();
  void record_work();
};

}  // namespace perimorph::fracture
