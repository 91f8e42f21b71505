#pragma once

#include <unordered_map>
#include <vector>

#include "perimorph/operators/crack_normals.hpp"
#include "perimorph/operators/force_term.hpp"

namespace perimorph::operators {

/// Contact of crack faces without friction, for small sliding: what a crack has taken from a bond still resists
/// closing. With the crack's unit normal n and g = (xi . n) n the two ends push each other apart by k (g . eta) g as
/// long as g . eta < 0. The spring k is what the bond has lost, times (lambda + 2 mu) / (3 mu): under a strain along n
/// it then carries what the whole body would (DECISIONS.md, 41). Faces slide freely. The energy 1/2 Sum k min(0, g .
/// eta)^2 has a continuous derivative, so that Newton's method with the springs that are closed as tangent finds the
/// solution.
template <int dim>
class ContactForces : public ForceTerm<dim> {
 public:
  /// Of the bonds that are broken or softened now, and of those across faces. Collective. Model and topology are read
  /// again later.
  ContactForces(const CoupledModel<dim>& model, const discretization::Topology<dim>& topology);

  void add_force(base::ConstField u, base::Field force) const override;
  void prepare_tangent(base::ConstField u) override;
  void add_tangent_product(base::ConstField x, base::Field force) const override;
  void take(const bonds::BondChange& change) override;
  double energy(base::ConstField u) const override;
  std::size_t bytes() const override { return contacts_.size() * sizeof(Contact); }

  void couple(const StiffnessMatrix<dim>& matrix, Couplings<dim>& couplings) const override;
  void add_to(StiffnessMatrix<dim>& matrix) const override;
  void update_tangent(StiffnessMatrix<dim>& matrix, std::vector<int>& changed) const override;

  /// The springs that are closed at a displacement. Local.
  std::vector<ContactSpring<dim>> closed(base::ConstField u) const;

 private:
  struct Contact {
    bonds::Bond<dim> bond;
    base::Point<dim> g;      ///< [length]
    double stiffness;        ///< k, [force / length^3]
    double in_tangent = 0.;  ///< the same, if the tangent has it
  };
  /// How much stiffer the tangent has become in a contact.
  struct Stiffening {
    std::size_t contact;
    double by;  ///< [force / length^3]
  };
  CoupledModel<dim> model_;
  CrackNormals<dim> normals_;
  std::vector<Contact> contacts_;
  std::unordered_map<bonds::BondId, std::size_t> place_of_;  ///< of bonds that soften
  std::vector<Stiffening> stiffened_;                        ///< by the last prepare_tangent()

  void add(const bonds::Bond<dim>& bond);
  double stiffness_of(const bonds::Bond<dim>& bond) const;
  double elongation(const Contact& contact, base::ConstField u) const;
  void push(const Contact& contact, double tension, base::Field force) const;
  void add_to(StiffnessMatrix<dim>& matrix, const std::vector<Stiffening>& springs, std::vector<int>& changed) const;
};

}  // namespace perimorph::operators
