#pragma once

#include <vector>

#include "perimorph/mesh/mesh.hpp"

namespace perimorph::mesh {

/// How far a smooth boundary, of which an element's side is a chord, may be from that side.
template <int dim>
struct ChordError {
  int element;       ///< local
  double distance;   ///< [length]
  Point<dim> place;  ///< the side's middle, [length]
};

/// Where the boundary is curved, as far as its sides show it: two that meet under less than 40 degrees are taken for
/// chords of a circle, from which they are an eighth of the angle times the distance of their middles away. By element.
/// Local. @param whole all elements are here
template <int dim>
std::vector<ChordError<dim>> chord_errors(const Mesh<dim>& whole);

}  // namespace perimorph::mesh
