#pragma once

#include "perimorph/operators/coupled_model.hpp"
#include "perimorph/operators/force_term.hpp"

namespace perimorph::operators {

/// A term that is linear in the displacement and in the eigenstrain together.
template <int dim>
class ElasticTerm : public LinearTerm<dim> {
 public:
  /// The model is read again later and must outlive this.
  explicit ElasticTerm(const CoupledModel<dim>& model);

  void add_force(base::ConstField u, base::Field force) const override;
  void add_load_derivative(base::Field force) const override;
  double energy(base::ConstField u) const override;

 protected:
  CoupledModel<dim> model_;

  /// force += F(u, eigenstrain). Collective as add_force() is.
  /// @param eigenstrain at the points, (n_points), [-]
  virtual void add_force_at(base::ConstField u, const std::vector<double>& eigenstrain, base::Field force) const = 0;
};

}  // namespace perimorph::operators
