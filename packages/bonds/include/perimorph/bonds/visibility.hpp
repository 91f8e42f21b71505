#pragma once

#include <memory>
#include <vector>

#include "perimorph/base/point_tree.hpp"
#include "perimorph/mesh/mesh.hpp"
#include "perimorph/mesh/pre_crack.hpp"

namespace perimorph::bonds {

/// Which points see each other: a bond whose segment leaves the body or crosses a pre-crack does not exist.
template <int dim>
class Visibility {
 public:
  using Facet = mesh::CrackFacet<dim>;  ///< a segment in 2D, a triangle in 3D

  /// Obstacles are the mesh's boundary and the pre-cracks. Local.
  /// @param mesh this rank's part, of which the boundary is read
  /// @param pre_cracks facets of all pre-cracks, the same on all ranks, (n), [length]
  Visibility(const mesh::Mesh<dim>& mesh, const std::vector<Facet>& pre_cracks)
      : Visibility(mesh, mesh.boundary, pre_cracks) {}

  /// The same with some of the mesh's sides in place of its boundary.
  Visibility(const mesh::Mesh<dim>& mesh, const std::vector<mesh::Side>& sides, const std::vector<Facet>& pre_cracks);

  /// The obstacles that come within `reach` of a point: candidates for blocks(). Local.
  /// @param center the point, (dim), [length]
  /// @param reach >= 0, [length]
  std::vector<Facet> near(const base::Point<dim>& center, double reach) const;

  /// Those of the facets that may cut a segment between two of the points: the others have all points on one side.
  /// Local.
  /// @param points ends of segments, (n), at least one, [length]
  static std::vector<Facet> among(const std::vector<Facet>& facets, const std::vector<base::Point<dim>>& points);

  /// Whether one of the facets cuts the segment between x and p; touching counts. Local.
  /// @param x,p material points, (dim), [length]
  static bool blocks(const std::vector<Facet>& facets, const base::Point<dim>& x, const base::Point<dim>& p);

 private:
  std::vector<Facet> boundary_;
  double largest_radius_ = 0.;  ///< of a facet of the boundary, about its centroid
  std::unique_ptr<base::PointTree<dim>> tree_;
  std::vector<Facet> pre_cracks_;  ///< few, and each may be as large as the body
};

}  // namespace perimorph::bonds
