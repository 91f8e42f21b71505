// Every parameter of the case file: name, default (or an example, where there is none), documentation, rule. Units
// stand in brackets; perimorph knows none, so that any consistent set will do (mm, N and MPa; or m, N and Pa).

#include <fmt/format.h>

#include <Teuchos_Array.hpp>

#include "choices.hpp"
#include "perimorph/fracture/case.hpp"
#include "perimorph/input/rules.hpp"
#include "perimorph/mesh_files/read_mesh.hpp"
#include "perimorph/operators/bond_selection.hpp"

namespace perimorph::fracture {

namespace {

using namespace input;  // the rules
using Numbers = Teuchos::Array<double>;
using Texts = Teuchos::Array<std::string>;
using Teuchos::ParameterList;

std::vector<std::string> geometry_and_mesh_endings() {
  std::vector<std::string> endings = mesh_files::mesh_file_endings();
  endings.insert(endings.begin(), ".geo");
  return endings;
}

/// A section, or with the name "*" the template of entries that the user names.
ParameterList& section(ParameterList& parent, const std::string& name, const std::string& documentation) {
  return parent.sublist(name, false, documentation);
}

void declare_general(ParameterList& root) {
  root.set("Title", "", "A line about the case, for people.", any_text());
  root.set("Dimension", 2,
           "Dimensions of space. It decides how many numbers a point has, which elements the mesh needs, and which "
           "elastic models and shapes of seeds and pre-cracks are allowed.",
           either(2, 3));
  ParameterList& mesh = section(root, "Mesh", "Where the body comes from.");
  mesh.set(
      "File", "plate.geo",
      "gmsh geometry (.geo, meshed on the way and kept), or mesh of gmsh (.msh), Exodus (.e, .exo) or ANSYS (.cdb, "
      "blocked archive), relative to the case file's folder. Its physical groups, sets or components are the names "
      "that boundary conditions refer to.",
      required(file_name(geometry_and_mesh_endings())));
  mesh.set("Scale", 1.,
           "Factor on the coordinates in that file [-]: 1000 for a mesh in m and a case in mm. All lengths in the case "
           "are those after scaling.",
           above(0.));
}

void declare_material(ParameterList& root) {
  ParameterList& material =
      section(root, "Material", "One homogeneous, isotropic, linearly elastic, brittle material.");
  material.set(
      "Young's Modulus", 30000.,
      "E [stress]. Its unit fixes the others: with lengths in mm and E in MPa, forces are in N and the fracture "
      "energy is in N/mm. Ten times E gives ten times the forces, and a fracture energy then belongs to a "
      "critical stretch smaller by the root of ten.",
      required(above(0.)));
  material.set(
      "Poisson's Ratio", 1. / 3.,
      "nu [-]. Bond-based peridynamics, with central forces between pairs of points, has one ratio only: 1/3 in "
      "plane stress, 1/4 in plane strain and in three dimensions. A value within 0.1 % of it (0.333) is taken as "
      "exactly that.",
      required(any_number()));
  material.set(
      "Elastic Model", "Plane Stress",
      "In two dimensions what is assumed across the thickness, which is 1 [length]: thin plates are in plane stress, "
      "long bodies in plane strain. In three dimensions nothing is: \"Three-Dimensional\".",
      required(one_of(words(elastic_models))));
  material.set(
      "Critical Stretch", 0.05,
      "s_crit [-]: a bond whose stretch |xi + u(p) - u(x)|/|xi| - 1 reaches it breaks for good [WHL19, eq. 6, 7]. "
      "Given the horizon and the characteristic length it follows from the fracture energy, so give one of the two; "
      "with neither, nothing breaks. Forces at failure are proportional to it. The strain at a crack's tip grows as "
      "elements get smaller, so with a fixed stretch a finer mesh breaks earlier.",
      optional(above(0.)));
  material.set(
      "Fracture Energy", 0.1,
      "G_c [force/length]: the energy per area of new crack. The critical stretch is derived from it, in two "
      "dimensions by G_c = s_crit^2 times the integral of c0(r) r^6 over r from 0 to the horizon, in three by pi/2 "
      "s_crit^2 times that of c0(r) r^7, so that it stays the same when the horizon or the characteristic length is "
      "changed. Data sheets give toughness K_c = sqrt(G_c "
      "E) in plane stress; K_c taken for G_c is wrong by orders of magnitude.",
      optional(above(0.)));
  material.set(
      "Calibration", "Mesh-Consistent",
      "How fracture energy and critical stretch belong together. \"Analytic\": by that integral. \"Mesh-Consistent\": "
      "the stretch is lowered by what the mesh itself holds a crack up, so that a crack runs at K = sqrt(G_c E) "
      "also with a characteristic length of a fifth to a half of an element; the factor depends on that length over "
      "the "
      "mean edge of the elements in the seeds, and on the two choices in Morphing. A given critical stretch stays as "
      "it is: then "
      "the fracture energy that is printed is greater. In three dimensions, where cracks are hardly held up, and with "
      "three points per direction it is as \"Analytic\".",
      one_of(words(calibrations)));
}

void declare_peridynamics(ParameterList& root) {
  ParameterList& peridynamics = section(root, "Peridynamics", "The nonlocal model inside the peridynamic zone.");
  peridynamics.set(
      "Horizon", 1.5,
      "delta [length]: the longest bond. Four element sizes, and twelve characteristic lengths, are a good choice; "
      "WHL19 takes three and fifteen. Much less leaves too few bonds, and cracks follow the mesh; more costs with its "
      "square, in three dimensions with its cube.",
      required(above(0.)));
  peridynamics.set("Micromodulus", "Exponential",
                   "Stiffness of a bond over its length: c0(xi) = tau0 exp(-|xi|/l) [WHL19, eq. 24]; tau0 follows from "
                   "Young's modulus [WHL19, eq. 17].",
                   one_of({"Exponential"}));
  peridynamics.set("Characteristic Length", 0.1,
                   "l [length] in the micromodulus, below the horizon. A third of the element size is a good choice; "
                   "with a fifth, as "
                   "in WHL19, cracks are held up between elements, by 30 %. From a ninth of the horizon on, the "
                   "horizon cuts the micromodulus off: the "
                   "body is too soft and the fracture energy falls short.",
                   required(above(0.)));
  peridynamics.set(
      "Points per Direction", 2,
      "Gauss points of a quadrilateral or hexahedron along each of its directions [-]: the material points that bonds "
      "join, and at which strains are taken. 2 or 3; of triangles then 3 or 6, of tetrahedra 4 or 11, of wedges 6 or "
      "18. 3 makes five "
      "times as many bonds, in three dimensions eleven times. With a characteristic length of a quarter of an element "
      "or "
      "less, cracks are then held up half as much; the calibration is as \"Analytic\".",
      either(2, 3));
}

void declare_seeds(ParameterList& morphing) {
  ParameterList& seeds =
      section(morphing, "Seeds",
              "The first peridynamic zones, each a list with a name of your choice. Put one wherever a "
              "crack may start: nothing breaks outside. Without any the body is classical throughout.");
  ParameterList& seed = section(seeds, "*", "One zone. The morphing function is 1 inside and falls to 0 around it.");
  seed.set(
      "Shape", "Circle",
      "\"Circle\" (two dimensions) and \"Sphere\" (three) take the center and the two radii, \"Cylinder\" (three) "
      "the ends of its axis and the two radii, \"Box\" the corners and the rim, \"Everything\" nothing. "
      "\"Automatic\" needs nothing, and takes the radii and the share: circles or spheres are put where the elastic "
      "body is stretched most (largest principal strain at the last increment's load) [WHL19, section 3.1]; the log "
      "tells where.",
      one_of(words(seed_shapes)));
  seed.set("Center", Numbers{{0., 0.}}, "Of a circle or sphere: x_0 [length].",
           optional(numbers("a point such as {1.5, 2}")));
  seed.set("Start", Numbers{{0., 0., 0.}},
           "Of a cylinder: one end of its axis [length]. Radii count from the axis, so that the ends are round, and "
           "reach a radius further.",
           optional(numbers("a point such as {1.5, 2, 0}")));
  seed.set("End", Numbers{{0., 0., 10.}}, "Of a cylinder: the other end of its axis [length].",
           optional(numbers("a point such as {1.5, 2, 0}")));
  seed.set(
      "Inner Radius", 4.,
      "Of a circle, sphere or cylinder: r_1 [length], up to which the morphing function is 1. Bonds break only where "
      "it is 1 all around, up to a horizon away: take at least two horizons, or hardly any bond can break. Of an "
      "automatic seed the Growth Inner Radius if not given.",
      optional(above(0.)));
  seed.set(
      "Outer Radius", 6.,
      "Of a circle, sphere or cylinder: r_2 [length], from which the morphing function is 0. A ring thinner than the "
      "horizon gives spurious forces where the models meet. Of an automatic seed twice the inner radius if not given.",
      optional(above(0.)));
  seed.set("Lower Corner", Numbers{{-4., -4.}}, "Of a box: its smallest coordinates [length].",
           optional(numbers("a point such as {1.5, 2}")));
  seed.set("Upper Corner", Numbers{{4., 4.}}, "Of a box: its largest coordinates [length].",
           optional(numbers("a point such as {1.5, 2}")));
  seed.set(
      "Share", 0.8,
      "Of an automatic seed [-]: each place that reaches this share of the largest strain, and where it is the largest "
      "up to the inner radius around, gets a circle, too. 0.8 if not given; less gives more zones, which cost "
      "bonds.",
      optional(between(0., 1.)));
  seed.set("Rim", 2., "Of a box: the width around it over which the morphing function falls from 1 to 0 [length].",
           optional(above(0.)));
}

void declare_morphing(ParameterList& root) {
  ParameterList& morphing = section(root, "Morphing", "Where the body is peridynamic, and how that zone grows.");
  morphing.set("Function", "Linear",
               "How the morphing function alpha falls from 1 to 0 across a zone's rim, with t from 0 to 1: 1 - t, or "
               "\"Cubic\" 1 - t^2 (3 - 2 t), smooth at both ends.",
               one_of(words(blending_functions)));
  morphing.set(
      "Discontinuous Elements", "On Damage",
      "Which peridynamic elements get nodes of their own: all of the zone (\"Whole Zone\", as WHL19 does), or only "
      "those with a broken bond or beside a pre-crack (\"On Damage\": fewer unknowns, and more accurate before "
      "fracture).",
      one_of(words(discontinuous_elements)));
  morphing.set(
      "Stiffness in Peridynamic Zone", "Dropped",
      "What becomes of the classical stiffness E(x) [WHL19, eq. 16] where all bonds are peridynamic: \"Dropped\", "
      "as WHL19 does, or \"Kept\" where bonds are missing at free surfaces, which are too soft otherwise: several "
      "times "
      "more accurate where nothing breaks, but cracks then start late and jump.",
      one_of(words(peridynamic_stiffnesses)));
  morphing.set("Growth Inner Radius", 2.,
               "r_i [horizons]: around the centroid of an element with a broken bond the zone grows to this radius "
               "[WHL19, eq. 23]. Below 1 a crack can reach the rim of its zone, where nothing breaks.",
               above(0.));
  morphing.set(
      "Growth Outer Radius", 4.,
      "r_o [horizons]: where the morphing function of such a new zone reaches 0. Too close to the inner radius, and "
      "the steep rim gives spurious forces; larger costs bonds.",
      above(0.));
  declare_seeds(morphing);
}

void declare_pre_cracks(ParameterList& root) {
  ParameterList& cracks = section(root, "Pre-Cracks",
                                  "Cracks without width that are there from the start, each a list with a name of your "
                                  "choice. No bond crosses one, and elements part along it.");
  ParameterList& crack = section(cracks, "*", "One crack.");
  crack.set("Shape", "Polyline",
            "\"Polyline\" (two dimensions) and \"Polygon\" (three; flat and convex) take the points, \"Disc\" (three) "
            "center, "
            "normal and radius.",
            one_of(words(pre_crack_shapes)));
  crack.set(
      "Points", Numbers{{0., 0., 10., 0.}},
      "Its corners {x1, y1, x2, y2, ...} [length], in three dimensions {x1, y1, z1, x2, ...}. Element edges, in three "
      "dimensions faces, should lie along it.",
      optional(numbers("{x1, y1, x2, y2, ...}")));
  crack.set("Center", Numbers{{0., 0., 0.}}, "Of a disc [length].", optional(numbers("a point such as {1.5, 2, 0}")));
  crack.set("Normal", Numbers{{0., 0., 1.}}, "Of a disc: the direction across it, of any length.",
            optional(numbers("a direction such as {0, 0, 1}")));
  crack.set("Radius", 5., "Of a disc [length].", optional(above(0.)));
}

void declare_displacements(ParameterList& conditions) {
  ParameterList& displacements =
      section(conditions, "Displacements",
              "Prescribed displacements, each a list with a name of your choice: one component "
              "of one group. In increment k it is Rate * k + Constant.");
  ParameterList& one = section(displacements, "*", "One component of one group.");
  one.set("Group", "left", "A physical group of the mesh.", required(text("the name of a group")));
  one.set("Component", "x", "The direction held or moved; the others stay free. z in three dimensions only.",
          required(one_of(words(components))));
  one.set("Rate", 0., "[length per increment]: what loads the body; 0 holds it. Its sign is that of the axis.",
          any_number());
  one.set("Constant", 0., "[length], there from the first increment on.", any_number());
}

void declare_boundary_conditions(ParameterList& root) {
  ParameterList& conditions = section(root, "Boundary Conditions", "What holds the body and what loads it.");
  declare_displacements(conditions);
  ParameterList& tractions =
      section(conditions, "Tractions",
              "Forces on parts of the boundary, each a list with a name of your choice. In increment "
              "k the traction is Rate * k + Constant.");
  ParameterList& one = section(tractions, "*", "The traction on one group.");
  one.set("Group", "right", "A physical group of the mesh: part of its boundary.",
          required(text("the name of a group")));
  one.set("Rate", Numbers(), "[stress per increment], one number per dimension; {} is zero.",
          numbers("{x, y} or {x, y, z}"));
  one.set("Constant", Numbers(), "[stress], one number per dimension; {} is zero.", numbers("{x, y} or {x, y, z}"));
  ParameterList& body = section(conditions, "Body Force", "Force per volume: Rate * k + Constant in increment k.");
  body.set("Rate", Numbers(), "[force/volume per increment], one number per dimension; {} is zero.",
           numbers("{x, y} or {x, y, z}"));
  body.set("Constant", Numbers(), "[force/volume], one number per dimension; {} is zero.",
           numbers("{x, y} or {x, y, z}"));
}

void declare_loading(ParameterList& root) {
  ParameterList& loading = section(root, "Loading", "How far to go, and when to give up.");
  loading.set(
      "Increments", 100,
      "Load steps k = 1, 2, ... up to this one. Before the first break they cost next to nothing. With few large "
      "ones the first break is known only to within a large step, and a crack that would grow slowly jumps.",
      required(count()));
  loading.set(
      "Maximum Damage Iterations", 20000,
      "Solutions within one increment, after which the run ends with status 3. An unstable crack takes hundreds to "
      "thousands.",
      count());
  loading.set(
      "Breaking Fraction", 1.,
      "Which share of the bonds past the critical stretch breaks before the body is solved for again, the worst first "
      "[-]. 1 breaks all of them, as WHL19 does. With less, bonds that the others would relieve are spared; an "
      "unstable "
      "crack takes so many more solutions.",
      share());
  loading.set("Maximum Zone Growths", 5000,
              "Growths of the peridynamic zone within one increment, after which the run ends with status 3.", count());
}

void declare_solver(ParameterList& root) {
  ParameterList& solver = section(root, "Solver", "Conjugate gradients with an algebraic multigrid preconditioner.");
  solver.set(
      "Operator", "Matrix-Free",
      "How the coupled stiffness is applied: \"CRS\" is an assembled sparse matrix; \"Matrix-Free\" pulls along "
      "every bond and strains every element anew, which moves several times fewer bytes. \"On-the-Fly\" also "
      "computes the stiffness of every bond anew, in single precision: a third of the memory for bonds and "
      "operator, while conjugate gradients take up to twice the time in three dimensions. For what would not fit "
      "otherwise.",
      one_of(words(operator_forms)));
  solver.set(
      "Preconditioner Matrix", "Short-Range",
      "What the multigrid preconditioner is built from: \"Coupled\" is the whole stiffness; \"Short-Range\" leaves out "
      "all bonds beyond the cut-off and stiffens the others: far fewer entries, a few more iterations.",
      one_of(words(preconditioner_matrices)));
  solver.set("Short-Range Cut-Off", operators::default_short_range_cut_off(2),
             fmt::format(
                 "Longest bond in the short-range matrix, in horizons [-]; {} in two dimensions and {} in three if not "
                 "given. Below the distance of points in neighbouring elements the preconditioner is useless.",
                 operators::default_short_range_cut_off(2), operators::default_short_range_cut_off(3)),
             optional(between(0., 1.)));
  solver.set(
      "Tolerance", 1e-6,
      "Residual over the norm of the reaction forces [-], in every solution that is accepted. Only with it is it "
      "decided that no more bonds break.",
      between(0., 1.));
  solver.set(
      "Damage Tolerance", 1e-4,
      "The same as Tolerance, in solutions after which bonds break [-]; not below Tolerance. Too loose, and bonds "
      "break in another order.",
      between(0., 1.));
  solver.set(
      "Maximum Iterations", 500,
      "Of conjugate gradients in one solution. When they do not suffice, the system is tried twice more with other "
      "preconditioners; then the run ends with status 3. Far below 100 it may end although nothing is wrong.",
      count());
  solver.set("Renewal Cost", 12.,
             "The preconditioner is renewed when, since its last set-up, solutions have taken so many iterations more "
             "than they would have with a new one [-]: what a set-up costs, in iterations.",
             at_least(0.));
  solver.set(
      "Largest Imbalance", 1.25,
      "Elements are parted among the ranks by their number of bonds, and anew when the zone has grown and one rank has "
      "more than so many times the mean of the work [-]. Near 1 it costs more than it saves.",
      at_least(1.));
  section(solver, "Belos", "Any parameters of Belos, handed on as they are, over the program's own.");
  section(
      solver, "MueLu",
      "Any parameters of MueLu, handed on as they are, over the program's own. The W-cycle and its smoother are ours.");
}

void declare_probes(ParameterList& output) {
  ParameterList& probes =
      section(output, "Probes",
              "Points and lines at which displacement and stress are recorded in probes.csv, each a "
              "list with a name of your choice: a row for each increment and place.");
  ParameterList& probe = section(probes, "*", "One probe. All its places must be in the body.");
  probe.set("Points", Numbers{{0., 0., 10., 0.}},
            "A point, or the corners of a line {x1, y1, x2, y2, ...} [length]. On a side that elements share, the "
            "values are those of the element with the lowest number.",
            required(numbers("{x1, y1, x2, y2, ...}")));
  probe.set("Divisions", 1,
            "Into how many equal parts each segment between a point and the next is divided; there is a place at every "
            "end of a part. 1 is the points themselves.",
            count());
}

void declare_output(ParameterList& root) {
  ParameterList& output = section(root, "Output", "What is written, into the folder given by --output.");
  output.set(
      "Every", 1,
      "Fields are written every so many increments; those with a break and the last one are written anyway. 1 shows "
      "everything and may fill the disk in large runs.",
      count());
  output.set(
      "Spread Files", false,
      "Whether each process writes the fields of its own elements, to case.e.N.0 up to case.e.N.<N-1> on N processes, "
      "instead of one that gathers and writes all. For bodies that do not fit into the memory of one; tools/join makes "
      "one file of them.",
      flag());
  output.set(
      "Checkpoint Every", 0,
      "A checkpoint is written every so many increments; 0 is never. The run goes on from each of them as one that "
      "is continued with --restart: on the same number of processes with the same bits. It takes a second per "
      "million elements and a set-up of the preconditioner.",
      whole_number());
  output.set(
      "Checkpoint Minutes", 10.,
      "A checkpoint is written when the last one is so many minutes old and an increment is accepted; 0 is never. "
      "The end of the run, an error with status 3, SIGTERM, SIGINT and SIGUSR1 write one anyway. The last two are "
      "kept.",
      at_least(0.));
  output.set(
      "Reactions", Texts(),
      "Groups whose reaction force is recorded in history.csv; {} means each group with a prescribed displacement.",
      names("a list of groups such as {left, right}"));
  output.set(
      "Crack", false,
      "Whether the crack is recorded: in crack.csv its length for each increment, in crack_path.csv the sides of "
      "elements that open in it. A side is open when more than half of the bonds between its two elements are broken. "
      "The length is that of the open sides, and also of these projected onto the mean line of all open sides within "
      "a horizon, which takes out the stairs of a slanting crack. Pre-cracks do not count.",
      flag());
  output.set("Bonds", Teuchos::Array<int>(),
             "Increments after which all bonds are written, to bonds-<increment>.vtp for ParaView: positions, stretch, "
             "broken or not. 60 bytes for each bond.",
             increments("a list of increments such as {10, 20}"));
  declare_probes(output);
}

}  // namespace

ParameterList case_schema() {
  ParameterList root("perimorph");
  declare_general(root);
  declare_material(root);
  declare_peridynamics(root);
  declare_morphing(root);
  declare_pre_cracks(root);
  declare_boundary_conditions(root);
  declare_loading(root);
  declare_solver(root);
  declare_output(root);
  return root;
}

}  // namespace perimorph::fracture
