#include "perimorph/mesh/mesh.hpp"

#include <algorithm>
#include <tuple>

#include "perimorph/mesh/sorted_sides.hpp"
#include "topology.hpp"

namespace perimorph::mesh {

template <int dim>
Point<dim> centroid(const Mesh<dim>& mesh, int element) {
  const int n = mesh.n_corners(element);
  Point<dim> sum = Point<dim>::Zero();
  for (int c = 0; c < n; ++c) sum += mesh.coordinates[mesh.corners_of(element)[c]];
  return sum / n;
}

template <int dim>
double radius(const Mesh<dim>& mesh, int element) {
  const Point<dim> center = centroid(mesh, element);
  double largest = 0.;
  for (int c = 0; c < mesh.n_corners(element); ++c) {
    largest = std::max(largest, (mesh.coordinates[mesh.corners_of(element)[c]] - center).norm());
  }
  return largest;
}

template <int dim>
std::vector<int> side_nodes(const Mesh<dim>& mesh, const Side& side) {
  std::vector<int> nodes;
  for (const int corner : sides(mesh.types[side.element])[side.side]) {
    nodes.push_back(mesh.corners_of(side.element)[corner]);
  }
  return nodes;
}

template <int dim>
std::vector<Point<dim>> corner_points(const Mesh<dim>& mesh, const Side& side) {
  std::vector<Point<dim>> points;
  for (const int node : side_nodes(mesh, side)) points.push_back(mesh.coordinates[node]);
  return points;
}

template <int dim>
double mean_edge(const Mesh<dim>& mesh) {
  double sum = 0.;
  long count = 0;
  for (int e = 0; e < mesh.n_elements(); ++e) {
    const shards::CellTopology element = topology(mesh.types[e]);
    const int* nodes = mesh.corners_of(e);
    for (unsigned edge = 0; edge < element.getEdgeCount(); ++edge) {
      const int first = nodes[element.getNodeMap(1, edge, 0)], second = nodes[element.getNodeMap(1, edge, 1)];
      sum += (mesh.coordinates[first] - mesh.coordinates[second]).norm();
    }
    count += element.getEdgeCount();
  }
  return count == 0 ? 0. : sum / static_cast<double>(count);
}

SideKey side_key(const std::vector<int>& nodes) {
  SideKey key = {-1, -1, -1, -1};
  std::copy(nodes.begin(), nodes.end(), key.begin());
  std::sort(key.begin(), key.end());
  return key;
}

template <int dim>
std::vector<KeyedSide> sorted_sides(const Mesh<dim>& mesh) {
  std::vector<KeyedSide> all;
  for (int e = 0; e < mesh.n_elements(); ++e) {
    const int n_sides = static_cast<int>(sides(mesh.types[e]).size());
    for (int s = 0; s < n_sides; ++s) all.push_back({side_key(side_nodes(mesh, {e, s})), {e, s}});
  }
  std::sort(all.begin(), all.end(), [](const KeyedSide& a, const KeyedSide& b) {
    return std::tie(a.key, a.side.element, a.side.side) < std::tie(b.key, b.side.element, b.side.side);
  });
  return all;
}

template <int dim>
void find_boundary(Mesh<dim>& mesh) {
  const std::vector<KeyedSide> all = sorted_sides(mesh);
  mesh.boundary.clear();
  for (std::size_t first = 0, next = 0; first < all.size(); first = next) {
    for (next = first + 1; next < all.size() && all[next].key == all[first].key;) ++next;
    if (next == first + 1) mesh.boundary.push_back(all[first].side);
  }
  std::sort(mesh.boundary.begin(), mesh.boundary.end());
}

#define PERIMORPH_INSTANTIATE(dim)                                               \
  template Point<dim> centroid(const Mesh<dim>&, int);                           \
  template double radius(const Mesh<dim>&, int);                                 \
  template std::vector<Point<dim>> corner_points(const Mesh<dim>&, const Side&); \
  template double mean_edge(const Mesh<dim>&);                                   \
  template void find_boundary(Mesh<dim>&);                                       \
  template std::vector<int> side_nodes(const Mesh<dim>&, const Side&);           \
  template std::vector<KeyedSide> sorted_sides(const Mesh<dim>&);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::mesh
