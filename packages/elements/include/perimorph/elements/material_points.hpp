#pragma once

#include <vector>

#include "perimorph/elements/reference_element.hpp"
#include "perimorph/mesh/mesh.hpp"

namespace perimorph::elements {

/// The quadrature points of the local mesh. They are the material points: bonds join them, alpha and damage live at
/// them, and they never move or change when elements become discontinuous.
template <int dim>
class MaterialPoints {
 public:
  /// Local. The mesh must outlive this.
  explicit MaterialPoints(const mesh::Mesh<dim>& mesh, int points_per_direction = 2);

  int size() const { return static_cast<int>(weights_.size()); }
  int first(int element) const { return first_[element]; }
  int count(int element) const { return first_[element + 1] - first_[element]; }

  const base::Point<dim>& position(int point) const { return positions_[point]; }  ///< [length]
  double weight(int point) const { return weights_[point]; }                       ///< volume it stands for

  const ReferenceElement<dim>& reference(int element) const { return *references_[element]; }

  /// Shape function values at the q-th point of an element, (n_corners).
  const CornerValues& shape(int element, int q) const { return references_[element]->shape[q]; }

  /// dN/dx at the q-th point of an element, (dim, n_corners), [1/length]. Computed anew, since stored they would be the
  /// largest part of this: 192 bytes a point of a hexahedron.
  ShapeGradients<dim> gradients(int element, int q) const;

  /// Global id of a point: the same on every rank and for every partition.
  base::GlobalId global_id(int element, int q) const {
    return mesh_.element_ids[element] * static_cast<base::GlobalId>(max_points) + q;
  }

 private:
  const mesh::Mesh<dim>& mesh_;
  std::vector<const ReferenceElement<dim>*> references_;
  std::vector<int> first_;
  std::vector<base::Point<dim>> positions_;
  std::vector<double> weights_;

  Eigen::Matrix<double, dim, dim> jacobian(int element, int q) const;
};

}  // namespace perimorph::elements
