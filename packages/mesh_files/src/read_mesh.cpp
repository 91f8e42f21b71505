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
#include "perimorph/mesh/distribute.hpp"
#include "sliced_file.hpp"

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

/// Where the mesh of a geometry is kept.
std::string meshed_file(const std::string& geometry, const std::string& folder) {
  return (std::filesystem::path(folder) / std::filesystem::path(geometry).stem()).string() + ".msh";
}

/// What gmsh made of a geometry, in the geometry's name.
/// @param read what a file says, or this rank's slice of it
template <class Read>
MeshFile read_meshed_geometry(const std::string& meshed, const std::string& geometry, Read read) {
  MeshFile file;
  try {
    file = read(meshed);
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

void note_undone_commands(const std::string& geometry, MeshFile& mesh) {
  for (const std::string& command : undone_commands(geometry)) {
    mesh.notes.push_back(fmt::format("{} has no effect: the geometry is meshed again after all its commands", command));
  }
}

}  // namespace

template <int dim>
Mesh<dim> read_mesh(const std::string& file, double scale) {
  return build_mesh<dim>(read_file(file), scale);
}

template <int dim>
Mesh<dim> mesh_and_read(const std::string& file, const std::string& folder, double scale, const MeshingLimits& limits) {
  if (!is_geometry(file)) return read_mesh<dim>(file, scale);
  const std::string meshed = meshed_file(file, folder);
  mesh_geometry(file, meshed, dim, limits);
  MeshFile mesh = read_meshed_geometry(meshed, file, [](const std::string& name) { return read_gmsh_file(name); });
  note_undone_commands(file, mesh);
  return build_mesh<dim>(mesh, scale);
}

template <int dim>
Mesh<dim> mesh_and_read_parts(const base::Comm& comm, const std::string& file, const std::string& folder, double scale,
                              const MeshingLimits& limits) {
  const bool is_meshed = is_geometry(file);
  const std::string readable = is_meshed ? meshed_file(file, folder) : file;
  bool is_sliced = false;
  base::on_all_ranks(comm, [&] {
    if (comm.getRank() != 0) return;
    if (is_meshed) mesh_geometry(file, readable, dim, limits);
    is_sliced = can_be_sliced(readable);
  });
  is_sliced = base::max(comm, static_cast<base::GlobalId>(is_sliced)) > 0;
  if (!is_sliced) {
    Mesh<dim> whole;
    base::on_all_ranks(comm, [&] {
      if (comm.getRank() == 0) whole = read_mesh<dim>(file, scale);
    });
    return mesh::distribute(comm, whole, 0.);
  }
  const auto slice_of = [&](const std::string& name) { return read_slice(comm, name); };
  MeshFile slice = is_meshed ? read_meshed_geometry(readable, file, slice_of) : slice_of(file);
  base::on_all_ranks(comm, [&] {
    if (is_meshed && comm.getRank() == 0) note_undone_commands(file, slice);
  });
  return build_parts<dim>(comm, slice, scale);
}

#define PERIMORPH_INSTANTIATE(dim)                                                                          \
  template Mesh<dim> read_mesh(const std::string&, double);                                                 \
  template Mesh<dim> mesh_and_read(const std::string&, const std::string&, double, const MeshingLimits&);   \
  template Mesh<dim> mesh_and_read_parts(const base::Comm&, const std::string&, const std::string&, double, \
                                         const MeshingLimits&);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::mesh_files
