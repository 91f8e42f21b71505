#include "perimorph/mesh_files/read_mesh.hpp"

#include <filesystem>

#include "ansys_file.hpp"
#include "exodus_file.hpp"
#include "gmsh_file.hpp"
#include "mesh_builder.hpp"
#include "perimorph/base/errors.hpp"
#include "perimorph/base/text.hpp"
#include "perimorph/mesh_files/gmsh.hpp"

namespace perimorph::mesh_files {

using mesh::Mesh;

namespace {

using Reader = MeshFile (*)(const std::string&);

const std::map<std::string, Reader> readers = {
    {".msh", read_gmsh_file}, {".e", read_exodus_file}, {".exo", read_exodus_file}, {".cdb", read_ansys_file}};

}  // namespace

const std::vector<std::string>& mesh_file_endings() {
  static const std::vector<std::string> endings = [] {
    std::vector<std::string> all;
    for (const auto& reader : readers) all.push_back(reader.first);
    return all;
  }();
  return endings;
}

template <int dim>
Mesh<dim> read_mesh(const std::string& file, double scale) {
  const std::string ending = std::filesystem::path(file).extension();
  const auto reader = readers.find(ending);
  if (reader == readers.end()) {
    throw base::UserError(fmt::format("{}: found the ending \"{}\"; a mesh file ends in one of {}", file, ending,
                                      base::quoted_list(mesh_file_endings())));
  }
  return build_mesh<dim>(reader->second(file), scale);
}

template <int dim>
Mesh<dim> mesh_and_read(const std::string& file, const std::string& folder, double scale) {
  const std::filesystem::path path(file);
  if (path.extension() != ".geo") return read_mesh<dim>(file, scale);
  const std::string meshed = (std::filesystem::path(folder) / path.stem()).string() + ".msh";
  mesh_geometry(file, meshed, dim);
  return read_mesh<dim>(meshed, scale);
}

template Mesh<2> read_mesh(const std::string&, double);
template Mesh<3> read_mesh(const std::string&, double);
template Mesh<2> mesh_and_read(const std::string&, const std::string&, double);
template Mesh<3> mesh_and_read(const std::string&, const std::string&, double);

}  // namespace perimorph::mesh_files
