#pragma once

#include <vector>

#include "perimorph/base/errors.hpp"
#include "perimorph/bonds/bond_families.hpp"

namespace perimorph::operators {

/// What becomes of E(x) in the peridynamic zone: dropped as in WHL19, or kept where bonds are missing (a correction of
/// the surface effect).
enum class PeridynamicStiffness { dropped, kept };

/// E(x) = E0 - 1/2 Sum_p c0 (alpha(x) + alpha(p))/2 xi (x) xi (x) xi (x) xi w_p   [WHL19, eq. 16], at material points,
/// with the discrete sum over all visible bonds as they are before any breaks. E0 where there are no bonds. On
/// irregular meshes the sum exceeds E0 at single points; in discontinuous elements, which nothing else holds together,
/// E(x) is clipped to positive semi-definite there. What the dilatation carries goes off too: g t (x) t / w, with
/// t = Sum_p c (alpha(x) + alpha(p))/2 |xi|^2 xi (x) xi and g as in BondForces.
template <int dim>
class MorphedStiffness {
 public:
  /// @param e0 E0, [stress]
  /// @param dilatation_factor g M of every point: dim kappa / (2 (dim + 2) mu), [-]; 0: bonds alone carry
  MorphedStiffness(const base::Stiffness<dim>& e0, PeridynamicStiffness policy, double dilatation_factor = 0.)
      : e0_(e0), policy_(policy), dilatation_factor_(dilatation_factor) {}

  /// Recomputes the elements that are touched; needed after alpha or the bonds have grown, or elements were split.
  /// Mesh, points and bonds are always the same ones. Right for active elements. Local.
  /// @param classes,discontinuous per local element, right in the halo too
  void update(const mesh::Mesh<dim>& mesh, const elements::MaterialPoints<dim>& points,
              const bonds::BondFamilies<dim>& bonds, const morphing::MorphingField<dim>& alpha,
              const std::vector<morphing::ElementClass>& classes, const std::vector<char>& discontinuous);

  /// E at the q-th point of a local element, [stress].
  const base::Stiffness<dim>& at(int element, int q) const {
    PERIMORPH_DEBUG_ASSERT(element >= 0 && element < static_cast<int>(first_.size()), "element {} of {}", element,
                           first_.size());
    return first_[element] < 0 ? e0_ : reduced_[first_[element] + q];
  }
  const base::Stiffness<dim>& e0() const { return e0_; }
  double dilatation_factor() const { return dilatation_factor_; }
  /// Whether E = E0 in the whole element.
  bool is_e0(int element) const { return first_[element] < 0; }
  /// Whether E = 0 in the whole element.
  bool is_zero(int element) const {
    PERIMORPH_DEBUG_ASSERT(element >= 0 && element < static_cast<int>(is_zero_.size()), "element {} of {}", element,
                           is_zero_.size());
    return is_zero_[element];
  }

 private:
  base::Stiffness<dim> e0_;
  PeridynamicStiffness policy_;
  double dilatation_factor_;
  std::vector<int> first_;  ///< position of an element's first point in reduced_; -1 for E0
  std::vector<base::Stiffness<dim>> reduced_;
  std::vector<char> is_zero_;

  /// What an element's E(x) was computed from, beside alpha.
  struct Seen {
    std::size_t n_pairs = 0;
    char is_zero = 0, is_discontinuous = 0;
    bool operator==(const Seen& other) const {
      return n_pairs == other.n_pairs && is_zero == other.is_zero && is_discontinuous == other.is_discontinuous;
    }
  };
  std::vector<Seen> seen_;     ///< per element, at the last update
  std::vector<double> alpha_;  ///< per point, at the last update

  std::vector<char> take_over(const elements::MaterialPoints<dim>& points, const morphing::MorphingField<dim>& alpha);
  void compute(int element, const elements::MaterialPoints<dim>& points, const bonds::BondFamilies<dim>& bonds,
               bool is_discontinuous);
};

}  // namespace perimorph::operators
