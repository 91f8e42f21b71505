#pragma once

#include <vector>

#include "perimorph/discretization/space.hpp"
#include "perimorph/operators/coupled_model.hpp"
#include "perimorph/operators/force_term.hpp"

namespace perimorph::operators {

/// Stiffness on the diagonal of every form of K, per owned degree of freedom, [force / length]. The row and column of
/// one that is constrained are zero but for it. The nodes of discontinuous elements are anchored by a vanishing spring,
/// so that K stays definite when pieces come to float.
template <int dim>
struct Supports {
  static constexpr double anchor = 1e-8;  ///< share of the stiffness E0 h^(dim - 2) that anchors have

  std::vector<double> constraints;  ///< of those that are constrained
  std::vector<double> anchors;      ///< of nodes that may move, in discontinuous elements

  /// Local.
  /// @param discontinuous per local element, right in the halo too
  Supports(const CoupledModel<dim>& model, const discretization::Space<dim>& space,
           const std::vector<char>& discontinuous);
};

/// The anchors as a term. Since K acts on corrections only, they carry no force (DECISIONS.md, 2).
template <int dim>
class Anchors : public ForceTerm<dim> {
 public:
  /// @param stiffness per owned degree of freedom, most of it zero, [force / length]
  explicit Anchors(const std::vector<double>& stiffness);

  void add_force(base::ConstField /*u*/, base::Field /*force*/) const override {}
  void add_tangent_product(base::ConstField x, base::Field force) const override;
  void add_to(StiffnessMatrix<dim>& matrix) const override;
  Teuchos::RCP<ForceTerm<dim>> within(const MeshPart& part) const override;
  double energy(base::ConstField /*u*/) const override { return 0.; }
  std::size_t bytes() const override { return springs_.size() * sizeof(Spring); }

  /// Loosens or tightens them; a matrix keeps those that it has.
  /// @param factor on their stiffness, > 0 [-]
  void scale(double factor);

 private:
  struct Spring {
    int dof;
    double stiffness;
  };
  std::vector<Spring> springs_;
};

}  // namespace perimorph::operators
