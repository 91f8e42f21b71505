#pragma once

#include <unordered_map>
#include <vector>

#include "perimorph/operators/crack_normals.hpp"
#include "perimorph/operators/force_term.hpp"

namespace perimorph::operators {

/// Contact of crack faces, for small sliding: what a crack has taken from a bond still resists closing. With the
/// crack's unit normal n and g = (xi . n) n the two ends push each other apart by k (g . eta) g as long as g . eta < 0.
/// The spring k is what the bond has lost, times (lambda + 2 mu) / (3 mu): under a strain along n it then carries what
/// the whole body would. Its energy 1/2 Sum k min(0, g . eta)^2 has a continuous derivative, so that Newton's method
/// with the springs that are closed as tangent finds the solution.
///
/// Friction (Coulomb): along the faces the ends are held by k_t (eta_t - s), k_t = (xi . n)^2 of what the bond has
/// lost, and at most by the coefficient times the normal force. s is how far they have slid; a contact that opens
/// forgets it. That friction follows the normal force is left out of the tangent, which so stays symmetric
/// (DECISIONS.md, 42).
template <int dim>
class ContactForces : public ForceTerm<dim> {
 public:
  /// Of the bonds that are broken or softened now, and of those across faces, with the slips of the topology.
  /// Collective. Model and topology are read again later.
  /// @param friction coefficient, >= 0 [-]
  ContactForces(const CoupledModel<dim>& model, const discretization::Topology<dim>& topology, double friction);

  void add_force(base::ConstField u, base::Field force) const override;
  void prepare_tangent(base::ConstField u) override;
  void add_tangent_product(base::ConstField x, base::Field force) const override;
  void take(const bonds::BondChange& change) override;
  Teuchos::RCP<ForceTerm<dim>> within(const MeshPart& part) const override;
  void add_load_derivative(base::Field force) const override;
  void add_confinement(base::ConstField u, base::Field at_points) const override;
  double energy(base::ConstField u) const override;
  std::size_t bytes() const override { return contacts_.size() * sizeof(Contact); }

  void couple(const StiffnessMatrix<dim>& matrix, Couplings<dim>& couplings) const override;
  void add_to(StiffnessMatrix<dim>& matrix) const override;
  void update_tangent(StiffnessMatrix<dim>& matrix, std::vector<int>& changed) const override;

  /// By the last prepare_tangent(). Local.
  std::vector<StiffenedBond<dim>> stiffened() const;

  /// Those that are closed at a displacement. Local.
  std::vector<ContactSpring<dim>> closed(base::ConstField u) const;

  /// How far faces have slid at a displacement, for all contacts; an open one begins where it is. Local.
  bonds::Slips<dim> slips(base::ConstField u) const;

  /// The topology has accepted others. Local.
  void follow_slips();

 private:
  using Point = base::Point<dim>;
  using Block = Eigen::Matrix<double, dim, dim>;

  struct Contact {
    bonds::Bond<dim> bond;
    Point g;                           ///< (xi . n) n, [length]
    double along_normal, along_faces;  ///< k, [force / length^3], and k_t, [force / length]
    Point slip = Point::Zero();        ///< s, [length]
    Block in_tangent = Block::Zero();  ///< that of the tangent as it is prepared, [force / length]
  };
  /// What a contact does at a displacement.
  struct Response {
    Point normal = Point::Zero(), friction = Point::Zero();  ///< that it takes to hold the second end, [force]
    Point sliding = Point::Zero();                           ///< eta_t, [length]
    bool is_closed = false, slides = false;
  };
  class Within;
  /// How much stiffer the tangent has become in a contact.
  struct Stiffening {
    std::size_t contact;
    Block by;  ///< [force / length]
  };
  CoupledModel<dim> model_;
  const discretization::Topology<dim>& topology_;
  double friction_;
  CrackNormals<dim> normals_;
  std::vector<Contact> contacts_;
  std::unordered_map<bonds::BondId, std::size_t> place_of_;  ///< of bonds that soften
  std::vector<Stiffening> stiffened_;                        ///< by the last prepare_tangent()

  void add(const bonds::Bond<dim>& bond);
  void set_stiffness(Contact& contact) const;
  Point opening(const Contact& contact, base::ConstField x) const;
  Point relative_displacement(const Contact& contact, base::ConstField u) const;
  Response response(const Contact& contact, const Point& eta) const;
  Block tangent(const Contact& contact, const Response& response) const;
  void add_tangent_product(const Contact& contact, base::ConstField x, base::Field force) const;
  void hold(const Contact& contact, const Point& on_second, base::Field force) const;
  void add_to(StiffnessMatrix<dim>& matrix, const std::vector<Stiffening>& springs, std::vector<int>& changed) const;
};

}  // namespace perimorph::operators
