#pragma once

#include <vector>

#include "perimorph/base/errors.hpp"
#include "perimorph/elements/reference_element.hpp"
#include "perimorph/mesh/mesh.hpp"

namespace perimorph::elements {

/// The quadrature points of the local mesh. They are the material points: bonds join them, alpha and damage live at
/// them, and they never move or change when elements become discontinuous.
template <int dim>
class MaterialPoints {
 public:
  /// Local. The mesh must outlive this.
  /// @param points_per_direction as for reference_element()
  /// @throws Bug if a point of an element stands for no volume
  explicit MaterialPoints(const mesh::Mesh<dim>& mesh, int points_per_direction = 2);

  /// Points are numbered element by element: those of element e are first(e) ... first(e + 1) - 1.
  int size() const { return static_cast<int>(weights_.size()); }
  int first(int element) const {
    PERIMORPH_DEBUG_ASSERT(element >= 0 && element <= n_elements(), "element {} of {}", element, n_elements());
    return first_[element];
  }
  int count(int element) const { return first(element + 1) - first(element); }

  /// Where a point is in the undeformed body, (dim), [length].
  const base::Point<dim>& position(int point) const {
    PERIMORPH_DEBUG_ASSERT(point >= 0 && point < size(), "point {} of {}", point, size());
    return positions_[point];
  }
  /// The volume that a point stands for: of the rule, times the Jacobian's determinant, [length^dim].
  double weight(int point) const {
    PERIMORPH_DEBUG_ASSERT(point >= 0 && point < size(), "point {} of {}", point, size());
    return weights_[point];
  }

  const ReferenceElement<dim>& reference(int element) const {
    PERIMORPH_DEBUG_ASSERT(element >= 0 && element < n_elements(), "element {} of {}", element, n_elements());
    return *references_[element];
  }

  /// Shape function values at the q-th point of an element, (n_corners).
  const CornerValues& shape(int element, int q) const {
    PERIMORPH_DEBUG_ASSERT(q >= 0 && q < count(element), "point {} of {} of element {}", q, count(element), element);
    return references_[element]->shape[q];
  }

  /// dN/dx at the q-th point of an element, (dim, n_corners), [1/length]. Computed at each call: stored they would be
  /// the largest part of this: 192 bytes a point of a hexahedron.
  ShapeGradients<dim> gradients(int element, int q) const;

  /// Global id of the q-th point of an element: the same on every rank and for every partition.
  base::GlobalId global_id(int element, int q) const {
    return mesh_.element_ids[element] * static_cast<base::GlobalId>(max_points) + q;
  }

 private:
  const mesh::Mesh<dim>& mesh_;
  std::vector<const ReferenceElement<dim>*> references_;
  std::vector<int> first_;
  std::vector<base::Point<dim>> positions_;
  std::vector<double> weights_;

  int n_elements() const { return static_cast<int>(references_.size()); }
  Eigen::Matrix<double, dim, dim> jacobian(int element, int q) const;
};

}  // namespace perimorph::elements
