#pragma once

#include "perimorph/operators/coupled_model.hpp"
#include "perimorph/operators/force_term.hpp"

namespace perimorph::operators {

/// Tractions and body forces as a term, the last two integrals of [WHL19, eq. 19]: dead loads, which do not follow the
/// displacement and have no tangent.
template <int dim>
class LoadForces : public ForceTerm<dim> {
 public:
  /// The arguments must outlive this.
  LoadForces(const CoupledModel<dim>& model, const discretization::Loads<dim>& loads) : model_(model), loads_(loads) {}

  void apply_load(double load_factor) override;
  void add_force(base::ConstField u, base::Field force) const override;
  void add_load_derivative(base::Field force) const override;
  void add_tangent_product(base::ConstField /*x*/, base::Field /*force*/) const override {}
  void add_to(StiffnessMatrix<dim>& /*matrix*/) const override {}
  double energy(base::ConstField u) const override;
  std::size_t bytes() const override { return forces_.size() * sizeof(double); }

 private:
  CoupledModel<dim> model_;
  const discretization::Loads<dim>& loads_;
  std::vector<double> forces_;  ///< of the loads, on owned degrees of freedom
};

}  // namespace perimorph::operators
