#pragma once

#include <cstdint>
#include <vector>

#include "perimorph/bonds/bond.hpp"
#include "perimorph/bonds/bond_change.hpp"
#include "perimorph/bonds/visibility.hpp"
#include "perimorph/materials/micromodulus.hpp"
#include "perimorph/morphing/morphing_field.hpp"

namespace perimorph::bonds {

/// Two elements with bonds between their points; the one with the lower global id comes first, so that every rank
/// computes a bond from the same numbers in the same order. An element pairs with itself too.
struct ElementPair {
  int first, second;  ///< local elements
};

/// Where the stiffness of a bond comes from: memory, or its points.
enum class StiffnessStorage { stored, on_the_fly };

/// All bonds that touch this rank's active elements and of which an end has alpha > 0. They are kept by pairs of
/// elements: bonds of pair p are first_bond(p) ... first_bond(p+1)-1. The broken set lives here.
template <int dim>
class BondFamilies {
 public:
  /// Local. The arguments must outlive this.
  /// @param active elements around the nodes that this rank owns (mesh::active_elements)
  BondFamilies(const mesh::Mesh<dim>& mesh, const elements::MaterialPoints<dim>& points, std::vector<char> active,
               const materials::Micromodulus& micromodulus, const std::vector<mesh::CrackFacet<dim>>& pre_cracks,
               StiffnessStorage kept = StiffnessStorage::stored);

  /// Adds the bonds of elements that have come to carry bonds; those already known are passed over. Local.
  void extend(const std::vector<int>& elements);

  int n_pairs() const { return static_cast<int>(pairs_.size()); }
  BondId n_bonds() const { return ends_.size(); }
  const ElementPair& pair(int p) const { return pairs_[p]; }
  BondId first_bond(int p) const { return first_bond_[p]; }
  const std::vector<int>& pairs_of(int element) const { return pairs_of_[element]; }
  bool is_active(int element) const { return active_[element]; }

  /// A bond of a pair, or one whose pair has to be looked up.
  Bond<dim> bond(int pair, BondId b) const;
  Bond<dim> bond(BondId b) const { return bond(pair_of(b), b); }

  /// Calls visit(const Bond<dim>&) for each bond of a pair, or of all pairs, by ascending number.
  template <class Visit>
  void for_each_bond(int pair, Visit&& visit) const;
  template <class Visit>
  void for_each_bond(Visit&& visit) const;

  /// Points at the bond's ends, counted within their elements.
  int first_end(BondId b) const { return (ends_[b] & ~broken_bit) / elements::max_points; }
  int second_end(BondId b) const { return (ends_[b] & ~broken_bit) % elements::max_points; }
  /// c0(|xi|) w_x w_p, [force / length^3]: the spring's stiffness along xi (x) xi, before alpha and breaking; in single
  /// precision, so that every form of the operator has the same bonds.
  double stiffness(BondId b, int first_point, int second_point) const {
    return computes_stiffness() ? stiffness_on_the_fly(first_point, second_point) : stiffness_[b];
  }
  double stiffness(const Bond<dim>& bond) const { return stiffness(bond.id, bond.first_point, bond.second_point); }
  bool computes_stiffness() const { return kept_ == StiffnessStorage::on_the_fly; }
  const materials::Micromodulus& micromodulus() const { return micromodulus_; }
  bool broken(BondId b) const { return (ends_[b] & broken_bit) != 0; }
  int pair_of(BondId b) const;

  /// Of memory, most of it 6 bytes a bond; 2 if stiffness is computed on the fly.
  std::size_t bytes() const;

  /// The bond between two points of different elements, each told by element and number within it; n_bonds() if this
  /// rank has none. Local.
  BondId find(int first, int first_end, int second, int second_end) const;

  /// Share of a point's bonds, by volume, that are broken (Silling and Askari 2005). For active elements.
  double damage(int point) const { return lost_volume_[point] / std::max(family_volume_[point], 1e-300); }
  /// Whether a bond of the element has broken. For active elements.
  bool is_damaged(int element) const { return damaged_[element]; }

  /// Smallest and largest alpha over each point's neighbourhood, itself included. For active elements.
  struct Extremes {
    std::vector<double> smallest, largest;
  };
  Extremes neighbourhood_extremes(const morphing::MorphingField<dim>& alpha) const;

  /// The intact bonds whose stretch reaches the critical one [WHL19, eq. 6, 7], between two different elements that
  /// both may break, ascending. Local: every rank that holds a bond decides alike.
  /// @param displacements at the points, (n_points), [length]; only those of elements with bonds are read
  std::vector<BondId> overstretched(const std::vector<base::Point<dim>>& displacements, double critical_stretch,
                                    const std::vector<morphing::ElementClass>& classes) const;

  /// Their stretches; those of which this rank owns the first element, so that each comes from one rank. Local.
  std::vector<double> overstretches(const std::vector<base::Point<dim>>& displacements, double critical_stretch,
                                    const std::vector<morphing::ElementClass>& classes) const;

  /// Marks bonds as broken. Local.
  void take(const BondChange& change);

 private:
  const mesh::Mesh<dim>& mesh_;
  const elements::MaterialPoints<dim>& points_;
  std::vector<char> active_;
  materials::Micromodulus micromodulus_;
  StiffnessStorage kept_;
  Visibility<dim> visibility_;
  std::vector<base::Point<dim>> centroids_;
  std::vector<double> radii_;
  double largest_radius_ = 0.;
  std::unique_ptr<base::PointTree<dim>> tree_;
  std::vector<char> searched_;

  std::vector<ElementPair> pairs_;
  std::vector<BondId> first_bond_ = {0};
  std::vector<std::vector<int>> pairs_of_;
  static constexpr unsigned broken_bit = 1u << 15;  ///< of ends_, the rest of which is below 27 * 27
  std::vector<std::uint16_t> ends_;
  std::vector<float> stiffness_;  ///< empty if computed on the fly
  std::vector<double> family_volume_, lost_volume_;
  std::vector<char> damaged_;

  double stiffness_on_the_fly(int first_point, int second_point) const;
  template <class Visit>
  void for_each_overstretched(const std::vector<base::Point<dim>>& displacements, double critical_stretch,
                              const std::vector<morphing::ElementClass>& classes, Visit visit) const;
  void add_pair(int a, int b, const std::vector<typename Visibility<dim>::Facet>& obstacles);
};

template <int dim>
inline Bond<dim> BondFamilies<dim>::bond(int pair, BondId b) const {
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
