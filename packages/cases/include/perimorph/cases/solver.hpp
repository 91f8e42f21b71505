#pragma once

#include <optional>

#include "perimorph/input/section.hpp"
#include "perimorph/input/values.hpp"
#include "perimorph/model/numerical_options.hpp"

namespace perimorph::cases {

/// Conjugate gradients with an algebraic multigrid preconditioner: what is not in the numerical options as it is.
struct Solver {
  std::optional<double> short_range_cut_off;  ///< of the bonds in the short-range matrix [horizons]
  bool windows = true;                        ///< are solved in while bonds break
  std::optional<double> window_radius;        ///< [horizons]
  double largest_imbalance = 1.25;            ///< of the ranks' work, before the mesh is partitioned again [-]
};

/// [horizons]
double default_window_radius(int dimension);

void declare(const input::Section& decisive, Solver& solver, model::NumericalOptions& numerical);

/// @param has_dilatation as the material says
void check_solver(const input::Values& section, bool has_dilatation, bool softens, bool has_rigid_groups);

}  // namespace perimorph::cases
