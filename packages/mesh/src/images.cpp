#include "perimorph/mesh/images.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "perimorph/mesh/extent.hpp"

namespace perimorph::mesh {

namespace {

constexpr double tolerance = 1e-6;  // of the body's size

/// A reflection across one or more planes.
template <int dim>
class Reflection {
 public:
  /// @param code bit p stands for plane p
  Reflection(const std::vector<SymmetryPlane>& planes, unsigned code) {
    for (std::size_t p = 0; p < planes.size(); ++p) {
      if ((code >> p & 1u) == 0) continue;
      signs_[planes[p].axis] = -1.;
      shift_[planes[p].axis] = 2. * planes[p].place;
      planes_.push_back(&planes[p]);
    }
  }

  const Point<dim>& signs() const { return signs_; }
  Point<dim> operator()(const Point<dim>& x) const { return shift_ + signs_.cwiseProduct(x); }

  /// Whether all of its planes have the node on them.
  bool keeps(int node) const {
    return std::all_of(planes_.begin(), planes_.end(), [&](const SymmetryPlane* plane) {
      return std::binary_search(plane->nodes.begin(), plane->nodes.end(), node);
    });
  }

  /// Whether an element comes as near as that to all of its planes.
  bool is_near(const Mesh<dim>& mesh, int element, double width) const {
    const int* corners = mesh.corners_of(element);
    return std::all_of(planes_.begin(), planes_.end(), [&](const SymmetryPlane* plane) {
      return std::any_of(corners, corners + mesh.n_corners(element), [&](int node) {
        return std::abs(mesh.coordinates[node][plane->axis] - plane->place) <= width;
      });
    });
  }

 private:
  Point<dim> signs_ = Point<dim>::Ones(), shift_ = Point<dim>::Zero();
  std::vector<const SymmetryPlane*> planes_;
};

/// Adds the images of the body's elements across some of the planes.
template <int dim>
void add_images_across(Mesh<dim>& mesh, unsigned code, int n_real_elements, double width) {
  const Reflection<dim> reflection(mesh.symmetry_planes, code);
  std::vector<int> image_of(mesh.n_nodes(), -1);
  const auto image = [&](int node) {
    if (reflection.keeps(node)) return node;
    if (image_of[node] >= 0) return image_of[node];
    mesh.coordinates.push_back(reflection(mesh.coordinates[node]));
    mesh.node_ids.push_back(mesh.node_ids[node] + code * mesh.n_global_nodes);
    mesh.node_owners.push_back(mesh.node_owners[node]);
    return image_of[node] = mesh.n_nodes() - 1;
  };
  for (int e = 0; e < n_real_elements; ++e) {
    if (!reflection.is_near(mesh, e, width)) continue;
    mesh.images.push_back({e, reflection.signs()});
    mesh.types.push_back(mesh.types[e]);
    mesh.blocks.push_back(mesh.blocks[e]);
    mesh.element_ids.push_back(mesh.element_ids[e] + code * mesh.n_global_elements);
    mesh.element_owners.push_back(mesh.element_owners[e]);
    for (int c = mesh.first_corner[e]; c < mesh.first_corner[e + 1]; ++c) {
      mesh.corners.push_back(image(mesh.corners[c]));
    }
    mesh.first_corner.push_back(static_cast<int>(mesh.corners.size()));
  }
}

template <int dim>
bool is_on_a_plane(const Mesh<dim>& mesh, const Side& side) {
  const auto& corners = sides(mesh.types[side.element])[side.side];
  return std::any_of(mesh.symmetry_planes.begin(), mesh.symmetry_planes.end(), [&](const SymmetryPlane& plane) {
    return std::all_of(corners.begin(), corners.end(), [&](int corner) {
      const int node = mesh.corners_of(side.element)[corner];
      return std::binary_search(plane.nodes.begin(), plane.nodes.end(), node);
    });
  });
}

/// The boundary of the body and its images: the planes are in its inside.
template <int dim>
void mirror_boundary(Mesh<dim>& mesh) {
  auto& boundary = mesh.boundary;
  boundary.erase(
      std::remove_if(boundary.begin(), boundary.end(), [&](const Side& side) { return is_on_a_plane(mesh, side); }),
      boundary.end());
  std::vector<std::vector<int>> sides_of(mesh.n_real_elements());
  for (const auto& [element, side] : boundary) sides_of[element].push_back(side);
  for (int e = mesh.n_real_elements(); e < mesh.n_elements(); ++e) {
    for (const int side : sides_of[mesh.image(e).element]) boundary.push_back({e, side});
  }
}

}  // namespace

template <int dim>
SymmetryPlane symmetry_plane(const base::Comm& comm, const Mesh<dim>& mesh, const std::string& node_set) {
  const auto& nodes = mesh.node_sets.at(node_set);
  std::vector<int> all(mesh.n_nodes());
  for (int n = 0; n < mesh.n_nodes(); ++n) all[n] = n;
  const auto body = box_around(comm, mesh, all), group = box_around(comm, mesh, nodes);
  const double slack = tolerance * body.diagonal().norm();
  int axis = 0;
  group.sizes().minCoeff(&axis);
  if (group.isEmpty() || (group.sizes().array() <= slack).count() != 1) {
    throw base::UserError(
        fmt::format("the group \"{}\" is no plane of symmetry: allowed are nodes on one plane across an axis, and not "
                    "all on a line",
                    node_set));
  }
  const double place = group.min()[axis];
  if (place > body.min()[axis] + slack && place < body.max()[axis] - slack) {
    throw base::UserError(
        fmt::format("the group \"{}\" is no plane of symmetry: the body is on both of its sides, from {:.6g} to {:.6g} "
                    "around {:.6g}; allowed is one",
                    node_set, body.min()[axis], body.max()[axis], place));
  }
  return {axis, place, nodes};
}

template <int dim>
void add_images(Mesh<dim>& mesh, std::vector<SymmetryPlane> planes, double width) {
  PERIMORPH_ASSERT(mesh.images.empty() && width >= 0., "{} images already, a width of {}", mesh.images.size(), width);
  if (planes.empty()) return;
  std::swap(mesh.symmetry_planes, planes);
  const int n_real_elements = mesh.n_elements();
  for (unsigned code = 1; code < 1u << mesh.symmetry_planes.size(); ++code) {
    add_images_across(mesh, code, n_real_elements, (1. + tolerance) * width);
  }
  mirror_boundary(mesh);
}

template <int dim>
std::vector<CrackFacet<dim>> with_images(const std::vector<CrackFacet<dim>>& facets,
                                         const std::vector<SymmetryPlane>& planes) {
  auto all = facets;
  for (unsigned code = 1; code < 1u << planes.size(); ++code) {
    const Reflection<dim> reflection(planes, code);
    for (auto facet : facets) {
      for (auto& corner : facet) corner = reflection(corner);
      all.push_back(facet);
    }
  }
  return all;
}

#define PERIMORPH_INSTANTIATE(dim)                                                                \
  template SymmetryPlane symmetry_plane(const base::Comm&, const Mesh<dim>&, const std::string&); \
  template void add_images(Mesh<dim>&, std::vector<SymmetryPlane>, double);                       \
  template std::vector<CrackFacet<dim>> with_images<dim>(const std::vector<CrackFacet<dim>>&,     \
                                                         const std::vector<SymmetryPlane>&);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::mesh
