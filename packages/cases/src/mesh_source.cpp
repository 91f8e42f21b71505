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
  section.changeable().parameter(
      "Maximum Meshing Minutes", mesh.meshing.minutes, input::above(0.),
      "How long gmsh may take to mesh a geometry (.geo) [min]; then it is ended, and the case refused.");
}

}  // namespace perimorph::cases
