#pragma once

#include <Teuchos_ParameterList.hpp>
#include <optional>
#include <string>
#include <vector>

#include "perimorph/materials/elasticity.hpp"
#include "perimorph/morphing/morphing_field.hpp"
#include "perimorph/operators/coupled_system.hpp"

namespace perimorph::fracture {

using materials::ElasticModel;
using operators::PeridynamicStiffness;
/// A ball is a circle in 2D, a sphere in 3D; automatic ones are balls where the elastic body is stretched most.
enum class SeedShape { ball, cylinder, box, everything, automatic };
enum class PreCrackShape { polyline, polygon, disc };  ///< the first in 2D, the others in 3D
using BlendingFunction = morphing::BlendingFunction;
using discretization::DiscontinuousElements;
enum class Calibration { analytic, mesh_consistent };  ///< of the critical stretch and the fracture energy
using operators::OperatorForm;
using operators::PreconditionerMatrix;

/// A first peridynamic zone: alpha = 1 inside, falling to 0 over the rim. Lengths in the mesh's unit.
struct Seed {
  std::string name;
  SeedShape shape;
  std::vector<double> center;                      ///< ball: (dim)
  std::vector<double> start, end;                  ///< cylinder: the ends of its axis, (dim)
  double inner_radius = 0., outer_radius = 0.;     ///< ball, cylinder, automatic: r1, r2
  std::vector<double> lower_corner, upper_corner;  ///< box: (dim)
  double rim = 0.;                                 ///< box: width over which alpha falls from 1 to 0
  double share = 0.;                               ///< automatic: of the largest strain, that others must reach [-]
};

/// A polyline (2D), or a flat convex polygon or a disc (3D), along which there are no bonds and elements part.
struct PreCrack {
  std::string name;
  PreCrackShape shape;
  std::vector<double> points;          ///< polyline, polygon: corners, (n, dim) in a row
  std::vector<double> center, normal;  ///< disc: (dim); the normal of any length
  double radius = 0.;                  ///< disc
};

/// One displacement component of a group: rate * increment + constant, [length].
struct PrescribedDisplacement {
  std::string name, group;
  int component;  ///< 0, 1, 2 for x, y, z
  double rate, constant;
};

/// Force per area on a side set: rate * increment + constant, [stress], (dim) each.
struct Traction {
  std::string name, group;
  std::vector<double> rate, constant;
};

/// Points, and lines between them, at which displacement and stress are recorded.
struct Probe {
  std::string name;
  std::vector<double> points;  ///< x1 y1 x2 y2 ..., at least one point, [length]
  int divisions;               ///< of each segment between a point and the next
};

/// Everything that a case file says, complete and checked by itself (not yet against the mesh).
struct Case {
  std::string file;       ///< of the case, as given
  std::string directory;  ///< where relative file names in it start
  std::string name;       ///< the file's name without its ending: names the results
  std::string title;
  int dimension;

  std::string mesh_file;  ///< resolved against directory
  double mesh_scale;      ///< factor on its coordinates [-]

  double youngs_modulus, poissons_ratio;
  ElasticModel elastic_model;
  std::optional<double> critical_stretch, fracture_energy;  ///< at most one; none: nothing breaks
  Calibration calibration;

  double horizon, characteristic_length;
  int points_per_direction;  ///< material points of an element

  BlendingFunction blending_function;
  DiscontinuousElements discontinuous;
  PeridynamicStiffness peridynamic_stiffness;
  double growth_inner_radius, growth_outer_radius;  ///< r_i, r_o of new zones, [length] (given in horizons)
  std::vector<Seed> seeds;
  std::vector<PreCrack> pre_cracks;

  std::vector<PrescribedDisplacement> displacements;
  std::vector<Traction> tractions;
  std::vector<double> body_force_rate, body_force_constant;  ///< (dim), force per volume

  int increments;
  int max_damage_iterations;  ///< solves within one increment
  int max_zone_growths;       ///< changes of topology within one increment
  double breaking_fraction;   ///< share of the overstretched bonds that break between two solves

  OperatorForm operator_form;
  PreconditionerMatrix preconditioner_matrix;
  double short_range_cut_off;  ///< of the bonds in the short-range matrix, [length] (given in horizons)
  double tolerance;            ///< residual over reaction forces, in accepted solutions
  double damage_tolerance;     ///< the same while bonds break
  int max_cg_iterations;
  double renewal_cost;                  ///< of the preconditioner, in iterations
  double largest_imbalance;             ///< of the ranks' work, before it is parted anew
  Teuchos::ParameterList belos, muelu;  ///< overrides, free-form

  int output_every;           ///< fields are written every so many increments, at every break, and at the last one
  bool spread_files;          ///< fields in a file of each rank
  int checkpoint_every;       ///< increments; 0: not by these
  double checkpoint_minutes;  ///< 0: not by time
  std::vector<std::string> reactions;  ///< groups whose reaction is recorded; default: all with prescribed displacement

  std::vector<Probe> probes;
  bool records_crack;                ///< its size and path
  std::vector<int> bond_increments;  ///< after which all bonds are written

  Teuchos::ParameterList resolved;   ///< every parameter with its value, defaults filled in
  std::map<std::string, int> lines;  ///< "/Section/Name" -> line in the file; 0: on the command line
};

/// The reference: every parameter with default, documentation and validator. Sublists whose entries the user names
/// (seeds, pre-cracks, displacements, tractions) hold one template entry called "*".
Teuchos::ParameterList case_schema();

/// Reads and checks a case file; overrides are "Section/Sub/Name=value". Local.
/// @throws UserError that lists ALL mistakes, one a line, "file:line: /path: what was found; what is allowed"; if there
///         are any, also what of the rest does not fit the mesh.
Case read_case(const std::string& file, const std::vector<std::string>& overrides = {});

/// The schema as text: path, type, default, allowed values, documentation.
std::string describe_schema();

/// The same as a Markdown page, packages/PARAMETERS.md.
std::string describe_schema_in_markdown();

/// The schema in RELAX NG (XML syntax), for editors: names, types, and words where only some are allowed.
std::string describe_schema_in_relax_ng();

}  // namespace perimorph::fracture
