#pragma once

#include "perimorph/discretization/topology.hpp"
#include "perimorph/morphing/morphing_field.hpp"
#include "perimorph/operators/coupled_system.hpp"
#include "perimorph/solvers/linear_solver.hpp"

namespace perimorph::model {

/// How a body is discretized, and how well its equations are solved. Lengths have no defaults: they depend on the
/// horizon.
struct NumericalOptions {
  morphing::BlendingFunction blending_function = morphing::BlendingFunction::linear;
  discretization::DiscontinuousElements discontinuous = discretization::DiscontinuousElements::on_damage;
  operators::PeridynamicStiffness peridynamic_stiffness = operators::PeridynamicStiffness::dropped;
  double growth_inner_radius = 0., growth_outer_radius = 0.;  ///< r_i, r_o of new zones, [length]
  int points_per_direction = 2;                               ///< material points of an element
  double tolerance = 1e-6;            ///< residual over reaction forces in accepted solutions [-]
  double damage_tolerance = 1e-4;     ///< the same while bonds break [-]
  double softening_tolerance = 2e-3;  ///< change of forces over reactions from which softening counts [-]
  double breaking_fraction = 1.;      ///< share of the overstretched bonds that break between two solves [-]
  operators::OperatorForm operator_form = operators::OperatorForm::matrix_free;
  operators::PreconditionerMatrix preconditioner_matrix = operators::PreconditionerMatrix::short_range;
  double short_range_cut_off = 0.;  ///< of the bonds in the short-range matrix, [length]
  operators::WindowOptions window;  ///< around bonds that break
  solvers::SolverParameters solver;
};

}  // namespace perimorph::model
