#include "perimorph/cases/mesh_source.hpp"

#include <fmt/format.h>

#include "perimorph/mesh/refinement.hpp"

namespace perimorph::cases {

namespace {

constexpr int most_levels = 8;
static_assert(most_levels <= mesh::max_levels);

void declare_refinement(const input::Section& section, model::RefinementOptions& refinement) {
  section.parameter(
      "Levels", refinement.levels, input::whole_number(),
      fmt::format("How often elements are divided, each edge in half, where the body is peridynamic or soon will be: "
                  "triangles and quadrilaterals into four each time, tetrahedra and hexahedra into eight; at most {}. "
                  "Horizon and characteristic length must suit these finest elements. 0: the mesh stays as it is.",
                  most_levels));
  section.parameter("Margin", refinement.margin, input::at_least(2.),
                    "How far elements are finest beyond the reach of bonds, in finest elements [-].");
  section.parameter("Grading", refinement.grading, input::at_least(1.),
                    "Farther away, an element may be as large as its distance from the finest ones over this [-], and "
                    "no larger than those of the mesh in the file.");
  section.parameter("Groups", refinement.groups, input::names("names of groups"),
                    "Groups of the mesh around whose nodes, and edges between them, elements are finest, too: supports "
                    "and loads at points, or along lines in three dimensions, give way as much as elements there do.");
  section.parameter("Look-Ahead", refinement.look_ahead, input::at_least(0.),
                    "How much farther elements are made finest around a crack that has come near to larger ones, in "
                    "finest elements [-]: with more, the mesh is refined less often, and is larger.");
}

void check_refinement(const input::Values& section) {
  const int* levels = section.count("Levels");
  if (levels == nullptr) return;
  if (*levels > most_levels) {
    section.mistake("Levels", fmt::format("found {}; allowed is a whole number up to {}", *levels, most_levels));
  }
  if (*levels > 0) return;
  const model::RefinementOptions defaults;  // which resolved.xml of any case has
  const auto refuse = [&](const char* name) {
    section.mistake(name, "found with \"Levels\" = 0, where it has no effect; allowed is it with 1 or more");
  };
  for (const auto& [name, value] :
       {std::pair("Margin", defaults.margin), {"Grading", defaults.grading}, {"Look-Ahead", defaults.look_ahead}}) {
    const double* given = section.number(name);
    if (given != nullptr && *given != value) refuse(name);
  }
  if (const auto* groups = section.texts("Groups"); groups != nullptr && !groups->empty()) refuse("Groups");
}

}  // namespace

void declare(const input::Section& section, MeshSource& mesh, model::NumericalOptions& numerical) {
  section.changeable().required(
      "File", mesh.file, "plate.geo", input::file_name(),
      "gmsh geometry (.geo, meshed on the way and kept), or mesh of gmsh (.msh), Exodus (.e, .exo, .g, ...), ANSYS "
      "(.cdb, blocked archive) or Abaqus (.inp), recognized by its content; relative to the case file's folder. Its "
      "physical groups, sets, surfaces or components are the names that boundary conditions refer to.");
  section.parameter("Scale", mesh.scale, input::above(0.),
                    "Factor on the coordinates in that file [-]: 1000 for a mesh in m and a case in mm. All lengths in "
                    "the case are those after scaling.");
  section.optional(
      "Thickness", mesh.thickness, 1., input::above(0.),
      "Of the body in two dimensions [length]; 1 if it is not given. Forces and energies in the results are "
      "those of the whole thickness; nothing else depends on it, since loads are stresses.");
  section.changeable().parameter(
      "Maximum Meshing Minutes", mesh.meshing.minutes, input::above(0.),
      "How long gmsh may take to mesh a geometry (.geo) [min]; then it is ended, and the case refused.");
  section.parameter(
      "Perturbation", numerical.refinement.perturbation, input::at_least(0.),
      "By how much of its shortest edge an inner node of the finest elements may be moved along each axis [-], at "
      "random but always alike; at most 0.4. Along rows of a regular mesh cracks run too easily or are held up; an "
      "irregular one has no direction. Nodes of groups, boundaries and pre-cracks, and between blocks, stay; without "
      "Refinement all elements are finest ones.");
  declare_refinement(section.section("Refinement",
                                     "Elements become finer by themselves where the peridynamic zone is, and follow "
                                     "it. Displacements stay continuous where sizes meet."),
                     numerical.refinement);
}

void check_mesh_source(const input::Values& section, int dimension) {
  constexpr double largest_perturbation = 0.4;
  const double* perturbation = section.number("Perturbation");
  if (perturbation != nullptr && *perturbation > largest_perturbation) {
    section.mistake("Perturbation",
                    fmt::format("found {}; allowed is 0 up to {}", *perturbation, largest_perturbation));
  }
  check_refinement(section.sub("Refinement"));
  if (dimension == 2 || !section.given("Thickness")) return;
  section.mistake("Thickness", "found in three dimensions; allowed is it with \"Dimension\" = 2");
}

}  // namespace perimorph::cases
