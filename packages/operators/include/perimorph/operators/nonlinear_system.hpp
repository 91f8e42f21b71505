#pragma once

#include <Teuchos_RCP.hpp>
#include <Tpetra_Map_fwd.hpp>
#include <Tpetra_Operator_fwd.hpp>
#include <Tpetra_Vector_fwd.hpp>
#include <vector>

#include "perimorph/base/field.hpp"

namespace perimorph::operators {

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
};

}  // namespace perimorph::operators
