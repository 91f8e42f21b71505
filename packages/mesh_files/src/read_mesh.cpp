#include "perimorph/mesh_files/read_mesh.hpp"

#include <filesystem>

#include "abaqus_file.hpp"
#include "ansys_file.hpp"
#include "exodus_file.hpp"
#include "file_cursor.hpp"
#include "geometry_script.hpp"
#include "gmsh_file.hpp"
#include "mesh_builder.hpp"
#include "mesh_format.hpp"
#include "perimorph/base/errors.hpp"

namespace perimorph::mesh_files {

using mesh::Mesh;

namespace {

MeshFile read_file(const std::string& file) {
  switch (format_of(file)) {
    case MeshFormat::gmsh:
      return read_gmsh_file(file);
    case MeshFormat::exodus:
      return read_exodus_file(file);
    case MeshFormat::ansys:
      return read_ansys_file(file);
    case MeshFormat::abaqus:
      return read_abaqus_file(file);
    case MeshFormat::unknown:
      break;
  }
  require_regular_file(file, "a mesh");
  throw base::UserError(file +
                        ": neither its content nor its ending is that of a mesh; allowed are geometries of gmsh (.geo) "
                        "and meshes of gmsh (.msh), Exodus (.e, .exo, .g), ANSYS (.cdb) and Abaqus (.inp)");
}

/// What gmsh made of a geometry, in the geometry's name.
MeshFile read_meshed_geometry(const std::string& meshed, const std::string& geometry) {
  MeshFile file;
  try {
    file = read_gmsh_file(meshed);
  } catch (const base::UserError& error) {
    const std::string message = error.what();
    throw base::UserError(geometry + ": what gmsh makes of it cannot be read" +
                          (message.rfind(meshed, 0) == 0 ? message.substr(meshed.size()) : ": " + message));
  }
  file.name = geometry;
  file.advice =
      "put what is to be computed into a Physical Surface (2D) or Physical Volume (3D), and look whether it has "
      "one in the geometry";
  return file;
}

}  // namespace

template <int dim>
Mesh<dim> read_mesh(const std::string& file, double scale) {
  return build_mesh<dim>(read_file(file), scale);
}

template <int dim>
Mesh<dim> mesh_and_read(const std::string& file, const std::string& folder, double scale, const MeshingLimits& limits) {
  const std::filesystem::path path(file);
  if (!is_geometry(file)) return read_mesh<dim>(file, scale);
  const std::string meshed = (std::filesystem::path(folder) / path.stem()).string() + ".msh";
  mesh_geometry(file, meshed, dim, limits);
  MeshFile mesh = read_meshed_geometry(meshed, file);
  for (const std::string& command : undone_commands(file)) {
    mesh.notes.push_back(fmt::format("{} has no effect: the geometry is meshed again after all its commands", command));
  }
  return build_mesh<dim>(mesh, scale);
}

template Mesh<2> read_mesh(const std::string&, double);
template Mesh<3> read_mesh(const std::string&, double);
template Mesh<2> mesh_and_read(const std::string&, const std::string&, double, const MeshingLimits&);
template Mesh<3> mesh_and_read(const std::string&, const std::string&, double, const MeshingLimits&);

}  // namespace perimorph::mesh_files
