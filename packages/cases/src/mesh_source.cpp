#include "perimorph/cases/mesh_source.hpp"

#include "perimorph/mesh_files/read_mesh.hpp"

namespace perimorph::cases {

namespace {

std::vector<std::string> geometry_and_mesh_endings() {
  std::vector<std::string> endings = mesh_files::mesh_file_endings();
  endings.insert(endings.begin(), ".geo");
  return endings;
}

}  // namespace

void declare(const input::Section& section, MeshSource& mesh) {
  section.changeable().required("File", mesh.file, "plate.geo", input::file_name(geometry_and_mesh_endings()),
                                "gmsh geometry (.geo, meshed on the way and kept), or mesh of gmsh (.msh), Exodus (.e, "
                                ".exo) or ANSYS (.cdb, blocked archive), relative to the case file's folder. Its "
                                "physical groups, sets or components are the names that boundary conditions refer to.");
  section.parameter("Scale", mesh.scale, input::above(0.),
                    "Factor on the coordinates in that file [-]: 1000 for a mesh in m and a case in mm. All lengths in "
                    "the case are those after scaling.");
}

}  // namespace perimorph::cases
