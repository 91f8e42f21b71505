#pragma once

#include <optional>
#include <vector>

#include "perimorph/base/algebra.hpp"
#include "perimorph/mesh/element_type.hpp"

namespace perimorph::elements {

inline constexpr int max_points = 27;

/// One value per corner of an element, (n_corners).
using CornerValues = Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, mesh::max_corners>;

/// Gradients of all shape functions at one point, (dim, n_corners).
template <int dim>
using ShapeGradients = Eigen::Matrix<double, dim, Eigen::Dynamic, 0, dim, mesh::max_corners>;

/// Shape functions of an element type, tabulated at the points of a quadrature rule.
template <int dim>
struct ReferenceElement {
  int n_corners, n_points;
  std::vector<double> weights;                 ///< of the rule, sum = reference volume
  std::vector<CornerValues> shape;             ///< N_k at each point, (n_points)(n_corners)
  std::vector<ShapeGradients<dim>> gradients;  ///< dN_k/dr by the reference coordinates, (n_points)(dim, n_corners)
};

/// The table for one type and rule, made at its first use. Local.
/// @param points_per_direction 1, 2 or 3: Gauss points of Q4, H8 and P5 along each axis; the simplices' rule of 1,
///        3 (T3) or 4 (T4), and 6 or 11 points; W6 has the triangle's in each of as many layers
/// @throws Bug for a type of another dimension or another number of points
template <int dim>
const ReferenceElement<dim>& reference_element(mesh::ElementType type, int points_per_direction = 2);

/// Shape function values at a point that lies in an element, or within 1e-6 of its size; none for others. Local.
/// @param corners of the element, (n_corners), [length]
/// @param x the point, (dim), [length]
template <int dim>
std::optional<CornerValues> shape_at(mesh::ElementType type, const std::vector<base::Point<dim>>& corners,
                                     const base::Point<dim>& x);

}  // namespace perimorph::elements
