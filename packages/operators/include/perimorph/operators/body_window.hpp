#pragma once

#include <Tpetra_Import_fwd.hpp>
#include <memory>
#include <vector>

#include "perimorph/discretization/topology.hpp"
#include "perimorph/operators/force_term.hpp"
#include "perimorph/operators/nonlinear_system.hpp"
#include "perimorph/operators/point_basis.hpp"

namespace perimorph::operators {

/// What windows are made of. A view: owns nothing.
template <int dim>
struct WindowSource {
  const CoupledModel<dim>& model;
  const discretization::Space<dim>& space;
  const discretization::HaloExchange& element_exchange;
  const ForceTerms<dim>& terms;
  const std::vector<double>& constraints;  ///< stiffness on the diagonal, per owned degree of freedom
  const PointBasis<dim>* basis;            ///< of the preconditioner's matrix; null: nodal displacements
};

/// Bonds whose stiffness has changed since a window was last asked for changes.
template <int dim>
struct ChangedBonds {
  std::vector<StiffenedBond<dim>> bonds;
  bool are_all = true;  ///< none is missing
};

/// A window on the nodes of some elements: the terms of the body there, and nothing of the rest is touched.
template <int dim>
class BodyWindow : public Window {
 public:
  /// Collective. What the source names must outlive this.
  /// @param elements per local element: whether it is in the window; the same on all ranks that have it
  /// @param changed bonds, of which another adds to the list; it must outlive this
  BodyWindow(const WindowSource<dim>& source, const std::vector<char>& elements, ChangedBonds<dim>& changed);
  ~BodyWindow() override;

  const std::vector<int>& nodes() const override { return nodes_; }
  const Teuchos::RCP<const Tpetra::Map<>>& unknowns() const override { return unknowns_; }
  Teuchos::RCP<Operator> tangent() const override;
  Teuchos::RCP<const Operator> basis() const override { return basis_; }
  Forces product(const Vector& x) const override;
  std::vector<Forces> changes(const std::vector<Teuchos::RCP<const Vector>>& fields) override;
  bool knows_changes() const override { return changes_are_springs() && changed_.are_all; }
  void note_field(std::size_t place, const Vector& field) override;

  /// Bonds have broken, or softened. Local.
  void take(const bonds::BondChange& change) {
    for (const auto& term : terms_) term->take(change);
  }

 private:
  class Tangent;
  CoupledModel<dim> model_;
  const discretization::Space<dim>& space_;
  std::vector<int> nodes_;
  Teuchos::RCP<const Tpetra::Map<>> unknowns_;
  ForceTerms<dim> terms_;
  Teuchos::RCP<const PointBasis<dim>> basis_;
  ChangedBonds<dim>& changed_;
  std::vector<std::vector<double>> products_;    ///< of the fields, on reached_, where springs are not all that changes
  std::vector<int> reached_;                     ///< owned degrees of freedom
  std::vector<int> touched_;                     ///< local degrees of freedom of all elements that take part
  Teuchos::RCP<const Tpetra::Import<>> import_;  ///< of those of them that are no images
  Teuchos::RCP<Vector> around_;
  mutable std::vector<double> x_, forces_;    ///< on all local degrees of freedom, zero where not touched
  std::vector<std::pair<int, double>> held_;  ///< of its unknowns: place, and stiffness on the diagonal
  Teuchos::RCP<Vector> on_all_;               ///< for the tangent: zero but on its own unknowns

  MeshPart part_around(const WindowSource<dim>& source) const;
  void find_touched(const WindowSource<dim>& source, const MeshPart& part);
  void bring(const Vector& x) const;
  void add_products_of(const Vector& x) const;
  std::vector<double> product_in_reach(const Vector& x) const;
  bool changes_are_springs() const { return !model_.has_dilatation(); }
  std::vector<int> dofs_of_changed() const;
};

/// How large windows are.
struct WindowOptions {
  double radius = 0.;           ///< around bonds that have broken, [length]; 0: there never is a window
  double largest_share = 0.05;  ///< of the body's nodes; beyond, solving for the whole body costs little more [-]
};

/// The window of a body, which follows its breaking bonds.
template <int dim>
class WindowOfBody {
 public:
  explicit WindowOfBody(const WindowOptions& options) : options_(options) {}

  /// Bonds have broken, or softened. Local.
  void take(const bonds::BondChange& change, const CoupledModel<dim>& model);
  /// The tangent has become stiffer between ends of bonds, where they have not broken or softened. Local.
  void take(const std::vector<StiffenedBond<dim>>& stiffened);

  /// Somewhere bonds are likely to break next: there is a window before they do. Local.
  /// @param x alike on all ranks, [length]
  void expect_breaks(const base::Point<dim>& x) { expected_.push_back(x); }

  /// NonlinearSystem::window(). Collective.
  std::shared_ptr<Window> find(const WindowSource<dim>& source);

  /// Of another topology there is none yet. Local.
  void clear();

 private:
  WindowOptions options_;
  std::vector<base::Point<dim>> changed_;   ///< centroids of this rank's elements with changes since the last find()
  std::vector<base::Point<dim>> expected_;  ///< where breaks have been expected since
  std::vector<base::Point<dim>> centers_;   ///< what the window is around, on all ranks
  bool is_too_large_ = false;               ///< in this topology
  ChangedBonds<dim> changed_bonds_;         ///< while there is a window
  std::shared_ptr<BodyWindow<dim>> window_;

  void note(const StiffenedBond<dim>& changed);
  std::vector<base::Point<dim>> take_changed(const base::Comm& comm);
};

}  // namespace perimorph::operators
