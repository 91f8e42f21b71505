#pragma once

#include <cstdint>
#include <vector>

#include "perimorph/base/errors.hpp"
#include "perimorph/bonds/bond.hpp"
#include "perimorph/bonds/bond_change.hpp"
#include "perimorph/bonds/element_balls.hpp"
#include "perimorph/bonds/visibility.hpp"
#include "perimorph/materials/bond_materials.hpp"
#include "perimorph/morphing/morphing_field.hpp"

namespace perimorph::bonds {

/// Two elements with bonds between their points; the one with the lower global id comes first, so that every rank
/// computes a bond from the same numbers in the same order. An element pairs with itself too.
struct ElementPair {
  int first, second;  ///< local elements
  bool operator==(const ElementPair& other) const { return first == other.first && second == other.second; }
};

/// Where the stiffness of a bond comes from: memory, or its points.
enum class StiffnessStorage { stored, on_the_fly };

/// What bonds look at beside displacements, at the points, (n_points) each, [-].
struct PointStrains {
  std::vector<double> eigenstrain = {};  ///< empty: none
  std::vector<double> dilatation = {};   ///< without that of the eigenstrain; empty where no law sees compression
};

/// All bonds that touch this rank's active elements and of which an end has alpha > 0. They are kept by pairs of
/// elements: bonds of pair p are first_bond(p) ... first_bond(p+1)-1. The broken set lives here.
template <int dim>
class BondFamilies {
 public:
  /// No bonds yet: extend() adds them. Local. Mesh and points must outlive this.
  /// @param points of that mesh
  /// @param active per element, (n_elements): whether it is around a node that this rank owns (mesh::active_elements)
  /// @param materials the stiffness of bonds by their ends and length, their laws, and the horizon
  /// @param pre_cracks facets that no bond crosses, the same on all ranks, (n), [length]
  /// @param kept whether stiffnesses are stored or computed from the points each time
  BondFamilies(const mesh::Mesh<dim>& mesh, const elements::MaterialPoints<dim>& points, std::vector<char> active,
               const materials::BondMaterials& materials, const std::vector<mesh::CrackFacet<dim>>& pre_cracks,
               StiffnessStorage kept = StiffnessStorage::stored);

  /// Adds the bonds of elements that have come to carry bonds; those already known are passed over. Local.
  /// @param elements local, in the order in which bonds get their numbers: MorphingField::add() returns them
  void extend(const std::vector<int>& elements);

  int n_pairs() const { return static_cast<int>(pairs_.size()); }
  BondId n_bonds() const { return ends_.size(); }
  const ElementPair& pair(int p) const {
    PERIMORPH_DEBUG_ASSERT(p >= 0 && p < n_pairs(), "pair {} of {}", p, n_pairs());
    return pairs_[p];
  }
  BondId first_bond(int p) const {
    PERIMORPH_DEBUG_ASSERT(p >= 0 && p <= n_pairs(), "pair {} of {}", p, n_pairs());
    return first_bond_[p];
  }
  /// The pairs that a local element is in, ascending.
  const std::vector<int>& pairs_of(int element) const {
    PERIMORPH_DEBUG_ASSERT(mesh_.has_element(element), "element {} of {}", element, mesh_.n_elements());
    return pairs_of_[element];
  }
  bool is_active(int element) const {
    PERIMORPH_DEBUG_ASSERT(mesh_.has_element(element), "element {} of {}", element, mesh_.n_elements());
    return active_[element];
  }

  /// A bond of a pair, or one whose pair has to be looked up. Local.
  Bond<dim> bond(int pair, BondId b) const;
  Bond<dim> bond(BondId b) const { return bond(pair_of(b), b); }

  /// Calls visit(const Bond<dim>&) for each bond of a pair, or of all pairs, by ascending number. Local.
  template <class Visit>
  void for_each_bond(int pair, Visit&& visit) const;
  template <class Visit>
  void for_each_bond(Visit&& visit) const;

  /// Points at the bond's ends, counted within their elements.
  int first_end(BondId b) const { return (ends_of(b) & ~broken_bit) / elements::max_points; }
  int second_end(BondId b) const { return (ends_of(b) & ~broken_bit) % elements::max_points; }
  /// c0(|xi|) w_x w_p, [force / length^3]: the spring's stiffness along xi (x) xi, before alpha, softening and
  /// breaking; in single precision, so that every form of the operator has the same bonds.
  double stiffness(const Bond<dim>& bond) const {
    PERIMORPH_DEBUG_ASSERT(bond.id < n_bonds(), "bond {} of {}", bond.id, n_bonds());
    return computes_stiffness() ? stiffness_on_the_fly(bond) : stiffness_[bond.id];
  }
  /// Share of it that softening has left; of a broken bond when it broke; [-].
  double share_left(const Bond<dim>& bond) const {
    if (!softens_) return 1.;
    return materials_.law(bond.first_element, bond.second_element).share_left(softening_[bond.id].largest);
  }
  bool softens() const { return softens_; }
  /// Of a bond that may soften: 0 where it never has; when it broke, the critical one as soon as that is accepted.
  const SofteningHistory& softening(BondId b) const {
    PERIMORPH_DEBUG_ASSERT(b < softening_.size(), "bond {} of {}", b, softening_.size());
    return softening_[b];
  }
  bool computes_stiffness() const { return kept_ == StiffnessStorage::on_the_fly; }
  const materials::BondMaterials& materials() const { return materials_; }
  /// Whether a bond counts on this rank: it owns the first element; of two that are mirror images of each other, across
  /// a plane of symmetry, only one counts.
  bool counts_here(const Bond<dim>& bond) const {
    if (bond.first_element >= mesh_.n_owned_elements) return false;
    if (!mesh_.is_image(bond.second_element)) return true;
    const int other = mesh_.image(bond.second_element).element;
    if (other == bond.first_element) return bond.first_end <= bond.second_end;
    return mesh_.element_ids[bond.first_element] < mesh_.element_ids[other];
  }
  /// How much of its energy belongs to what this rank owns: half where the bond is its own mirror image.
  double share_here(const Bond<dim>& bond) const {
    if (!counts_here(bond)) return 0.;
    const bool is_its_own_image = mesh_.is_image(bond.second_element) && bond.first_end == bond.second_end &&
                                  mesh_.image(bond.second_element).element == bond.first_element;
    return is_its_own_image ? 0.5 : 1.;
  }
  bool broken(BondId b) const { return (ends_of(b) & broken_bit) != 0; }
  int pair_of(BondId b) const;

  /// [bytes] of memory, most of it 6 bytes a bond; 2 if stiffness is computed on the fly; 8 more if bonds soften.
  std::size_t bytes() const;

  /// The bond between two points of different elements, each given by element and number within it; n_bonds() if this
  /// rank has none. Local.
  /// @param first,second local elements, in the order of the pair: the lower global id first
  /// @param first_end,second_end 0 ... number of the element's points - 1
  BondId find(int first, int first_end, int second, int second_end) const;

  /// Share of a point's bonds, by volume, that are broken (Silling and Askari 2005), or of what they were that
  /// softening has taken. For active elements.
  /// @param point local material point
  /// @return 0 ... 1 [-]
  double damage(int point) const {
    PERIMORPH_DEBUG_ASSERT(point >= 0 && point < points_.size(), "point {} of {}", point, points_.size());
    return lost_volume_[point] / std::max(family_volume_[point], 1e-300);
  }
  /// Whether a bond of the element has broken or softened. For active elements.
  bool is_damaged(int element) const {
    PERIMORPH_DEBUG_ASSERT(mesh_.has_element(element), "element {} of {}", element, mesh_.n_elements());
    return damaged_[element];
  }

  /// Smallest and largest alpha over each point's neighbourhood, itself included, (n_points). For active elements.
  struct Extremes {
    std::vector<double> smallest, largest;
  };
  /// @param alpha at the points that the bonds join
  Extremes neighbourhood_extremes(const morphing::MorphingField<dim>& alpha) const;

  /// The unbroken bonds whose stretch, as far as it counts and is beyond the mean eigenstrain of both ends, reaches
  /// their critical one [WHL19, eq. 6, 7], between two different elements that both may break, ascending. Local: every
  /// rank that holds a bond decides alike.
  /// @param displacements at the points, (n_points), [length]; only those of elements with bonds are read
  /// @param classes by local element, (n_elements): those of PD may break
  /// @param ratio of the critical stretches from which bonds count, >= 0, [-]
  std::vector<BondId> overstretched(const std::vector<base::Point<dim>>& displacements,
                                    const std::vector<morphing::ElementClass>& classes, double ratio = 1.,
                                    const PointStrains& strains = {}) const;

  /// What counts of stretches over the limits of the laws, of those bonds that reach a ratio of them, (n), [-]; those
  /// of which this rank owns the first element, so that each comes from one rank. Arguments as there. Local.
  std::vector<double> overstretches(const std::vector<base::Point<dim>>& displacements,
                                    const std::vector<morphing::ElementClass>& classes, double ratio = 1.,
                                    const PointStrains& strains = {}) const;

  /// The bonds whose softening differs from what it was, without breaking. Arguments as there. Local.
  /// @param may_recover whether they may take back what is not accepted
  std::vector<SoftenedBond> softened(const std::vector<base::Point<dim>>& displacements,
                                     const std::vector<morphing::ElementClass>& classes, bool may_recover,
                                     const std::vector<double>& eigenstrain = {}) const;

  /// Marks bonds as broken or softened: unbroken ones, between two different elements. Local.
  void take(const BondChange& change);

  /// What has softened is not taken back any more. Local.
  void accept_softening();

  /// Softening that comes from elsewhere, after what is broken; the bonds without a history have none, or broke before.
  /// Local.
  void restore_softening(const SofteningHistories& histories);

  /// Elements of bonds that have softened are damaged from now on. Local.
  void note_softening();
  void note_damage(int element) { damaged_[element] = 1; }

  /// The damage of points no longer depends on the order in which bonds softened. Local.
  void recount_damage();

 private:
  const mesh::Mesh<dim>& mesh_;
  const elements::MaterialPoints<dim>& points_;
  std::vector<char> active_;
  materials::BondMaterials materials_;
  StiffnessStorage kept_;
  bool softens_;
  Visibility<dim> visibility_;
  ElementBalls<dim> balls_;
  std::vector<char> searched_;

  std::vector<ElementPair> pairs_;
  std::vector<BondId> first_bond_ = {0};
  std::vector<std::vector<int>> pairs_of_;
  static constexpr unsigned broken_bit = 1u << 15;  ///< of ends_, the rest of which is below 27 * 27
  std::vector<std::uint16_t> ends_;
  std::vector<float> stiffness_;             ///< empty if computed on the fly
  std::vector<SofteningHistory> softening_;  ///< empty if nothing softens
  std::vector<double> family_volume_, lost_volume_;
  std::vector<char> damaged_;

  std::uint16_t ends_of(BondId b) const {
    PERIMORPH_DEBUG_ASSERT(b < n_bonds(), "bond {} of {}", b, n_bonds());
    return ends_[b];
  }
  double stiffness_on_the_fly(const Bond<dim>& bond) const;
  template <class Threshold, class Visit>
  void for_each_stretched(const std::vector<base::Point<dim>>& displacements,
                          const std::vector<morphing::ElementClass>& classes, const std::vector<double>& eigenstrain,
                          Threshold threshold, Visit visit) const;
  void check_dilatation(const std::vector<double>& dilatation) const;
  void lose(const Bond<dim>& bond, double share);
  void check_arguments() const;
  void add_pair(int a, int b, const std::vector<typename Visibility<dim>::Facet>& obstacles);
};

template <int dim>
inline Bond<dim> BondFamilies<dim>::bond(int pair, BondId b) const {
  PERIMORPH_DEBUG_ASSERT(b >= first_bond(pair) && b < first_bond(pair + 1), "bond {} is not of pair {}", b, pair);
  const auto [first, second] = pairs_[pair];
  const int first_end = this->first_end(b), second_end = this->second_end(b);
  const int i = points_.first(first) + first_end, j = points_.first(second) + second_end;
  return {b, first, second, first_end, second_end, i, j, points_.position(j) - points_.position(i), broken(b)};
}

template <int dim>
template <class Visit>
void BondFamilies<dim>::for_each_bond(int pair, Visit&& visit) const {
  for (BondId b = first_bond_[pair]; b < first_bond_[pair + 1]; ++b) visit(bond(pair, b));
}

template <int dim>
template <class Visit>
void BondFamilies<dim>::for_each_bond(Visit&& visit) const {
  for (int p = 0; p < n_pairs(); ++p) for_each_bond(p, visit);
}

}  // namespace perimorph::bonds
