#pragma once

#include <vector>

#include "perimorph/operators/elastic_term.hpp"

namespace perimorph::operators {

/// K_local u, the single sum in K [WHL19, eq. 22], without a matrix: the forces of E(x), element by element. What it
/// stores per element is the gradients of the shape functions, sqrt(w) dN/dx, which is less than an element matrix;
/// four elements are computed at once. An eigenstrain takes off B^T E(x) I times it.
template <int dim>
class LocalForces : public ElasticTerm<dim> {
 public:
  /// Of the active elements with E != 0. The model is read again by add_to() and must outlive this. Local.
  /// @param part elements that it is of
  explicit LocalForces(const CoupledModel<dim>& model, const MeshPart& part = {});

  void add_tangent_product(base::ConstField x, base::Field force) const override;
  void add_confinement(base::ConstField u, base::Field at_points) const override;
  Teuchos::RCP<ForceTerm<dim>> within(const MeshPart& part) const override {
    return Teuchos::rcp(new LocalForces(model_, part));
  }
  void add_to(StiffnessMatrix<dim>& matrix) const override;
  std::size_t bytes() const override;

 private:
  /// Elements of one kind: of one E0 everywhere, or each point with an E of its own. Four elements follow each other
  /// lane by lane; an incomplete four is filled up with elements of no stiffness.
  struct Group {
    int n_corners, n_points;
    const base::Stiffness<dim>* e0;  ///< null: each point has its own
    std::vector<int> nodes;          ///< per four elements: (n_corners, 4)
    std::vector<double> gradients;   ///< per four elements: (n_points, n_corners, dim, 4), [length^(dim/2 - 1)]
    std::vector<double> stiffness;   ///< per four elements: (n_points, n_voigt (n_voigt + 1) / 2, 4), [stress]
  };
  using ElasticTerm<dim>::model_;
  std::vector<Group> groups_;

  void add_force_at(base::ConstField u, const std::vector<double>& eigenstrain, base::Field force) const override;

  Group& group(int n_corners, int n_points, const base::Stiffness<dim>* e0);
  template <int n>
  void add(const Group& group, const double* u, double* force) const;
};

}  // namespace perimorph::operators
