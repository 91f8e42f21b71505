#pragma once

#include <Eigen/Core>
#include <Tpetra_Vector.hpp>
#include <vector>

#include "perimorph/base/parallel.hpp"
#include "perimorph/operators/nonlinear_system.hpp"
#include "perimorph/solvers/multigrid.hpp"

namespace perimorph::solvers {

/// Displacements u_j of a whole body, a dozen, with K u_j: as many unknowns for what is far from where things happen.
/// The youngest take the place of the oldest; each is scaled to unit energy. Columns are on the unknowns of this rank.
class FarFields {
 public:
  using Dense = Eigen::MatrixXd;
  using Vector = operators::NonlinearSystem::Vector;

  /// None yet, of this operator. Collective.
  FarFields(const base::Comm& comm, const Teuchos::RCP<Operator>& linear_operator);

  /// The fields as they are on the unknowns of another operator; their products with it are not known yet. Collective.
  /// @param old_nodes of owned nodes, those that they have parted from
  FarFields moved_to(const Teuchos::RCP<Operator>& linear_operator, const std::vector<int>& old_nodes, int dim) const;

  int size() const { return size_; }
  Teuchos::RCP<Vector> field(int j) const { return fields_->getVectorNonConst(j); }
  Teuchos::RCP<Vector> product(int j) const { return products_->getVectorNonConst(j); }
  std::vector<Teuchos::RCP<const Vector>> all() const;

  /// u and K u of all, (n_unknowns, size).
  Eigen::Map<Dense> u() const { return columns(*fields_); }
  Eigen::Map<Dense> ku() const { return columns(*products_); }

  /// Adds a field; K times it is not known yet. Returns its place.
  int add(const Vector& field);
  /// K u of one, or of all. Collective.
  void multiply(int j) const;
  void multiply() const;
  /// To unit energy. Collective.
  void scale(int j) const;

  /// C = U^T K U, (size, size), after its products or fields have changed. Collective.
  void renew_energies();
  /// The same where the products have changed on some degrees of freedom only. Collective.
  void take(const std::vector<operators::Window::Forces>& changes);
  /// C^-1, on what is independent.
  const Dense& inverse() const { return inverse_; }

  /// Sums over all ranks. Collective.
  Dense sum(const Dense& local) const;

 private:
  const base::Comm* comm_;
  Teuchos::RCP<Operator> operator_;
  Teuchos::RCP<MultiVector> fields_, products_;
  int size_ = 0, next_ = 0;
  Dense energies_, inverse_;

  Eigen::Map<Dense> columns(MultiVector& vectors) const;
  void invert();
};

}  // namespace perimorph::solvers
