#pragma once

#include <type_traits>
#include <utility>

#include "perimorph/base/errors.hpp"
#include "perimorph/elements/material_points.hpp"

namespace perimorph::elements {

/// Calls function(std::integral_constant<int, n>) with the number of corners as a compile-time constant.
/// @param n_corners of an element of this dimension: 3 or 4 in 2D, 4, 5, 6 or 8 in 3D
template <int dim, class Function>
void with_corners(int n_corners, Function&& function) {
  constexpr int simplex = dim + 1, cube = 1 << dim, pyramid = 5, wedge = 6;
  if (n_corners == simplex) {
    function(std::integral_constant<int, simplex>{});
  } else if (n_corners == cube) {
    function(std::integral_constant<int, cube>{});
  } else if constexpr (dim == 3) {
    if (n_corners == pyramid) {
      function(std::integral_constant<int, pyramid>{});
    } else {
      PERIMORPH_DEBUG_ASSERT(n_corners == wedge, "an element of {} corners", n_corners);
      function(std::integral_constant<int, wedge>{});
    }
  } else {
    PERIMORPH_DEBUG_ASSERT(false, "an element of {} corners", n_corners);
  }
}

/// The two axes of a shear component in Voigt notation: xy in 2D; yz, xz, xy in 3D.
/// @param component its place in the Voigt vector, dim ... n_voigt - 1
template <int dim>
constexpr std::pair<int, int> shear_axes(int component) {
  if (dim == 2) return {0, 1};
  return {component == 3 ? 1 : 0, component == 5 ? 1 : 2};
}

/// B: strain (Voigt) = B d [WHL19, eq. 8], with d the corner displacements node by node; (n_voigt, dim * n),
/// [1/length].
/// @param g shape function gradients, (dim, n), [1/length]
template <int dim, int n>
Eigen::Matrix<double, base::n_voigt<dim>, dim * n> strain_matrix(const ShapeGradients<dim>& g) {
  PERIMORPH_DEBUG_ASSERT(g.cols() == n, "gradients of {} shape functions, not {}", g.cols(), n);
  Eigen::Matrix<double, base::n_voigt<dim>, dim * n> b;
  b.setZero();
  for (int k = 0; k < n; ++k) {
    for (int c = 0; c < dim; ++c) b(c, k * dim + c) = g(c, k);
    for (int v = dim; v < base::n_voigt<dim>; ++v) {
      const auto [i, j] = shear_axes<dim>(v);
      b(v, k * dim + i) = g(j, k);
      b(v, k * dim + j) = g(i, k);
    }
  }
  return b;
}

/// The vector v with (xi . eps xi) = v . eps(Voigt): squares, then products, so that xi^4 = v v^T in Voigt notation;
/// (n_voigt), [length^2].
/// @param xi a bond's vector, (dim), [length]
template <int dim>
base::Voigt<dim> squared(const base::Point<dim>& xi) {
  base::Voigt<dim> v;
  v.template head<dim>() = xi.cwiseProduct(xi);
  if constexpr (dim == 2) {
    v[2] = xi[0] * xi[1];
  } else {
    v.template tail<3>() << xi[1] * xi[2], xi[0] * xi[2], xi[0] * xi[1];
  }
  return v;
}

}  // namespace perimorph::elements
