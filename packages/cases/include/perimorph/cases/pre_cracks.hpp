#pragma once

#include <string>
#include <vector>

#include "perimorph/input/section.hpp"
#include "perimorph/input/values.hpp"

namespace perimorph::cases {

enum class PreCrackShape { polyline, polygon, disc };  ///< the first in 2D, the others in 3D

/// A polyline (2D), or a flat convex polygon or a disc (3D), along which there are no bonds and elements part,
/// [length].
struct PreCrack {
  std::string name;
  PreCrackShape shape = PreCrackShape::polyline;
  std::vector<double> points;          ///< polyline, polygon: corners, (n, dim) in a row
  std::vector<double> center, normal;  ///< disc: (dim); the normal of any length
  double radius = 0.;                  ///< disc
};

void declare(const input::Section& section, PreCrack& crack);
void check_pre_crack(const input::Values& crack, int dimension);

}  // namespace perimorph::cases
