#pragma once

#include <Teuchos_RCP.hpp>
#include <vector>

#include "perimorph/base/errors.hpp"
#include "perimorph/base/field.hpp"
#include "perimorph/bonds/bond.hpp"
#include "perimorph/bonds/bond_change.hpp"

namespace perimorph::operators {

template <int dim>
class StiffnessMatrix;
template <int dim>
struct Couplings;

/// A part of the mesh: some of its local elements and their nodes, or all of them.
struct MeshPart {
  std::vector<char> elements, nodes;  ///< local ones: whether they belong to it; empty: all do
  bool is_whole() const { return elements.empty(); }
  bool holds_element(int e) const { return is_whole() || elements[e] != 0; }
  bool holds_node(int node) const { return is_whole() || nodes[node] != 0; }
};

/// By how much stiffer the tangent has become between the ends of a bond.
template <int dim>
struct StiffenedBond {
  bonds::Bond<dim> bond;
  Eigen::Matrix<double, dim, dim> by;  ///< [force / length]
};

/// A term of the balance of forces. It adds the forces that it takes to hold the nodes against it, as the internal
/// force K u does; what loads the body adds them with the other sign. Fields are on all local degrees of freedom, and
/// sums are right on owned ones; displacements are in [length], forces in [force], the load factor is a number [-].
/// Forces, products and energy are collective, all else is local.
template <int dim>
class ForceTerm {
 public:
  virtual ~ForceTerm() = default;

  /// What the load factor decides from now on.
  virtual void apply_load(double /*load_factor*/) {}

  /// force += F(u).
  virtual void add_force(base::ConstField u, base::Field force) const = 0;

  /// Makes the tangent dF/du that of a displacement. A linear term's is always the same.
  virtual void prepare_tangent(base::ConstField /*u*/) {}

  /// force += (dF/du) x, with the tangent as prepared and x a change of the displacement.
  virtual void add_tangent_product(base::ConstField x, base::Field force) const = 0;

  /// force += dF / d load factor.
  virtual void add_load_derivative(base::Field /*force*/) const {}

  /// The tangent of this with what touches a part of the mesh only, null without a tangent. It is told of bonds that
  /// break as this is, and this must outlive it. Collective.
  virtual Teuchos::RCP<ForceTerm> within(const MeshPart& /*part*/) const { return Teuchos::null; }

  /// Adds the couplings of unknowns that the tangent has in a matrix, beside those within one element.
  virtual void couple(const StiffnessMatrix<dim>& /*matrix*/, Couplings<dim>& /*couplings*/) const {}

  /// Adds the tangent to a matrix.
  virtual void add_to(StiffnessMatrix<dim>& matrix) const = 0;

  /// Takes bonds that broke out of the forces and the tangent.
  virtual void take(const bonds::BondChange& /*change*/) {}

  /// The same in a matrix that this has added itself to; adds the owned nodes whose rows have changed, some repeatedly.
  virtual void take(const bonds::BondChange& /*change*/, StiffnessMatrix<dim>& /*matrix*/,
                    std::vector<int>& /*changed*/) const {}

  /// What prepare_tangent() has changed since the last time, in a matrix that this has added itself to; adds the owned
  /// nodes as take() does. Local.
  virtual void update_tangent(StiffnessMatrix<dim>& /*matrix*/, std::vector<int>& /*changed*/) const {}

  /// at_points += dEnergy / d eigenstrain, what holds back the expansion of a point: -w tr stress, (n_points),
  /// [energy]; right at points of owned elements. Collective.
  virtual void add_confinement(base::ConstField /*u*/, base::Field /*at_points*/) const {}
  /// Energy stored at a displacement, on this rank's share of the body, [energy].
  virtual double energy(base::ConstField u) const = 0;

  virtual std::size_t bytes() const = 0;  ///< of memory
};

/// A term whose force is its tangent times the displacement.
template <int dim>
class LinearTerm : public ForceTerm<dim> {
 public:
  /// @param n_owned degrees of freedom
  explicit LinearTerm(std::size_t n_owned) : n_owned_(n_owned) {}

  void add_force(base::ConstField u, base::Field force) const override { this->add_tangent_product(u, force); }

  /// 1/2 u . F(u).
  double energy(base::ConstField u) const override {
    PERIMORPH_ASSERT(static_cast<std::size_t>(u.size()) >= n_owned_, "{} displacements, {} owned", u.size(), n_owned_);
    std::vector<double> force(u.size(), 0.);
    this->add_force(u, base::field(force));
    double energy = 0.;
    for (std::size_t dof = 0; dof < n_owned_; ++dof) energy += 0.5 * u[dof] * force[dof];
    return energy;
  }

 private:
  std::size_t n_owned_;
};

template <int dim>
using ForceTerms = std::vector<Teuchos::RCP<ForceTerm<dim>>>;

}  // namespace perimorph::operators
