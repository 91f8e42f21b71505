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

/// What friction takes from one state of the slips to the next, by the mean of both frictions, [energy]. Local.
/// @param n_owned_elements a slip counts on the rank that owns its first element
template <int dim>
double work_of_friction(const Slips<dim>& before, const Slips<dim>& after, int n_owned_elements) {
  double work = 0.;
  for (const auto& [ends, now] : after) {
    if (ends.first_element >= n_owned_elements || now.friction.isZero(0.)) continue;
    const auto found = before.find(ends);
    const auto then = found == before.end() ? Slip<dim>() : found->second;
    work += 0.5 * (then.friction + now.friction).dot(now.distance - then.distance);
  }
  return work;
}

}  // namespace perimorph::bonds
