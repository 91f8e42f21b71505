#include "perimorph/cases/mesh_source.hpp"

namespace perimorph::cases {

void declare(const input::Section& section, MeshSource& mesh) {
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
}

void check_mesh_source(const input::Values& section, int dimension) {
  if (dimension == 2 || !section.given("Thickness")) return;
  section.mistake("Thickness", "found in three dimensions; allowed is it with \"Dimension\" = 2");
}

}  // namespace perimorph::cases
