#include "sliced_file.hpp"

#include "exodus_file.hpp"
#include "gmsh_file.hpp"
#include "mesh_format.hpp"
#include "perimorph/base/errors.hpp"

namespace perimorph::mesh_files {

namespace {

/// As rank 0 sees it. Collective.
MeshFormat agreed_format(const base::Comm& comm, const std::string& file) {
  MeshFormat format = MeshFormat::unknown;
  base::on_all_ranks(comm, [&] {
    if (comm.getRank() == 0) format = format_of(file);
  });
  return static_cast<MeshFormat>(base::max(comm, static_cast<base::GlobalId>(format)));
}

}  // namespace

bool can_be_sliced(const std::string& file) {
  const MeshFormat format = format_of(file);
  return format == MeshFormat::exodus || format == MeshFormat::gmsh;
}

MeshFile read_slice(const base::Comm& comm, const std::string& file) {
  const MeshFormat format = agreed_format(comm, file);
  if (format == MeshFormat::exodus) return read_exodus_file(comm, file);
  PERIMORPH_ASSERT(format == MeshFormat::gmsh, "{} is of a format that cannot be sliced", file);
  return read_gmsh_file(comm, file);
}

}  // namespace perimorph::mesh_files
