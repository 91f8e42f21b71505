#include "repeated_nodes.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "perimorph/base/errors.hpp"

namespace perimorph::mesh_files {

namespace {

using Ring =
    std::vector<int>;  // of places in the element's list of nodes; a node's place is the first at which it stands

std::size_t n_different(const Ring& ring) { return std::set<int>(ring.begin(), ring.end()).size(); }

/// Without immediate repetitions.
Ring shortened(Ring ring) {
  ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  return ring;
}

Ring places_of(const std::vector<int>& nodes) {
  Ring places;
  for (const int node : nodes) {
    places.push_back(static_cast<int>(std::find(nodes.begin(), nodes.end(), node) - nodes.begin()));
  }
  return places;
}

/// The faces that are left, turned inward and beginning with their first node, the one with the first nodes at first;
/// nothing if one is folded, or one is there twice.
std::vector<Ring> faces_of(Shape shape, const Ring& places) {
  std::map<Ring, Ring> by_nodes;
  for (const auto& side : mesh::sides(element_type(shape))) {
    Ring face;
    for (const int corner : side) face.push_back(places[static_cast<std::size_t>(corner)]);
    face = shortened(face);
    if (face.size() < 3) continue;
    std::reverse(face.begin(), face.end());
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    Ring nodes = face;
    std::sort(nodes.begin(), nodes.end());
    if (n_different(face) != face.size() || !by_nodes.emplace(nodes, face).second) return {};
  }
  std::vector<Ring> faces;
  for (const auto& [nodes, face] : by_nodes) faces.push_back(face);
  std::stable_sort(faces.begin(), faces.end(), [](const Ring& a, const Ring& b) { return a.size() < b.size(); });
  return faces;
}

bool has(const Ring& ring, int node) { return std::find(ring.begin(), ring.end(), node) != ring.end(); }

/// The node of the upper triangle that an edge of a quadrangle leads to from one of the lower triangle.
int node_above(int node, const std::vector<Ring>& faces) {
  const Ring &lower = faces[0], &quadrangle = has(faces[2], node) ? faces[2] : faces[3];
  const auto at = static_cast<std::size_t>(std::find(quadrangle.begin(), quadrangle.end(), node) - quadrangle.begin());
  const int next = quadrangle[(at + 1) % 4], previous = quadrangle[(at + 3) % 4];
  return has(lower, next) ? previous : next;
}

/// A base, and the nodes that are not in it.
Ring with_others(Ring base, const Ring& places) {
  for (const int place : places) {
    if (!has(base, place)) base.push_back(place);
  }
  return base;
}

/// A solid, by the number of its nodes and of its faces, triangles first.
std::optional<Corners> solid(const std::vector<Ring>& faces, const Ring& places) {
  const std::size_t n = n_different(places);
  const auto n_triangles = std::count_if(faces.begin(), faces.end(), [](const Ring& face) { return face.size() == 3; });
  const auto n_quadrangles = static_cast<std::ptrdiff_t>(faces.size()) - n_triangles;
  if (n == 4 && n_triangles == 4 && n_quadrangles == 0)
    return Corners{Shape::tetrahedron, with_others(faces[0], places)};
  if (n == 5 && n_triangles == 4 && n_quadrangles == 1) return Corners{Shape::pyramid, with_others(faces[4], places)};
  if (n != 6 || n_triangles != 2 || n_quadrangles != 3) return std::nullopt;
  Ring corners = faces[0];
  for (const int node : faces[0]) corners.push_back(node_above(node, faces));
  if (n_different(corners) != 6) return std::nullopt;
  return Corners{Shape::wedge, corners};
}

std::optional<Corners> plane(const Ring& places) {
  const Ring ring = shortened(places);
  if (ring.size() != 3 || n_different(ring) != 3) return std::nullopt;
  return Corners{Shape::triangle, ring};
}

}  // namespace

std::optional<Corners> without_repeated_nodes(Shape shape, const std::vector<int>& nodes) {
  PERIMORPH_ASSERT(static_cast<int>(nodes.size()) == n_nodes(shape), "{} nodes of {}", nodes.size(), n_nodes(shape));
  const Ring places = places_of(nodes);
  if (n_different(places) == nodes.size()) return Corners{shape, nodes};
  auto left = dimension(shape) == 2 ? plane(places) : solid(faces_of(shape, places), places);
  if (left) {
    for (int& place : left->nodes) place = nodes[static_cast<std::size_t>(place)];
  }
  return left;
}

}  // namespace perimorph::mesh_files
