#include "perimorph/cases/geometry.hpp"

#include "perimorph/base/errors.hpp"
#include "perimorph/mesh_files/read_mesh.hpp"

namespace perimorph::cases {

using base::Point;

namespace {

template <int dim>
std::vector<mesh::CrackFacet<dim>> facets_of(const PreCrack& crack) {
  std::vector<Point<dim>> corners;
  for (std::size_t i = 0; i < crack.points.size(); i += dim) corners.push_back(point<dim>(crack.points, i));
  if constexpr (dim == 2) {
    return mesh::polyline(corners);
  } else {
    return crack.shape == PreCrackShape::polygon
               ? mesh::polygon(corners)
               : mesh::disc(point<dim>(crack.center), point<dim>(crack.normal), crack.radius);
  }
}

}  // namespace

template <int dim>
morphing::Zone<dim> zone_of(const Seed& seed) {
  using Zone = morphing::Zone<dim>;
  switch (seed.shape) {
    case SeedShape::ball:
      return Zone::ball(point<dim>(seed.center), seed.inner_radius, seed.outer_radius);
    case SeedShape::cylinder:
      return Zone::cylinder(point<dim>(seed.start), point<dim>(seed.end), seed.inner_radius, seed.outer_radius);
    case SeedShape::box:
      return Zone::box(point<dim>(seed.lower_corner), point<dim>(seed.upper_corner), seed.rim);
    case SeedShape::everything:
      return Zone::everything();
    case SeedShape::automatic:
      break;
  }
  throw base::Bug("a seed without a place has no zone");
}

template <int dim>
std::vector<mesh::CrackFacet<dim>> facets_of(const std::vector<PreCrack>& cracks) {
  std::vector<mesh::CrackFacet<dim>> all;
  for (const auto& crack : cracks) {
    for (const auto& facet : facets_of<dim>(crack)) all.push_back(facet);
  }
  return all;
}

template <int dim>
std::vector<Point<dim>> places_of(const Probe& probe) {
  PERIMORPH_ASSERT(probe.divisions >= 1, "{}: {} divisions", probe.name, probe.divisions);
  const auto corner = [&](std::size_t k) { return point<dim>(probe.points, k * dim); };
  std::vector<Point<dim>> places;
  for (std::size_t k = 0; (k + 2) * dim <= probe.points.size(); ++k) {
    for (int i = 0; i < probe.divisions; ++i) {
      places.push_back(corner(k) + (corner(k + 1) - corner(k)) * i / probe.divisions);
    }
  }
  places.push_back(corner(probe.points.size() / dim - 1));
  return places;
}

template <int dim>
mesh::Mesh<dim> read_closed_mesh(const Case& input, const std::string& folder) {
  return mesh_files::mesh_and_read<dim>(input.mesh.file, folder, input.mesh.scale, input.mesh.meshing);
}

template <int dim>
mesh::Mesh<dim> read_closed_parts(const base::Comm& comm, const Case& input, const std::string& folder) {
  return mesh_files::mesh_and_read_parts<dim>(comm, input.mesh.file, folder, input.mesh.scale, input.mesh.meshing);
}

#define PERIMORPH_INSTANTIATE(dim)                                                          \
  template morphing::Zone<dim> zone_of<dim>(const Seed&);                                   \
  template std::vector<mesh::CrackFacet<dim>> facets_of<dim>(const std::vector<PreCrack>&); \
  template std::vector<Point<dim>> places_of<dim>(const Probe&);                            \
  template mesh::Mesh<dim> read_closed_mesh<dim>(const Case&, const std::string&);          \
  template mesh::Mesh<dim> read_closed_parts<dim>(const base::Comm&, const Case&, const std::string&);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::cases
