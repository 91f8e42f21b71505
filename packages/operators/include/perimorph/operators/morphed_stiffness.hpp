#pragma once

#include <vector>

#include "perimorph/bonds/bond_families.hpp"

namespace perimorph::operators {

/// What becomes of E(x) in the peridynamic zone: dropped as in WHL19, or kept where bonds are missing (a correction of
/// the surface effect).
enum class PeridynamicStiffness { dropped, kept };

/// E(x) = E0 - 1/2 Sum_p c0 (alpha(x) + alpha(p))/2 xi (x) xi (x) xi (x) xi w_p   [WHL19, eq. 16], at material points,
/// with the discrete sum over all visible bonds as they are before any breaks. E0 where there are no bonds. On
/// irregular meshes the sum exceeds E0 at single points; in discontinuous elements, which nothing else holds together,
/// E(x) is clipped to positive semi-definite there.
template <int dim>
class MorphedStiffness {
 public:
  MorphedStiffness(const base::Stiffness<dim>& e0, PeridynamicStiffness policy) : e0_(e0), policy_(policy) {}

  /// Recomputes all; needed after alpha or the bonds have grown, or elements were split. Right for active elements.
  /// Local.
  void update(const mesh::Mesh<dim>& mesh, const elements::MaterialPoints<dim>& points,
              const bonds::BondFamilies<dim>& bonds, const morphing::MorphingField<dim>& alpha,
              const std::vector<morphing::ElementClass>& classes, const std::vector<char>& discontinuous);

  /// E at a point, [stress].
  const base::Stiffness<dim>& at(int element, int q) const {
    return first_[element] < 0 ? e0_ : reduced_[first_[element] + q];
  }
  const base::Stiffness<dim>& e0() const { return e0_; }
  /// Whether E = E0 in the whole element.
  bool is_e0(int element) const { return first_[element] < 0; }
  /// Whether E = 0 in the whole element.
  bool is_zero(int element) const { return is_zero_[element]; }

 private:
  base::Stiffness<dim> e0_;
  PeridynamicStiffness policy_;
  std::vector<int> first_;  ///< position of an element's first point in reduced_; -1 for E0
  std::vector<base::Stiffness<dim>> reduced_;
  std::vector<char> is_zero_;
};

}  // namespace perimorph::operators
