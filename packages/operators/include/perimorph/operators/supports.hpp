#pragma once

#include <vector>

#include "perimorph/operators/coupled_model.hpp"

namespace perimorph::operators {

/// What every form of K has besides the model. Prescribed degrees of freedom are eliminated symmetrically: row and
/// column zero, a stiffness on the diagonal. The nodes of discontinuous elements are anchored by a vanishing spring, so
/// that K stays definite when pieces come to float; since K acts on corrections only, it carries no force.
template <int dim>
struct Supports {
  static constexpr double anchor = 1e-8;  ///< share of the stiffness E0 h^(dim - 2) that anchors have

  std::vector<char> fixed;       ///< per local degree of freedom: prescribed
  std::vector<double> diagonal;  ///< per owned degree of freedom: what is added to K's diagonal, [force / length]

  /// Local.
  Supports(const CoupledModel<dim>& model, const discretization::Dirichlet<dim>& dirichlet,
           const std::vector<char>& discontinuous);
};

}  // namespace perimorph::operators
