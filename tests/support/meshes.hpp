#pragma once

// Small meshes made in memory, for tests.

#include <cmath>

#include "perimorph/mesh/distribute.hpp"
#include "perimorph/mesh/mesh.hpp"

namespace perimorph::tests {

using Point2 = base::Point<2>;
using Point3 = base::Point<3>;

/// Everything on one rank: the rest of a mesh that has coordinates, elements and groups.
template <int dim>
void complete(mesh::Mesh<dim>& mesh) {
  const int n_nodes = mesh.n_nodes(), n_elements = mesh.n_elements();
  for (int n = 0; n < n_nodes; ++n) mesh.node_ids.push_back(n);
  for (int e = 0; e < n_elements; ++e) mesh.element_ids.push_back(e);
  mesh.node_owners.assign(n_nodes, 0);
  mesh.element_owners.assign(n_elements, 0);
  mesh.n_owned_nodes = n_nodes;
  mesh.n_owned_elements = n_elements;
  mesh.n_global_nodes = n_nodes;
  mesh.n_global_elements = n_elements;
  mesh::find_boundary(mesh);
}

struct Grid {
  int nx, ny;
  double width = 1., height = 1.;
  Point2 origin = Point2::Zero();
  double distortion = 0.;  ///< of inner nodes, as a share of the spacing
  bool triangles = false;
};

/// A whole rectangular mesh of quadrilaterals (or each cut into two triangles) on one rank. Node sets "left", "right",
/// "bottom", "top", "all" and "boundary", side set "top" and "right", block "body".
inline mesh::Mesh<2> grid(const Grid& g) {
  mesh::Mesh<2> mesh;
  mesh.block_names = {"body"};
  const double dx = g.width / g.nx, dy = g.height / g.ny;
  const auto node = [&](int i, int j) { return j * (g.nx + 1) + i; };
  for (int j = 0; j <= g.ny; ++j) {
    for (int i = 0; i <= g.nx; ++i) {
      const bool inner = i > 0 && i < g.nx && j > 0 && j < g.ny;
      const double shift = inner ? g.distortion : 0.;
      // A fixed irregular pattern: no random numbers, the same on every machine.
      const Point2 wobble(std::sin(12.9898 * i + 78.233 * j), std::sin(39.346 * i + 11.135 * j));
      mesh.coordinates.push_back(g.origin + Point2((i + shift * wobble[0]) * dx, (j + shift * wobble[1]) * dy));
      const int n = node(i, j);
      if (i == 0) mesh.node_sets["left"].push_back(n);
      if (i == g.nx) mesh.node_sets["right"].push_back(n);
      if (j == 0) mesh.node_sets["bottom"].push_back(n);
      if (j == g.ny) mesh.node_sets["top"].push_back(n);
      if (!inner) mesh.node_sets["boundary"].push_back(n);
      mesh.node_sets["all"].push_back(n);
    }
  }
  const auto add = [&](mesh::ElementType type, std::initializer_list<int> corners) {
    mesh.types.push_back(type);
    mesh.blocks.push_back(0);
    mesh.corners.insert(mesh.corners.end(), corners);
    mesh.first_corner.push_back(static_cast<int>(mesh.corners.size()));
  };
  for (int j = 0; j < g.ny; ++j) {
    for (int i = 0; i < g.nx; ++i) {
      const int a = node(i, j), b = node(i + 1, j), c = node(i + 1, j + 1), d = node(i, j + 1);
      if (g.triangles) {
        add(mesh::ElementType::tri3, {a, b, c});
        add(mesh::ElementType::tri3, {a, c, d});
      } else {
        add(mesh::ElementType::quad4, {a, b, c, d});
      }
      const int last = static_cast<int>(mesh.types.size()) - 1;
      if (j == g.ny - 1) mesh.side_sets["top"].push_back({last, g.triangles ? 1 : 2});
      if (i == g.nx - 1) mesh.side_sets["right"].push_back({g.triangles ? last - 1 : last, 1});
    }
  }
  complete(mesh);
  return mesh;
}

struct Brick {
  int nx, ny, nz;          ///< cubes of side 1
  double distortion = 0.;  ///< of inner nodes
  /// Each cube is cut into six tetrahedra, three pyramids or two wedges; every second column of cubes stays whole
  /// between wedges.
  mesh::ElementType type = mesh::ElementType::hex8;
};

/// A whole block from the origin, on one rank. Node sets "left" and "right" (x),
/// "bottom" and "top" (y), "back" and "front" (z), "all" and "boundary"; block "body".
inline mesh::Mesh<3> brick(const Brick& b) {
  mesh::Mesh<3> mesh;
  mesh.block_names = {"body"};
  const auto node = [&](int i, int j, int k) { return (k * (b.ny + 1) + j) * (b.nx + 1) + i; };
  for (int k = 0; k <= b.nz; ++k) {
    for (int j = 0; j <= b.ny; ++j) {
      for (int i = 0; i <= b.nx; ++i) {
        const bool inner = i > 0 && i < b.nx && j > 0 && j < b.ny && k > 0 && k < b.nz;
        const Point3 wobble(std::sin(12.9898 * i + 78.233 * j + 5.1 * k), std::sin(39.346 * i + 11.135 * j + 7.7 * k),
                            std::sin(4.898 * i + 28.23 * j + 55.1 * k));
        mesh.coordinates.push_back(Point3(i, j, k) + (inner ? b.distortion : 0.) * wobble);
        const int n = node(i, j, k);
        const std::pair<const char*, bool> sets[] = {{"left", i == 0},     {"right", i == b.nx}, {"bottom", j == 0},
                                                     {"top", j == b.ny},   {"back", k == 0},     {"front", k == b.nz},
                                                     {"boundary", !inner}, {"all", true}};
        for (const auto& [name, is_in] : sets) {
          if (is_in) mesh.node_sets[name].push_back(n);
        }
      }
    }
  }
  const auto add = [&](mesh::ElementType type, const std::vector<int>& corners) {
    mesh.types.push_back(type);
    mesh.blocks.push_back(0);
    mesh.corners.insert(mesh.corners.end(), corners.begin(), corners.end());
    mesh.first_corner.push_back(static_cast<int>(mesh.corners.size()));
  };
  for (int k = 0; k < b.nz; ++k) {
    for (int j = 0; j < b.ny; ++j) {
      for (int i = 0; i < b.nx; ++i) {
        std::vector<int> c;
        for (const int up : {k, k + 1}) {
          for (const int n : {node(i, j, up), node(i + 1, j, up), node(i + 1, j + 1, up), node(i, j + 1, up)}) {
            c.push_back(n);
          }
        }
        if (b.type == mesh::ElementType::tet4) {
          // All six around the diagonal from corner 0 to corner 6: neighbouring cubes cut their common face alike.
          const int around[] = {1, 2, 3, 7, 4, 5};
          for (int t = 0; t < 6; ++t) add(b.type, {c[0], c[around[t]], c[around[(t + 1) % 6]], c[6]});
        } else if (b.type == mesh::ElementType::pyramid5 && (i + j + k) % 2 == 0) {
          // On the faces without corner 6, with their tips there; the neighbours are turned round, and so cut faces
          // alike.
          for (const auto& f : {std::array{0, 1, 2, 3}, {0, 3, 7, 4}, {0, 4, 5, 1}}) {
            add(b.type, {c[f[0]], c[f[1]], c[f[2]], c[f[3]], c[6]});
          }
        } else if (b.type == mesh::ElementType::pyramid5) {
          for (const auto& f : {std::array{6, 5, 4, 7}, {6, 2, 1, 5}, {6, 7, 3, 2}}) {
            add(b.type, {c[f[0]], c[f[1]], c[f[2]], c[f[3]], c[0]});
          }
        } else if (b.type == mesh::ElementType::wedge6 && (i + j) % 2 == 0) {
          add(b.type, {c[0], c[1], c[2], c[4], c[5], c[6]});
          add(b.type, {c[0], c[2], c[3], c[4], c[6], c[7]});
        } else {
          add(mesh::ElementType::hex8, c);
        }
      }
    }
  }
  complete(mesh);
  return mesh;
}

/// A whole mesh without the elements whose centroid lies where the predicate says, and without the nodes that only they
/// had: a body with holes or notches. The ids stay contiguous; the groups keep what remains.
template <int dim, class Predicate>
mesh::Mesh<dim> without(const mesh::Mesh<dim>& whole, Predicate is_removed) {
  mesh::Mesh<dim> rest;
  rest.block_names = whole.block_names;
  std::vector<int> new_node(whole.n_nodes(), -1), new_element(whole.n_elements(), -1);
  for (int e = 0; e < whole.n_elements(); ++e) {
    if (is_removed(mesh::centroid(whole, e))) continue;
    new_element[e] = rest.n_elements();
    rest.types.push_back(whole.types[e]);
    rest.blocks.push_back(whole.blocks[e]);
    for (int k = 0; k < whole.n_corners(e); ++k) new_node[whole.corners_of(e)[k]] = 0;
  }
  for (int n = 0; n < whole.n_nodes(); ++n) {
    if (new_node[n] < 0) continue;
    new_node[n] = rest.n_nodes();
    rest.coordinates.push_back(whole.coordinates[n]);
  }
  for (int e = 0; e < whole.n_elements(); ++e) {
    if (new_element[e] < 0) continue;
    for (int k = 0; k < whole.n_corners(e); ++k) rest.corners.push_back(new_node[whole.corners_of(e)[k]]);
    rest.first_corner.push_back(static_cast<int>(rest.corners.size()));
  }
  for (const auto& [name, nodes] : whole.node_sets) {
    auto& kept = rest.node_sets[name];
    for (const int n : nodes) {
      if (new_node[n] >= 0) kept.push_back(new_node[n]);
    }
  }
  for (const auto& [name, sides] : whole.side_sets) {
    auto& kept = rest.side_sets[name];
    for (const auto& side : sides) {
      if (new_element[side.element] >= 0) kept.push_back({new_element[side.element], side.side});
    }
  }
  complete(rest);
  return rest;
}

/// The grid, distributed over the ranks.
inline mesh::Mesh<2> distributed_grid(const base::Comm& comm, const Grid& g, double halo_width) {
  return mesh::distribute(comm, comm.getRank() == 0 ? grid(g) : mesh::Mesh<2>{}, halo_width);
}

}  // namespace perimorph::tests
