#pragma once

#include <map>
#include <tuple>

#include "perimorph/bonds/bond.hpp"

namespace perimorph::bonds {

/// The places of a bond's ends: local elements, and the points within them.
struct BondEnds {
  int first_element, first_end, second_element, second_end;
  friend bool operator<(const BondEnds& a, const BondEnds& b) {
    const auto all = [](const BondEnds& e) {
      return std::tie(e.first_element, e.first_end, e.second_element, e.second_end);
    };
    return all(a) < all(b);
  }
};

template <int dim>
BondEnds ends_of(const Bond<dim>& bond) {
  return {bond.first_element, bond.first_end, bond.second_element, bond.second_end};
}

/// How far the faces of a crack have slid where a bond was, and the friction that held them then.
template <int dim>
struct Slip {
  base::Point<dim> distance = base::Point<dim>::Zero();  ///< of the second end against the first, [length]
  base::Point<dim> friction = base::Point<dim>::Zero();  ///< on the second end, [force]
};

template <int dim>
using Slips = std::map<BondEnds, Slip<dim>>;

}  // namespace perimorph::bonds
