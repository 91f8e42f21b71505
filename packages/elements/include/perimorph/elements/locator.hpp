#pragma once

#include <memory>
#include <optional>

#include "perimorph/base/point_tree.hpp"
#include "perimorph/elements/reference_element.hpp"
#include "perimorph/mesh/mesh.hpp"

namespace perimorph::elements {

/// A place inside an element: a field is interpolated there by the shape function values.
struct Location {
  int element;         ///< local
  CornerValues shape;  ///< N_k there, (n_corners)
};

/// Finds the elements that hold given points, among those that this rank owns.
template <int dim>
class Locator {
 public:
  /// Local. The mesh must outlive this.
  explicit Locator(const mesh::Mesh<dim>& mesh);

  /// Where a point is; none if it is in no owned element. On a side that elements share, it is in the one with the
  /// lowest global id. Local.
  /// @param x (dim), finite, [length]
  std::optional<Location> find(const base::Point<dim>& x) const;

 private:
  const mesh::Mesh<dim>& mesh_;
  double largest_radius_ = 0.;
  std::unique_ptr<base::PointTree<dim>> centroids_;
};

}  // namespace perimorph::elements
