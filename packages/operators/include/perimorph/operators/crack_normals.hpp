#pragma once

#include <array>
#include <vector>

#include "perimorph/discretization/topology.hpp"
#include "perimorph/operators/coupled_model.hpp"

namespace perimorph::operators {

/// Directions across cracks, from the bonds that these have cut. Around each element it is the principal direction of
/// Sum D w_x w_p xi (x) xi over the bonds of elements within a horizon, D being the share of a bond's stiffness that is
/// lost: mostly of the longest bonds, so that a crack that follows the sides of elements in steps has the normal of its
/// course (DECISIONS.md, 42). Of all ranks' bonds: the same bits on every rank.
template <int dim>
class CrackNormals {
 public:
  /// Of the present bonds. Collective.
  CrackNormals(const CoupledModel<dim>& model, const discretization::Topology<dim>& topology);

  /// The unit normal of the crack that a bond crosses, from both its elements; along the bond where these do not know
  /// of a crack; (dim), of either sign. Local.
  base::Point<dim> across(const bonds::Bond<dim>& bond) const;

 private:
  using Moments = std::array<double, dim * dim>;  ///< the sum, [length^(2 dim + 2)]
  std::vector<Moments> around_;                   ///< per local element; zero away from cracks
};

}  // namespace perimorph::operators
