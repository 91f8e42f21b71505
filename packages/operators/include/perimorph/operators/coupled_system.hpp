#pragma once

#include <optional>

#include "perimorph/base/profile.hpp"
#include "perimorph/discretization/topology.hpp"
#include "perimorph/operators/body_window.hpp"
#include "perimorph/operators/bond_forces.hpp"
#include "perimorph/operators/contact_forces.hpp"
#include "perimorph/operators/load_forces.hpp"
#include "perimorph/operators/matrix_free_tangent.hpp"
#include "perimorph/operators/nonlinear_system.hpp"
#include "perimorph/operators/stiffness_matrix.hpp"
#include "perimorph/operators/supports.hpp"

namespace perimorph::operators {

/// In which form conjugate gradients apply the tangent: a matrix; without one, with the stiffness of bonds stored or
/// computed at each application.
enum class OperatorForm { crs, matrix_free, on_the_fly };

/// What multigrid is made from: the tangent itself, or with the bonds of short range only.
enum class PreconditionerMatrix { coupled, short_range };

struct SystemOptions {
  OperatorForm operator_form = OperatorForm::matrix_free;
  PreconditionerMatrix preconditioner_matrix = PreconditionerMatrix::coupled;
  double short_range_cut_off = 0.;  ///< [length]
  double friction = 0.;             ///< coefficient, of crack faces in contact [-]
  WindowOptions window = {};
};

/// What decides which stress a strain makes.
template <int dim>
struct ElasticResponse {
  MorphedStiffness<dim> elasticity;                   ///< of the materials, without bonds yet
  discretization::Eigenstrain<dim> eigenstrain = {};  ///< at the topology's points
};

/// The balance of the coupled model as a list of terms on a space: local elements, bonds, anchors; against them the
/// loads. Another term joins in make_terms().
template <int dim>
class CoupledSystem : public NonlinearSystem {
 public:
  /// The arguments must outlive this. It has no terms before the first assemble().
  CoupledSystem(const base::Comm& comm, const discretization::Topology<dim>& topology,
                const discretization::Dirichlet<dim>& dirichlet, const discretization::Loads<dim>& loads,
                ElasticResponse<dim> response, SystemOptions options, base::Profile& profile);

  /// E(x) follows alpha, bonds and classes of the topology. Collective.
  void follow_morphing();

  /// What a preconditioner is made from.
  struct PreconditionerSource {
    Teuchos::RCP<Tpetra::CrsMatrix<double>> matrix;
    Teuchos::RCP<const PointBasis<dim>> basis;  ///< of the matrix's unknowns; null: nodal displacements
    std::vector<base::Point<dim>> coordinates;  ///< of the matrix's nodes, [length]
    std::optional<base::NodeWeights> from_old;  ///< its nodes from those of the one before, if there was one
  };

  /// Makes terms and matrices of the present topology. Collective.
  PreconditionerSource assemble(std::vector<double> starts = {});

  /// The tangent with all bonds that hold now, in the basis of the preconditioner's matrix. It does not follow later
  /// changes. Collective.
  Teuchos::RCP<Tpetra::CrsMatrix<double>> whole_matrix() const;

  /// From now on this load factor holds, [-]. Collective.
  void apply_load(double load_factor);

  /// Whether bonds that break change other forces than their own: with dilatation and contact. Local.
  bool breaks_change_more() const { return elasticity_.has_dilatation() || !contact_.is_null(); }

  /// Bonds have broken: terms and matrices take them out, and so do the forces, if there are any; if more changes
  /// (breaks_change_more), they are forgotten. Returns the owned nodes whose rows have changed in
  /// the preconditioner's matrix, some more than once. Local.
  std::vector<int> take(const bonds::BondChange& change);

  /// What bonds would take from the forces, as the residual that it leaves; nothing is changed. Collective.
  Norms imbalance_after(const bonds::BondChange& change) const;

  void evaluate(base::ConstField u) override;
  Norms residual(Vector& residual) const override;
  void correct(base::Field u, const Vector& correction) override;
  std::vector<int> prepare_tangent(base::ConstField u) override;
  Teuchos::RCP<Operator> tangent() const override;
  void load_derivative(Vector& derivative) const override;
  void expand_response(const Vector& x, base::Field response) const override;
  void scale_anchors(double factor) override { anchors_->scale(factor); }
  const Teuchos::RCP<const Tpetra::Map<>>& unknowns() const override { return space_->dofs().owned_dofs(); }
  std::shared_ptr<Window> window() override;
  /// WindowOfBody's.
  void expect_breaks(const base::Point<dim>& x) { window_.expect_breaks(x); }
  void forget_window() { window_.clear(); }

  // All local.
  CoupledModel<dim> model() const;
  const discretization::Space<dim>& space() const { return *space_; }
  bool has_forces() const { return has_forces_; }  ///< of the present load and topology
  void forget_forces() { has_forces_ = false; }
  /// On owned degrees of freedom, [force].
  const std::vector<double>& internal_force() const { return internal_; }

  /// The forces that the loads exert, on owned degrees of freedom, [force].
  const std::vector<double>& loads() const { return loads_; }

  /// How far crack faces have slid at a displacement; to be accepted by the topology, and then followed.
  bonds::Slips<dim> slips(base::ConstField u) const;
  void follow_slips();
  /// Stored, on this rank, [energy]; collective with an eigenstrain.
  double elastic_energy(base::ConstField u) const;
  const discretization::Eigenstrain<dim>& eigenstrain() const { return eigenstrain_; }
  /// What holds back the expansion of this rank's points (ForceTerm::add_confinement), (n_owned_points), [energy];
  /// empty without an eigenstrain. Collective.
  std::vector<double> confinement(base::ConstField u) const;
  /// What outer forces do work on: a displacement on owned degrees of freedom and, after it, an eigenstrain at this
  /// rank's points. @param u on these degrees of freedom or on all local ones; @param eigenstrain at all local points
  std::vector<double> moved(base::ConstField u, const std::vector<double>& eigenstrain) const;
  std::vector<double> moved(base::ConstField u) const { return moved(u, eigenstrain_.at_points()); }
  /// The forces of supports and loads together, and what expands the points, in that order. Collective.
  std::vector<double> exerted(base::ConstField u) const;

  const PointFields<dim>& at_points() const { return at_points_; }  ///< at the last evaluation
  /// Of that displacement by the bonds that are left (dilatation_at_points); empty if no law of bonds sees compression.
  /// Collective.
  std::vector<double> dilatation() const;
  const ForceTerms<dim>& terms() const { return terms_; }  ///< of the internal force
  std::size_t bytes_of_operator() const;                   ///< of memory, in the form that conjugate gradients apply

 private:
  const base::Comm& comm_;
  const discretization::Topology<dim>& topology_;
  const discretization::Dirichlet<dim>& dirichlet_;
  const discretization::Loads<dim>& load_data_;
  SystemOptions options_;
  base::Profile& profile_;

  MorphedStiffness<dim> elasticity_;
  discretization::Eigenstrain<dim> eigenstrain_;
  std::unique_ptr<discretization::Space<dim>> space_;
  ForceTerms<dim> terms_, load_terms_;
  Teuchos::RCP<BondForces<dim>> bond_forces_;  ///< also among the terms
  Teuchos::RCP<Anchors<dim>> anchors_;         ///< the same
  Teuchos::RCP<ContactForces<dim>> contact_;   ///< the same; null: crack faces are free
  Teuchos::RCP<MatrixFreeTangent<dim>> tangent_;
  // As a matrix, and the short-range matrix; null if neither operator nor preconditioner needs them.
  std::unique_ptr<StiffnessMatrix<dim>> matrix_, short_range_;
  Teuchos::RCP<const PointBasis<dim>> basis_;  ///< of the short-range matrix
  std::vector<double> constraints_;            ///< Supports::constraints
  WindowOfBody<dim> window_;

  PointFields<dim> at_points_;
  std::vector<double> internal_, loads_;
  bool has_forces_ = false;
  double load_factor_ = 0.;
  std::vector<double> held_expansion_;  ///< forces that hold the body still against the eigenstrain; or empty

  void make_terms(const Supports<dim>& supports);
  void make_matrices(const Supports<dim>& supports);
  std::vector<double> sum_of_forces(const ForceTerms<dim>& terms, base::ConstField u) const;
};

}  // namespace perimorph::operators
