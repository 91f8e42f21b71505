#pragma once

#include <vector>

#include "perimorph/base/errors.hpp"
#include "perimorph/bonds/bond_families.hpp"

namespace perimorph::operators {

/// What becomes of E(x) in the peridynamic zone: dropped as in WHL19, or kept where bonds are missing (a correction of
/// the surface effect).
enum class PeridynamicStiffness { dropped, kept };

/// What the classical part of the model needs to know of a material.
template <int dim>
struct Elasticity {
  base::Stiffness<dim> e0;        ///< E0, [stress]
  double dilatation_factor = 0.;  ///< g M of its points: dim kappa / (2 (dim + 2) mu), [-]; 0: bonds alone carry
};

/// E(x) = E0 - 1/2 Sum_p c0 (alpha(x) + alpha(p))/2 xi (x) xi (x) xi (x) xi w_p   [WHL19, eq. 16], at material points,
/// with the discrete sum over all visible bonds as they are before any breaks. E0 where there are no bonds. On
/// irregular meshes the sum exceeds E0 at single points; in discontinuous elements, which nothing else holds together,
/// E(x) is clipped to positive semi-definite there. What the dilatation carries goes off too: g t (x) t / w, with
/// t = Sum_p c (alpha(x) + alpha(p))/2 |xi|^2 xi (x) xi and g as in Dilatation. Where a point has bonds to another
/// material, whose sum is not E0, E(x) is clipped and kept until the element is damaged (DECISIONS.md, 37).
template <int dim>
class MorphedStiffness {
 public:
  /// One material everywhere.
  MorphedStiffness(const base::Stiffness<dim>& e0, PeridynamicStiffness policy, double dilatation_factor = 0.)
      : MorphedStiffness({{e0, dilatation_factor}}, {}, policy) {}

  /// @param materials at least one; @param of_element each local element's place in them, (n_elements), or empty
  MorphedStiffness(std::vector<Elasticity<dim>> materials, std::vector<int> of_element, PeridynamicStiffness policy)
      : materials_(std::move(materials)), of_element_(std::move(of_element)), policy_(policy) {}

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
    return first_[element] < 0 ? e0(element) : reduced_[first_[element] + q];
  }
  bool has_several_materials() const { return materials_.size() > 1; }
  /// is_zero() per local element; with several materials right for active elements only, until what the owners know
  /// is shared.
  std::vector<char>& zero_flags() { return is_zero_; }
  int material_of(int element) const { return of_element_.empty() ? 0 : of_element_[element]; }
  const base::Stiffness<dim>& e0(int element) const { return materials_[material_of(element)].e0; }
  double dilatation_factor(int element) const { return materials_[material_of(element)].dilatation_factor; }
  /// Whether any material has one that is not zero.
  bool has_dilatation() const;
  /// Whether E = E0 in the whole element.
  bool is_e0(int element) const { return first_[element] < 0; }
  /// Whether E = 0 in the whole element.
  bool is_zero(int element) const {
    PERIMORPH_DEBUG_ASSERT(element >= 0 && element < static_cast<int>(is_zero_.size()), "element {} of {}", element,
                           is_zero_.size());
    return is_zero_[element];
  }

 private:
  std::vector<Elasticity<dim>> materials_;
  std::vector<int> of_element_;
  PeridynamicStiffness policy_;
  std::vector<int> first_;  ///< position of an element's first point in reduced_; -1 for E0
  std::vector<base::Stiffness<dim>> reduced_;
  std::vector<char> is_zero_;

  /// What an element's E(x) was computed from, beside alpha.
  struct Seen {
    std::size_t n_pairs = 0;
    char is_zero = 0, is_clipped = 0;
    bool operator==(const Seen& other) const {
      return n_pairs == other.n_pairs && is_zero == other.is_zero && is_clipped == other.is_clipped;
    }
  };
  std::vector<Seen> seen_;     ///< per element, at the last update
  std::vector<double> alpha_;  ///< per point, at the last update

  std::vector<char> take_over(const elements::MaterialPoints<dim>& points, const morphing::MorphingField<dim>& alpha);
  bool sees_another_material(int element, const bonds::BondFamilies<dim>& bonds) const;
  void compute(int element, const elements::MaterialPoints<dim>& points, const bonds::BondFamilies<dim>& bonds,
               bool is_clipped);
};

}  // namespace perimorph::operators
