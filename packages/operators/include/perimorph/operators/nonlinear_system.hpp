#pragma once

#include <Teuchos_RCP.hpp>
#include <Tpetra_Map_fwd.hpp>
#include <Tpetra_Operator_fwd.hpp>
#include <Tpetra_Vector_fwd.hpp>
#include <memory>
#include <vector>

#include "perimorph/base/field.hpp"

namespace perimorph::operators {

/// Some of the unknowns, those of nodes around bonds that have broken, while all others are held fast. All functions
/// are collective.
class Window {
 public:
  using Vector = Tpetra::Vector<double>;
  using Operator = Tpetra::Operator<double>;

  virtual ~Window() = default;

  /// Owned nodes, ascending. Local.
  virtual const std::vector<int>& nodes() const = 0;
  /// Theirs, numbered on their own, in this order; the nodes of a rank are contiguous. Local.
  virtual const Teuchos::RCP<const Tpetra::Map<>>& unknowns() const = 0;

  /// The tangent on these unknowns, as it is prepared in the system.
  virtual Teuchos::RCP<Operator> tangent() const = 0;
  /// What the preconditioner's matrix of the system has as unknowns, in terms of these; null: the same.
  virtual Teuchos::RCP<const Operator> basis() const = 0;

  /// Forces on some owned degrees of freedom; there are none on others.
  struct Forces {
    std::vector<int> dofs;  ///< ascending
    std::vector<double> values;
  };
  /// K x of what is zero but on these unknowns. @param x on all unknowns of the system
  virtual Forces product(const Vector& x) const = 0;

  /// (K - K0) x of several fields, K0 being K when this was called last.
  /// @param fields (n), each on all unknowns of the system and as note_field() knows it
  /// @return (n)
  virtual std::vector<Forces> changes(const std::vector<Teuchos::RCP<const Vector>>& fields) = 0;
  /// Whether changes() knows of those before this window was there, too. Local.
  virtual bool knows_changes() const = 0;
  /// changes() will be asked of this field in this place among its fields.
  virtual void note_field(std::size_t place, const Vector& field) = 0;
};

/// The balance of forces as a solver sees it: R(u; load factor) = loads - internal forces = 0 on the unknowns. It keeps
/// the forces of the displacement that it was evaluated at last. Fields u are displacements on all local degrees of
/// freedom, [length]; vectors are on the unknowns of this rank. All functions are collective.
class NonlinearSystem {
 public:
  using Vector = Tpetra::Vector<double>;
  using Operator = Tpetra::Operator<double>;

  /// 2-norms over all ranks, [force].
  struct Norms {
    double residual;
    double reaction;  ///< of the forces of supports and loads together
  };

  virtual ~NonlinearSystem() = default;

  /// Computes the forces of a displacement.
  virtual void evaluate(base::ConstField u) = 0;

  /// R at the displacement of the last evaluation, zero where the displacement is prescribed, [force].
  virtual Norms residual(Vector& residual) const = 0;

  /// u += correction, [length], copied to all ranks and with what is prescribed at the load factor set exactly; then
  /// evaluates.
  virtual void correct(base::Field u, const Vector& correction) = 0;

  /// Makes the tangent -dR/du that of a displacement. Returns the owned nodes whose rows have changed in the
  /// preconditioner's matrix, some more than once.
  virtual std::vector<int> prepare_tangent(base::ConstField u) = 0;

  /// The tangent, as it is prepared.
  virtual Teuchos::RCP<Operator> tangent() const = 0;

  /// dR / d load factor on the unknowns at fixed u of the unknowns, with what is prescribed moving along, [force].
  virtual void load_derivative(Vector& derivative) const = 0;

  /// How fast the displacement changes with the load factor where the unknowns do so by x, [length].
  /// @param response on all local degrees of freedom, [length]
  virtual void expand_response(const Vector& x, base::Field response) const = 0;

  /// Multiplies the springs of the tangent that hold floating pieces; they carry no force.
  /// @param factor > 0 [-]
  virtual void scale_anchors(double factor) = 0;

  virtual const Teuchos::RCP<const Tpetra::Map<>>& unknowns() const = 0;

  /// A window around the bonds that have changed since the last call, the one of that call if it still serves; null
  /// where there is none, or it would be most of the body.
  virtual std::shared_ptr<Window> window() { return nullptr; }
};

}  // namespace perimorph::operators
