#pragma once

#include <string>
#include <vector>

#include "perimorph/input/section.hpp"
#include "perimorph/input/values.hpp"
#include "perimorph/model/numerical_options.hpp"

namespace perimorph::cases {

/// A ball is a circle in 2D, a sphere in 3D; automatic ones are balls where the elastic body is stretched most.
enum class SeedShape { ball, cylinder, box, everything, automatic };

/// A first peridynamic zone: alpha = 1 inside, falling to 0 over the rim. Lengths in the mesh's unit, [length].
struct Seed {
  std::string name;
  SeedShape shape = SeedShape::ball;
  std::vector<double> center;                      ///< ball: (dim)
  std::vector<double> start, end;                  ///< cylinder: the ends of its axis, (dim)
  double inner_radius = 0., outer_radius = 0.;     ///< ball, cylinder, automatic: r1, r2
  std::vector<double> lower_corner, upper_corner;  ///< box: (dim)
  double rim = 0.;                                 ///< box: width over which alpha falls from 1 to 0
  double share = 0.8;                              ///< automatic: of the largest strain, that others must reach [-]
};

/// Where the body is peridynamic, and how that zone grows.
struct Morphing {
  double growth_inner_radius = 2., growth_outer_radius = 4.;  ///< of new zones [horizons]
  std::vector<Seed> seeds;
};

void declare(const input::Section& section, Morphing& morphing, model::NumericalOptions& numerical);
void check_morphing(const input::Values& section, int dimension);

}  // namespace perimorph::cases
