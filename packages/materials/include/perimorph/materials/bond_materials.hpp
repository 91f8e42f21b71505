#pragma once

#include <vector>

#include "perimorph/base/errors.hpp"
#include "perimorph/materials/bond_law.hpp"
#include "perimorph/materials/micromodulus.hpp"

namespace perimorph::materials {

/// The harmonic mean of two stiffnesses >= 0: that of a spring of two halves. Zero if one is.
template <class Number>
Number harmonic_mean(const Number& one, const Number& other) {
  return 2. / (1. / one + 1. / other);
}

/// The materials of elements as bonds see them: their micromoduli, and how they break. Between two materials a bond has
/// the harmonic mean of both (DECISIONS.md, 37).
class BondMaterials {
 public:
  /// One material everywhere.
  BondMaterials(const Micromodulus& only, const BondLaw& law = {})  // NOLINT(google-explicit-constructor): mostly so
      : BondMaterials(std::vector<Micromodulus>{only}, {law}, {}) {}

  /// @param micromoduli of the materials, all with one horizon
  /// @param laws of the bonds between any two materials, (n, n), symmetric
  /// @param of_element place of each local element's material in them, (n_elements)
  BondMaterials(std::vector<Micromodulus> micromoduli, std::vector<BondLaw> laws, std::vector<int> of_element);

  /// The material of a local element, by its place.
  int of(int element) const { return of_element_.empty() ? 0 : of_element_[element]; }
  /// Of bonds between two local elements.
  const BondLaw& law(int first_element, int second_element) const {
    return laws_[static_cast<std::size_t>(of(first_element)) * micromoduli_.size() + of(second_element)];
  }
  bool softens() const;           ///< whether any of the laws does
  bool sees_compression() const;  ///< the same
  double smallest_limit() const;  ///< of all laws, [-]
  bool is_single() const { return micromoduli_.size() == 1; }
  const Micromodulus& micromodulus_of(int element) const { return micromoduli_[of(element)]; }
  double horizon() const { return micromoduli_[0].horizon; }  ///< [length]

  /// What c0(const Micromodulus&) gives for the materials of two local elements: of one, or the harmonic mean of both.
  template <class C0>
  double mean_of(int first_element, int second_element, C0 c0) const {
    const double of_first = c0(micromodulus_of(first_element));
    if (of(first_element) == of(second_element)) return of_first;
    return harmonic_mean(of_first, c0(micromodulus_of(second_element)));
  }

  /// c0 of a bond between two local elements at a distance, [length].
  double stiffness(int first_element, int second_element, double distance) const {
    return mean_of(first_element, second_element, [=](const Micromodulus& c0) { return c0(distance); });
  }

 private:
  std::vector<Micromodulus> micromoduli_;
  std::vector<BondLaw> laws_;
  std::vector<int> of_element_;  ///< empty: all of the first
};

}  // namespace perimorph::materials
