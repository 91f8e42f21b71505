#include "perimorph/mesh/orientation.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>

namespace perimorph::mesh {

namespace {

using Neighbours = std::vector<std::array<int, 3>>;  // 2D elements use the first two

/// Per corner the corners at the other ends of its edges, in the order that makes their triple product positive. Of the
/// four edges at a pyramid's tip three: the base's corners have all the signs.
const Neighbours& neighbours(ElementType type) {
  static const std::array<Neighbours, 6> all = {{
      {{1, 2, 0}, {2, 0, 0}, {0, 1, 0}},
      {{1, 3, 0}, {2, 0, 0}, {3, 1, 0}, {0, 2, 0}},
      {{1, 2, 3}, {2, 0, 3}, {0, 1, 3}, {0, 2, 1}},
      {{1, 3, 4}, {2, 0, 4}, {3, 1, 4}, {0, 2, 4}, {2, 1, 0}},
      {{1, 2, 3}, {2, 0, 4}, {0, 1, 5}, {5, 4, 0}, {3, 5, 1}, {4, 3, 2}},
      {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7}, {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}},
  }};
  return all[static_cast<int>(type)];
}

}  // namespace

template <int dim>
double smallest_corner_volume(const Mesh<dim>& mesh, int element) {
  const int* nodes = mesh.corners_of(element);
  const Neighbours& ends = neighbours(mesh.types[element]);
  double smallest = 1.;
  for (int c = 0; c < mesh.n_corners(element); ++c) {
    Eigen::Matrix<double, dim, dim> edges;
    for (int d = 0; d < dim; ++d) {
      edges.col(d) = mesh.coordinates[nodes[ends[c][d]]] - mesh.coordinates[nodes[c]];
    }
    const double lengths = edges.colwise().norm().prod();
    smallest = std::min(smallest, lengths > 0. ? edges.determinant() / lengths : 0.);
  }
  return smallest;
}

template double smallest_corner_volume(const Mesh<2>&, int);
template double smallest_corner_volume(const Mesh<3>&, int);

}  // namespace perimorph::mesh
