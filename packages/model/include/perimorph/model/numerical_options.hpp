#pragma once

#include <string>
#include <vector>

#include "perimorph/discretization/topology.hpp"
#include "perimorph/morphing/morphing_field.hpp"
#include "perimorph/operators/coupled_system.hpp"
#include "perimorph/solvers/linear_solver.hpp"

namespace perimorph::model {

/// Where the mesh is refined by itself. Lengths are in sizes of the finest elements [-].
struct RefinementOptions {
  int levels = 0;           ///< how often elements are divided where they are finest; 0: nowhere
  double margin = 3.;       ///< how far they are so beyond the reach of bonds, at least 2
  double grading = 3.;      ///< beyond, an element may be as large as its distance from there over this
  double look_ahead = 10.;  ///< how much further they are so around cracks that come near to larger elements
  std::vector<std::string> groups = {};  ///< of nodes, around which elements are finest, too
  double perturbation = 0.;  ///< by how much of its shortest edge an inner node of finest elements may be moved [-]
};

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
  RefinementOptions refinement;
  solvers::SolverParameters solver;
};

}  // namespace perimorph::model
